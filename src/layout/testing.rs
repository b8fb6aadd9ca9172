//! Meshes for the tests of layouts.

use crate::landmarks::Landmarks;
use crate::mesh::VertexId;
use crate::mesh::coarsening::Level;
use crate::monitor::Silent;

/// A figure in two poses, coarse.
pub(super) fn figures() -> ([Level; 2], Landmarks) {
    let demo = crate::demo::build("poses").unwrap();
    let held = [0, 1].map(|s| demo.landmarks.iter().map(|p| VertexId(p[s])).collect::<Vec<_>>());
    let coarse = |mesh, held| Level::coarse(mesh, held, 500, &mut Silent).unwrap();
    let levels = [coarse(&demo.source, &held[0]), coarse(&demo.target, &held[1])];
    let [source, target] = [0, 1].map(|s| {
        let number = |v: &VertexId| levels[s].vertices.iter().position(|w| w == v).unwrap().into();
        held[s].iter().map(number).collect()
    });
    (levels, Landmarks { source, target })
}

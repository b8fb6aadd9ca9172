//! The search for the isotopy class, judged by real maps of coarse meshes.
#![allow(dead_code, reason = "every test binary uses another part")]

use crate::theorems::Case;
use conemap::landmarks::Landmarks;
use conemap::layout::{self, BaseLayout, Candidate, Candidates, PatchedMesh, SearchOptions, same_class};
use conemap::mesh::coarsening::Level;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::{Cancelled, Monitor, Silent};
use conemap::surface_map::energy::map_energy::MapEnergy;
use conemap::surface_map::parametrisation::initial::{InitialOptions, embed, relax};
use conemap::surface_map::parametrisation::problem::FlatRelaxOptions;
use conemap::surface_map::relaxation::map_relaxation::{self, MapRelaxationOptions};
use conemap::surface_map::{ConeSurface, MapError};
use std::sync::Arc;

/// The mean log density of a layout's map after a few rounds of relaxation.
pub fn mean_log(layout: &BaseLayout, monitor: &mut dyn Monitor) -> Result<Option<f64>, Cancelled> {
    let map = |monitor: &mut dyn Monitor| -> Result<f64, MapError> {
        let surface = Arc::new(ConeSurface::of_layout(layout));
        let mut side = |patched: &PatchedMesh| -> Result<_, MapError> {
            let (start, _) = embed(patched, &surface, &InitialOptions::default(), monitor)?;
            Ok(relax(patched.parametrised(&start), &surface, &FlatRelaxOptions::default(), monitor)?.0)
        };
        let embeddings = [side(&layout.source)?, side(&layout.target)?];
        let sides = [layout.source.parametrised(&embeddings[0]), layout.target.parametrised(&embeddings[1])];
        let options = MapRelaxationOptions {
            max_rounds: 3,
            energy: MapEnergy::JUDGE,
            ..MapRelaxationOptions::default()
        };
        let relaxed = map_relaxation::relax(sides, &surface, &options, monitor)?;
        Ok(relaxed.mean_log())
    };
    match map(monitor) {
        Ok(mean_log) => Ok(Some(mean_log)),
        Err(MapError::Cancelled(stop)) => Err(stop),
        Err(_) => Ok(None),
    }
}

/// The mean log density of a candidate's map.
pub fn judge(candidate: &Candidate, monitor: &mut dyn Monitor) -> Result<Option<f64>, Cancelled> {
    mean_log(&candidate.layout, monitor)
}

/// Coarsens a mesh and keeps its landmarks; returns the level and the numbers of the landmarks on it.
pub fn coarse(mesh: &SurfaceMesh, landmarks: &[VertexId], goal: usize) -> (Level, Vec<VertexId>) {
    let level = Level::coarse(mesh, landmarks, goal, &mut Silent).expect("nobody stops");
    let number =
        |v: &VertexId| level.vertices.iter().position(|w| w == v).expect("landmarks are kept").into();
    let numbers = landmarks.iter().map(number).collect();
    (level, numbers)
}

/// Coarsens two meshes of the same connectivity to one coarse connectivity, on which vertex i corresponds to vertex i.
fn coarse_with_known_map(case: &Case, goal: usize) -> ([SurfaceMesh; 2], Landmarks) {
    let Case { name, source, target, landmarks, .. } = case;
    assert_eq!(landmarks.source, landmarks.target, "{name} has a known map");
    assert_eq!(source.triangles(), target.triangles(), "{name} has a known map");
    let (level, numbers) = coarse(source, &landmarks.source.raw, goal);
    let positions = level.vertices.iter().map(|&v| target.positions()[v]).collect();
    let target = level.mesh.with_positions(positions);
    ([level.mesh, target], Landmarks { source: numbers.clone().into(), target: numbers.into() })
}

/// The layout of the identity: the source's own drawing on both sides.
fn identity(layout: &BaseLayout) -> BaseLayout {
    BaseLayout { target: layout.source.clone(), ..layout.clone() }
}

/// Checks that the search ends in the class of the known map, on levels as coarse as those of a run with 33 landmarks.
pub fn known_class_is_found(case: &Case) {
    let ([source, target], landmarks) = coarse_with_known_map(case, 600);
    let mut candidates = Candidates::new([&source, &target], &landmarks, &mut Silent).expect("few landmarks");
    let options = SearchOptions::default();
    let (found, report) =
        layout::search(&mut candidates, &mut judge, &options, &mut Silent).expect("a layout");
    assert!(same_class(&found.layout, &identity(&found.layout)), "{}: {report:?}", case.name);
}

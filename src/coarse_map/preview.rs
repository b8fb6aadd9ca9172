//! Previews of a coarse map before it is refined.
//!
//! The vertices of the present level have exact images. Those of the other vertices of the full mesh are resampled from them: near enough
//! to show a pattern, for one search each.

use super::multilevel::{CoarseMap, PlacedLevel};
use crate::landmarks::MeshSide;
use crate::mesh::resampling::resampled;
use crate::monitor::MapPreview;
use glam::DVec3;

impl MapPreview for CoarseMap<'_> {
    /// The image of each vertex of the full mesh with its landmarks on the other mesh, which is scaled to area 1.
    fn images(&self, of: MeshSide) -> Option<Vec<DVec3>> {
        let PlacedLevel { level, images, full, onto } = self.placed(of)?;
        let known = |v| level.vertices.binary_search(&v).ok();
        let unit = 1.0 / onto.area().sqrt();
        Some(resampled(&images, &level.mesh, full, known).iter().map(|place| place * unit).collect())
    }
}

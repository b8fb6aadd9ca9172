//! A mesh that landmarks are brought onto.

use crate::io::landmark_formats::Space;
use crate::mesh::check::CheckedMesh;

/// A mesh with the coordinate system of its positions.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// The mesh.
    pub mesh: &'a CheckedMesh,
    /// The system that its file names.
    pub space: Space,
}

impl Surface<'_> {
    /// The square root of the area, in the mesh's coordinates: what distances are compared with.
    pub fn size(self) -> f64 {
        self.mesh.mesh.area().sqrt()
    }
}

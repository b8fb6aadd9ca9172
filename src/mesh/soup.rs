//! Polygons as files hold them: nothing is checked yet.

use super::SurfaceMesh;
use glam::DVec3;

/// Positions and polygons as read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonSoup {
    /// Vertex positions in file order.
    pub positions: Vec<DVec3>,
    /// Polygons as vertex numbers into `positions`, in file order and orientation.
    pub polygons: Vec<Vec<u32>>,
    /// For each vertex the first one at the same place: both are one vertex of the surface, and polygons name the first.
    /// Empty where the file shares vertices itself and none were joined.
    pub joined_with: Vec<u32>,
}

impl From<&SurfaceMesh> for PolygonSoup {
    /// The mesh as a file of it would have it.
    fn from(mesh: &SurfaceMesh) -> Self {
        Self {
            positions: mesh.positions().iter().copied().collect(),
            polygons: mesh.triangles().iter().map(|t| t.iter().map(|v| v.0).collect()).collect(),
            joined_with: Vec::new(),
        }
    }
}

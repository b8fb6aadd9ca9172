//! A shape with named points on it.

use crate::mesh::SurfaceMesh;
use glam::DVec3;

/// A shape with named points on it.
pub struct Shape {
    /// The mesh.
    pub mesh: SurfaceMesh,
    /// Names and places.
    pub points: Vec<(&'static str, DVec3)>,
}

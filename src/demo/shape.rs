//! A shape with named points on it.

use super::implicit::{RoundCone, SmoothUnion};
use super::polygonise::polygonise;
use crate::mesh::SurfaceMesh;
use glam::DVec3;

/// A shape with named points on it.
pub struct Shape {
    /// The mesh.
    pub mesh: SurfaceMesh,
    /// Names and places.
    pub points: Vec<(&'static str, DVec3)>,
}

/// Cones with named points on them.
pub(super) struct Skeleton {
    pub cones: Vec<RoundCone>,
    /// Names and places.
    pub points: Vec<(&'static str, DVec3)>,
}

impl Skeleton {
    /// The shape with its cones blended over a distance, by cells of a size.
    pub fn fleshed(self, blend: f64, cell: f64) -> Shape {
        let union = SmoothUnion { cones: self.cones, blend };
        let mesh = polygonise(|p| union.value(p), union.bounds(), cell);
        Shape { mesh, points: self.points }
    }
}

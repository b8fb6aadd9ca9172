//! Points on a surface mesh.

use super::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::math::barycentric;
use glam::DVec3;

/// A point of a triangle by its barycentric coordinates (non-negative, sum 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The triangle.
    pub face: FaceId,
    /// Weights of the triangle's corners 0, 1 and 2.
    pub barycentric: [f64; 3],
}

impl SurfacePoint {
    /// The point of a face with these weights, the negative ones left out.
    pub fn clamped(face: FaceId, weights: [f64; 3]) -> Self {
        Self { face, barycentric: barycentric::clamped(weights) }
    }

    /// A vertex as a corner of one of its faces.
    pub fn at_vertex(mesh: &SurfaceMesh, v: VertexId) -> Self {
        Self::on_halfedge(mesh.outgoing(v), 0.0)
    }

    /// A point of a face's side: `along` is 0 at the start of the halfedge and 1 at its end.
    #[inline]
    pub fn on_halfedge(h: HalfedgeId, along: f64) -> Self {
        let mut barycentric = [0.0; 3];
        barycentric[h.corner()] = 1.0 - along;
        barycentric[h.next().corner()] = along;
        Self { face: h.face(), barycentric }
    }

    /// The corner of its face with the largest weight; of equal ones the last.
    pub fn heaviest_corner(&self, mesh: &SurfaceMesh) -> VertexId {
        let heavier = |a: &usize, b: &usize| self.barycentric[*a].total_cmp(&self.barycentric[*b]);
        mesh.triangles()[self.face][(0..3).max_by(heavier).unwrap_or(0)]
    }

    /// Position in space.
    pub fn position(&self, mesh: &SurfaceMesh) -> DVec3 {
        barycentric::interpolated(mesh.corners(self.face), self.barycentric)
    }
}

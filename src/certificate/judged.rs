//! The input of the certificate, as plain arrays.

use crate::math::rigid2::Rigid2;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec2;
use typed_index_collections::TiSlice;

/// A parametrised mesh, with the claim where the base domain's edges start on it.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'a> {
    /// Its connectivity.
    pub mesh: &'a SurfaceMesh,
    /// For each halfedge its start in the plane of its face; the triangles' areas sum to 1.
    pub corners: &'a TiSlice<HalfedgeId, DVec2>,
    /// For each halfedge the rigid motion from the plane of its face to that of its twin's face.
    pub transitions: &'a TiSlice<HalfedgeId, Rigid2>,
    /// The mesh's vertex of each vertex of the base domain.
    pub landmark_vertices: &'a [VertexId],
    /// The corner and the direction in which each base halfedge is claimed to start.
    pub starts: &'a TiSlice<HalfedgeId, Start>,
}

/// The corner and the direction in which a straight line leaves a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// A halfedge that starts at the vertex.
    pub corner: HalfedgeId,
    /// A unit vector in the plane of the corner's face, between both sides of the corner.
    pub direction: DVec2,
}

/// The cone surface that a mesh must parametrise.
#[derive(Clone, Copy, Debug)]
pub struct Prescribed<'a> {
    /// The base domain's connectivity: a closed surface of genus 0.
    pub base: &'a SurfaceMesh,
    /// The length of each of its halfedges; twins agree.
    pub lengths: &'a TiSlice<HalfedgeId, f64>,
}

impl Prescribed<'_> {
    /// The angle at the start of a halfedge in its triangle, in radians; NaN where there is no such triangle.
    pub(super) fn angle(&self, h: HalfedgeId) -> f64 {
        let [a, b, c] = [h.next(), h, h.prev()].map(|side| self.lengths[side]);
        // Half the angle by its tangent (Kahan 2014 names why not by the cosine).
        let (low, high) = ((a - b + c) * (a + b - c), (b + c - a) * (a + b + c));
        2.0 * crate::math::scalar::atan2(low.sqrt(), high.sqrt())
    }
}

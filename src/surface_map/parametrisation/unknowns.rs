//! The unknowns of a relaxation, one point per free vertex, from embeddings and back.

use super::embedding::{Embedding, Parametrised};
use super::problem::FlatProblem;
use super::rest_triangle::{Corner, FlatTriangle};
use crate::math::golden;
use crate::math::rigid2::Rigid2;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor};
use glam::DVec2;
use typed_index_collections::{TiSlice, TiVec};

/// The corners of a parametrisation in terms of the unknowns: those of the stars belong to free vertices, numbered in order, each
/// with its coordinates in the plane of its star's first face and the motion from there; the others are fixed.
pub(super) fn sights<I: Iterator<Item = HalfedgeId>>(
    stars: impl Iterator<Item = I>,
    corners: &TiSlice<HalfedgeId, DVec2>,
    transitions: &TiSlice<HalfedgeId, Rigid2>,
) -> TiVec<HalfedgeId, Corner> {
    let mut sights: TiVec<HalfedgeId, Corner> = corners.iter().map(|&p| Corner::Fixed(p)).collect();
    for (number, star) in stars.enumerate() {
        let mut motion = Rigid2::IDENTITY;
        for h in star {
            sights[h] = Corner::Free(number as u32, motion);
            motion = transitions[h.prev()].after(&motion);
        }
    }
    sights
}

/// The free vertices of a parametrised mesh with their numbers as unknowns. A vertex has its coordinates in the plane of
/// its first face.
pub struct Unknowns<'a> {
    mesh: &'a SurfaceMesh,
    /// The free vertices, in order.
    free: Vec<VertexId>,
    /// The start of each halfedge in terms of the unknowns.
    sights: TiVec<HalfedgeId, Corner>,
}

impl<'a> Unknowns<'a> {
    /// The unknowns of all vertices but the landmarks, in order.
    pub fn new(side: Parametrised<'a>) -> Self {
        let Parametrised { mesh, embedding, .. } = side;
        let is_landmark = side.landmark_flags();
        let free: Vec<VertexId> = mesh.vertices().filter(|&v| !is_landmark[v]).collect();
        let stars = free.iter().map(|&v| mesh.star(v));
        Self { mesh, sights: sights(stars, &embedding.corners, &embedding.transitions), free }
    }

    /// The flat problem of the whole mesh; its triangles are the mesh's faces in order.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn problem(&self, monitor: &mut dyn Monitor) -> Result<FlatProblem, Cancelled> {
        let triangle = |f: FaceId| {
            let corners = f.halfedges().map(|h| self.sights[h]);
            FlatTriangle::with_rest(corners, self.mesh.corners(f))
        };
        FlatProblem::new(self.mesh.faces().map(triangle).collect(), self.free.len(), monitor)
    }

    /// The start of a halfedge in terms of the unknowns.
    pub fn sight(&self, h: HalfedgeId) -> Corner {
        self.sights[h]
    }

    /// The unknowns of an embedding with the same transitions.
    pub fn points(&self, embedding: &Embedding) -> Vec<DVec2> {
        self.free.iter().map(|&v| embedding.corners[self.mesh.outgoing(v)]).collect()
    }

    /// The unknowns of an embedding; from attempt 1 on each is moved by 1e-9 of its shortest edge, sixfold with each further attempt, in a
    /// direction that scatters with its number.
    pub fn nudged(&self, embedding: &Embedding, attempt: usize) -> Vec<DVec2> {
        let corners = &embedding.corners;
        let shortest = |v: VertexId| {
            let length = |h: HalfedgeId| corners[h].distance(corners[h.next()]);
            self.mesh.star(v).map(length).fold(f64::INFINITY, f64::min)
        };
        // 1e-9 is far above rounding (1e-16) and too small to be seen; a factor of 30 from nudge to nudge moved vertices too far.
        let size = (1..attempt).fold(1e-9, |size, _| size * 6.0);
        let mut z = self.points(embedding);
        for (k, (point, &v)) in z.iter_mut().zip(&self.free).enumerate().filter(|_| attempt > 0) {
            *point += golden::direction(k + 1) * (size * shortest(v));
        }
        z
    }

    /// Writes the corners of all faces for given values of the unknowns.
    pub fn place(&self, z: &[DVec2], corners: &mut TiVec<HalfedgeId, DVec2>) {
        for (corner, sight) in corners.iter_mut().zip(&self.sights) {
            *corner = sight.position(z);
        }
    }
}

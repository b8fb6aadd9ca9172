//! Between embeddings and the unknowns of a relaxation: one point per free vertex.

use super::charted::{corner, own_chart, seen};
use super::cone_surface::ConeSurface;
use super::embedding::Embedding;
use super::flat_problem::{FlatProblem, FlatTriangle};
use super::progressive::{Hold, holds};
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::mesh::{HalfedgeId, VertexId};
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// The free vertices of a patched mesh with their numbers as unknowns.
pub struct Unknowns<'a> {
    patched: &'a PatchedMesh,
    surface: &'a ConeSurface,
    holds: TiVec<VertexId, Hold>,
    numbers: TiVec<VertexId, u32>,
    free: Vec<VertexId>,
}

impl<'a> Unknowns<'a> {
    /// All vertices but the landmarks, in order.
    pub fn new(patched: &'a PatchedMesh, surface: &'a ConeSurface) -> Self {
        let holds = holds(patched, &surface.base);
        let mut numbers = ti_vec![u32::MAX; holds.len()];
        let mut free = Vec::with_capacity(holds.len());
        for v in patched.mesh.vertices().filter(|&v| own_chart(holds[v]).is_some()) {
            numbers[v] = free.len() as u32;
            free.push(v);
        }
        Self { patched, surface, holds, numbers, free }
    }

    /// The cone surface.
    pub fn surface(&self) -> &'a ConeSurface {
        self.surface
    }

    /// The free vertices, in the order of the unknowns.
    pub fn free(&self) -> &[VertexId] {
        &self.free
    }

    /// The flat problem of the whole mesh; its triangles are the mesh's faces in order.
    pub fn problem(&self) -> FlatProblem {
        let mesh = &self.patched.mesh;
        let triangle = |f: crate::mesh::FaceId| {
            let chart = self.patched.face_patch[f];
            let see = |v: VertexId| corner(self.surface, self.holds[v], self.numbers[v], chart);
            FlatTriangle::with_rest(mesh.triangles()[f].map(see), mesh.corners(f))
        };
        FlatProblem::new(mesh.faces().map(triangle).collect(), self.free.len())
    }

    /// The unknowns of an embedding.
    pub fn points(&self, embedding: &Embedding) -> Vec<DVec2> {
        let point = |&v: &VertexId| -> DVec2 {
            let own = own_chart(self.holds[v]);
            let is_own = |h: &HalfedgeId| Some(self.patched.face_patch[h.face()]) == own;
            let corner: Option<HalfedgeId> = self.patched.mesh.star(v).find(is_own);
            corner.map_or(DVec2::NAN, |h| embedding.corners[h])
        };
        self.free.iter().map(point).collect()
    }

    /// The embedding of unknowns.
    pub fn embedding(&self, z: &[DVec2]) -> Embedding {
        let mesh = &self.patched.mesh;
        let corner = |h: HalfedgeId| {
            let v = mesh.tail(h);
            let own = z.get(self.numbers[v] as usize).copied().unwrap_or(DVec2::ZERO);
            seen(self.surface, self.holds[v], own, self.patched.face_patch[h.face()])
        };
        let transition = |h: HalfedgeId| {
            let (here, there) =
                (self.patched.face_patch[h.face()], self.patched.face_patch[mesh.twin(h).face()]);
            let sides = (0..3).map(|k| HalfedgeId::of(here, k));
            let border = sides.into_iter().find(|&b| self.surface.base.mesh.twin(b).face() == there);
            border.filter(|_| here != there).map_or(Rigid2::IDENTITY, |b| self.surface.transitions[b])
        };
        Embedding {
            face_chart: self.patched.face_patch.clone(),
            corners: mesh.halfedges().map(corner).collect(),
            transitions: mesh.halfedges().map(transition).collect(),
        }
    }
}

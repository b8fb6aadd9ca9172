//! A patched mesh coarsened down to its base domain by half-edge collapses, and back again one vertex at a time.
//!
//! Faces keep their patch: an interior vertex collapses into any neighbour, a path vertex only along its own path, a
//! landmark never (Hoppe 1996, restricted to the patches). Element numbers never change, so that undoing the collapses in
//! reverse order restores every intermediate mesh exactly.

use crate::layout::PatchedMesh;
use crate::mesh::coarsening::coarsen;
use crate::mesh::collapsible::{Collapse, CollapsibleMesh};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use glam::DVec3;
use typed_index_collections::TiVec;

/// What holds a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Stays: landmark `.0`, a vertex of the base domain.
    Landmark(VertexId),
    /// On the path of base halfedge `.0` (the smaller of its two).
    Path(HalfedgeId),
    /// Inside patch `.0`.
    Interior(FaceId),
}

/// What holds each vertex of a patched mesh.
pub fn holds(patched: &PatchedMesh, base: &crate::base_domain::BaseDomain) -> TiVec<VertexId, Hold> {
    let mesh = &patched.mesh;
    let patch = |v: VertexId| Hold::Interior(patched.face_patch[mesh.outgoing(v).face()]);
    let mut holds: TiVec<VertexId, Hold> = mesh.vertices().map(patch).collect();
    for h in base.mesh.edges() {
        patched.paths[h].iter().for_each(|&v| holds[v] = Hold::Path(h));
    }
    for (landmark, &v) in patched.landmark_vertices.iter_enumerated() {
        holds[v] = Hold::Landmark(landmark);
    }
    holds
}

/// The mesh at some level between the base domain and its full resolution.
pub struct ProgressiveMesh<'a> {
    patched: &'a PatchedMesh,
    holds: &'a TiVec<VertexId, Hold>,
    mesh: CollapsibleMesh,
    last_restored: Option<Collapse>,
}

impl<'a> ProgressiveMesh<'a> {
    /// The full resolution.
    pub fn new(patched: &'a PatchedMesh, holds: &'a TiVec<VertexId, Hold>) -> Self {
        Self { patched, holds, mesh: CollapsibleMesh::new(&patched.mesh), last_restored: None }
    }

    /// The connectivity of the present level.
    pub fn mesh(&self) -> &CollapsibleMesh {
        &self.mesh
    }

    /// The patch of a face.
    pub fn patch(&self, f: FaceId) -> FaceId {
        self.patched.face_patch[f]
    }

    /// What holds a vertex.
    pub fn hold(&self, v: VertexId) -> Hold {
        self.holds[v]
    }

    /// Position in space, area 1.
    pub fn position(&self, v: VertexId) -> DVec3 {
        self.patched.mesh.positions()[v]
    }

    /// Coarsens until the landmarks are left. Returns how many other vertices could not be removed.
    pub fn coarsen(&mut self) -> usize {
        let goal = self.patched.landmark_vertices.len();
        let Self { mesh, patched, holds, .. } = self;
        let patch = |h: HalfedgeId| patched.face_patch[h.face()];
        let may = |mesh: &CollapsibleMesh, h: HalfedgeId| match holds[mesh.tail(h)] {
            Hold::Landmark(_) => false,
            Hold::Path(_) => patch(h) != patch(mesh.twin(h)),
            Hold::Interior(_) => true,
        };
        coarsen(mesh, patched.mesh.positions(), goal, may) - goal
    }

    /// Undoes the last collapse and returns its vertex; `None` when the mesh has its full resolution again.
    pub fn restore(&mut self) -> Option<VertexId> {
        let collapse = self.mesh.restore()?;
        self.last_restored = Some(collapse);
        Some(collapse.removed)
    }

    /// Repeats the collapse that was just undone.
    pub fn collapse_again(&mut self) {
        if let Some(collapse) = self.last_restored.take() {
            self.mesh.collapse(collapse.halfedge);
        }
    }
}

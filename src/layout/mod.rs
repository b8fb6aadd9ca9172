//! The base domain drawn on both meshes: corresponding paths between landmarks, corresponding patches.
//!
//! The edges of the base domain become paths of mesh edges on refined copies of both meshes (edges and faces that a
//! path crosses are split), non-crossing, with the same cyclic order at every landmark on both sides. The patches
//! between them are discs, one per base face (Kraevoy & Sheffer 2004).

use crate::base_domain::BaseDomain;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use typed_index_collections::TiVec;

/// The base domain and its drawing on both meshes.
#[derive(Clone, Debug)]
pub struct BaseLayout {
    /// The base domain, its landmarks at the target's positions.
    pub base: BaseDomain,
    /// The drawing on the source.
    pub source: PatchedMesh,
    /// The drawing on the target.
    pub target: PatchedMesh,
}

/// A mesh refined along the paths of the base domain and cut into its patches.
#[derive(Clone, Debug)]
pub struct PatchedMesh {
    /// The refined mesh, scaled to area 1. Its first vertices are the input mesh's vertices in their order.
    pub mesh: SurfaceMesh,
    /// Where each refined vertex lies on the input mesh.
    pub vertex_origin: TiVec<VertexId, SurfacePoint>,
    /// The input face that contains each refined face.
    pub face_origin: TiVec<FaceId, FaceId>,
    /// The base face whose patch contains each refined face.
    pub face_patch: TiVec<FaceId, FaceId>,
    /// The refined mesh's vertex of each landmark (= vertex of the base domain).
    pub landmark_vertices: TiVec<VertexId, VertexId>,
    /// For each base halfedge the refined vertices of its path, both landmarks included; a twin's path is the reverse.
    /// Consecutive vertices are joined by mesh edges, and the patch of the halfedge's face lies on the left.
    pub paths: TiVec<HalfedgeId, Vec<VertexId>>,
}

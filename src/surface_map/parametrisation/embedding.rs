//! A seamless parametrisation of a mesh onto the flat cone surface.

use crate::landmarks::LandmarkId;
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::mesh::face_weights::FaceWeights;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec2;
use std::sync::Arc;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A piecewise linear map from a mesh to a [`crate::surface_map::ConeSurface`].
///
/// Every face is developed in a plane of its own; rigid motions join the planes of neighbours. At the landmarks, which are
/// the cones, an anchor joins a plane to a chart of the cone surface.
#[derive(Clone, Debug)]
pub struct Embedding {
    /// For each halfedge the image of its start, in the plane of its face.
    pub corners: TiVec<HalfedgeId, DVec2>,
    /// For each halfedge the rigid motion from the plane of its face to that of its twin's face. Fixed for the life of the
    /// embedding; around an ordinary vertex they come back to the identity.
    pub transitions: Arc<TiVec<HalfedgeId, Rigid2>>,
    /// The place of each landmark on the cone surface.
    pub anchors: Arc<TiVec<LandmarkId, Anchor>>,
}

impl Embedding {
    /// The corners of a face in its plane.
    #[inline]
    pub fn triangle(&self, f: FaceId) -> [DVec2; 3] {
        triangle(&self.corners, f)
    }
}

/// The corners of a face in its plane, where `corners` has those of all faces.
#[inline]
pub fn triangle(corners: &TiSlice<HalfedgeId, DVec2>, f: FaceId) -> [DVec2; 3] {
    f.halfedges().map(|h| corners[h])
}

/// The motion that takes a chart of the cone surface to a plane of the parametrisation, at a landmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// A halfedge of the mesh that starts at the landmark.
    pub corner: HalfedgeId,
    /// A base face at the landmark.
    pub chart: FaceId,
    /// From the chart to the plane of the corner's face, without going around the cone.
    pub motion: Rigid2,
}

/// A mesh with its parametrisation onto the common cone surface.
#[derive(Clone, Copy, Debug)]
pub struct Parametrised<'a> {
    /// The mesh, scaled to area 1; with caps, the target is scaled so that the skin that both meshes share has the same area on both.
    pub mesh: &'a SurfaceMesh,
    /// The mesh's vertex of each landmark.
    pub landmark_vertices: &'a TiSlice<LandmarkId, VertexId>,
    /// Its parametrisation.
    pub embedding: &'a Embedding,
    /// The weights of its faces in an energy of the map.
    pub weights: FaceWeights<'a>,
}

impl Parametrised<'_> {
    /// Whether each vertex is a landmark.
    pub fn landmark_flags(&self) -> TiVec<VertexId, bool> {
        let mut is_landmark = ti_vec![false; self.mesh.vertex_count()];
        self.landmark_vertices.iter().for_each(|&v| is_landmark[v] = true);
        is_landmark
    }
}

impl PatchedMesh {
    /// The patched mesh with a parametrisation.
    pub fn parametrised<'a>(&'a self, embedding: &'a Embedding) -> Parametrised<'a> {
        Parametrised {
            mesh: &self.mesh,
            landmark_vertices: &self.landmark_vertices,
            embedding,
            weights: FaceWeights::EVEN,
        }
    }
}

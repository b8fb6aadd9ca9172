//! A mesh of area 1 with its landmarks, refined around them so that a layout can be drawn.

use crate::landmarks::LandmarkId;
use crate::layout::PatchedMesh;
use crate::mesh::face_weights::{FaceWeight, FaceWeights};
use crate::mesh::{FaceId, MeshError, RefinedMesh, SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use typed_index_collections::{TiSlice, TiVec};

/// A mesh scaled to area 1, refined so that a layout has room around its landmarks.
#[derive(Clone)]
pub struct LandmarkedMesh {
    /// The refined mesh.
    pub refined: RefinedMesh,
    /// Its vertex of each landmark.
    pub landmarks: TiVec<LandmarkId, VertexId>,
    /// The weights of the faces; `None` where all are skin.
    weights: Option<Weights>,
}

/// The weights of faces in an energy of the map.
#[derive(Clone)]
struct Weights {
    /// The weight of each face of the input mesh.
    of_input: TiVec<FaceId, FaceWeight>,
    /// The weight of each face of the refined mesh.
    of_refined: TiVec<FaceId, FaceWeight>,
}

impl Weights {
    fn new(of_input: TiVec<FaceId, FaceWeight>, refined: &RefinedMesh) -> Self {
        let of_refined = refined.face_origin.iter().map(|&f| of_input[f]).collect();
        Self { of_input, of_refined }
    }
}

/// Edges at a landmark, at least. Around a landmark of degree 3, such as one inside a face, no layout's points can be removed again:
/// beside three straight edges there is no room for other paths. 6 was chosen by hand.
const LEAST_DEGREE: usize = 6;

/// Vertices of a level for each landmark, at least: a base domain of n landmarks has 2 n - 4 triangles, and each needs some vertices of
/// its own. With 42 vertices for 16 landmarks and 162 for 60, less than 3 for each, no layout had a map. Chosen by hand above that.
pub const LEAST_PER_LANDMARK: usize = 18;

impl LandmarkedMesh {
    /// A mesh with its landmarks.
    ///
    /// # Errors
    /// [`MeshError`] where a face cannot be bisected.
    pub fn new(mesh: &SurfaceMesh, landmarks: &[VertexId]) -> Result<Self, MeshError> {
        let refined =
            RefinedMesh::unrefined(mesh).with_vertices(mesh, LEAST_PER_LANDMARK * landmarks.len())?;
        let refined = refined.with_degrees(mesh, landmarks.iter().copied(), LEAST_DEGREE)?;
        Ok(Self { refined, landmarks: landmarks.iter().copied().collect(), weights: None })
    }

    /// A mesh with a drawing of a base domain, and refined along it.
    pub fn patched(side: &PatchedMesh) -> Self {
        Self { refined: side.refined(), landmarks: side.landmark_vertices.clone(), weights: None }
    }

    /// The same mesh with the weights of the faces of the input mesh; `None` where all are skin.
    #[must_use]
    pub fn with_weights(self, of_input: Option<TiVec<FaceId, FaceWeight>>) -> Self {
        Self { weights: of_input.map(|of_input| Weights::new(of_input, &self.refined)), ..self }
    }

    /// The same mesh, `factor` times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { refined: self.refined.scaled(factor), ..self.clone() }
    }

    /// The weights of the faces of the refined mesh; all 1 where all are skin.
    pub fn weights(&self) -> FaceWeights<'_> {
        FaceWeights::new(self.weights_by_face())
    }

    /// The weights of the faces of the refined mesh; `None` where all are skin.
    pub(super) fn weights_by_face(&self) -> Option<&TiSlice<FaceId, FaceWeight>> {
        self.weights.as_ref().map(|weights| weights.of_refined.as_slice())
    }

    /// The same mesh with further points of the refined mesh as vertices, and the vertex of each; `landmarks` stay as they are.
    ///
    /// # Errors
    /// [`MeshError`] where a point cannot be inserted.
    pub(super) fn with_points(
        &self,
        input: &SurfaceMesh,
        points: &[SurfacePoint],
    ) -> Result<(Self, Vec<VertexId>), MeshError> {
        let (refined, vertices) = self.refined.with_points(input, points)?;
        Ok((self.refined_to(refined), vertices))
    }

    /// The same mesh, refined around further vertices of it so that a layout has room there.
    ///
    /// # Errors
    /// [`MeshError`] where a face cannot be bisected.
    pub(super) fn with_room_around(
        &self,
        input: &SurfaceMesh,
        vertices: &[VertexId],
    ) -> Result<Self, MeshError> {
        Ok(self.refined_to(self.refined.with_degrees(input, vertices.iter().copied(), LEAST_DEGREE)?))
    }

    /// The same mesh, refined further.
    fn refined_to(&self, refined: RefinedMesh) -> Self {
        let weights = self.weights.as_ref().map(|known| Weights::new(known.of_input.clone(), &refined));
        Self { refined, landmarks: self.landmarks.clone(), weights }
    }

    /// The mesh with a parametrisation.
    pub fn parametrised<'a>(&'a self, embedding: &'a Embedding) -> Parametrised<'a> {
        let (mesh, weights) = (&self.refined.mesh, self.weights());
        Parametrised { mesh, landmark_vertices: &self.landmarks, embedding, weights }
    }
}

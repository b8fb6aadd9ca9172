//! A mesh of area 1 with its landmarks and room for a layout around them.

use crate::landmarks::LandmarkId;
use crate::mesh::{MeshError, RefinedMesh, SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use typed_index_collections::TiVec;

/// A mesh scaled to area 1, refined so that a layout has room around its landmarks.
#[derive(Clone)]
pub struct LandmarkedMesh {
    /// The refined mesh.
    pub refined: RefinedMesh,
    /// Its vertex of each landmark.
    pub landmarks: TiVec<LandmarkId, VertexId>,
}

/// Edges at a landmark, at least. Around a landmark of degree 3, such as one inside a face, no layout's points can be taken
/// out again: with three edges straight there is no room for the paths between them.
const LEAST_DEGREE: usize = 6;

/// Vertices for each landmark, at least: a base domain of n landmarks has 2 n - 4 triangles, and each needs some vertices of
/// its own. With 42 vertices for 16 landmarks and 162 for 60 no layout had a map.
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
        Ok(Self { refined, landmarks: landmarks.iter().copied().collect() })
    }

    /// The same mesh with room around further points of the refined mesh, and the vertex of each; `landmarks` stay as they are.
    ///
    /// # Errors
    /// [`MeshError`] where a point cannot be inserted.
    pub(super) fn with_room_at(
        &self,
        input: &SurfaceMesh,
        points: &[SurfacePoint],
    ) -> Result<(Self, Vec<VertexId>), MeshError> {
        let (refined, vertices) = self.refined.with_points(input, points)?;
        let refined = refined.with_degrees(input, vertices.iter().copied(), LEAST_DEGREE)?;
        Ok((Self { refined, landmarks: self.landmarks.clone() }, vertices))
    }

    /// The mesh with a parametrisation.
    pub fn parametrised<'a>(&'a self, embedding: &'a Embedding) -> Parametrised<'a> {
        Parametrised { mesh: &self.refined.mesh, landmark_vertices: &self.landmarks, embedding }
    }
}

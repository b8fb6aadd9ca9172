//! A mesh that refines an input mesh, and points carried between the two.

use super::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use typed_index_collections::TiVec;

/// A mesh that refines an input mesh, of area 1.
#[derive(Clone, Debug)]
pub struct RefinedMesh {
    /// The refined mesh. Its first vertices are the input mesh's vertices in their order.
    pub mesh: SurfaceMesh,
    /// Where each refined vertex lies on the input mesh.
    pub vertex_origin: TiVec<VertexId, SurfacePoint>,
    /// The input face that contains each refined face.
    pub face_origin: TiVec<FaceId, FaceId>,
}

impl RefinedMesh {
    /// The input mesh itself, scaled to area 1.
    pub fn unrefined(input: &SurfaceMesh) -> Self {
        let scale = 1.0 / input.area().sqrt();
        Self {
            mesh: input.with_positions(input.positions().iter().map(|&p| p * scale).collect()),
            vertex_origin: input.vertices().map(|v| SurfacePoint::at_vertex(input, v)).collect(),
            face_origin: input.faces().collect(),
        }
    }

    /// Barycentric coordinates, in the input face of a refined face, of its three corners.
    pub fn origins_in_face(&self, input: &SurfaceMesh, face: FaceId) -> [[f64; 3]; 3] {
        let corners = input.triangles()[self.face_origin[face]];
        self.mesh.triangles()[face].map(|v| {
            let origin = self.vertex_origin[v];
            let named = input.triangles()[origin.face];
            corners.map(|c| (0..3).filter(|&k| named[k] == c).map(|k| origin.barycentric[k]).sum())
        })
    }

    /// A point of a refined face as a point of its input face.
    pub fn on_input(&self, input: &SurfaceMesh, point: SurfacePoint) -> SurfacePoint {
        let rows = self.origins_in_face(input, point.face);
        let weight = |c: usize| (0..3).map(|k| rows[k][c] * point.barycentric[k]).sum();
        SurfacePoint { face: self.face_origin[point.face], barycentric: [weight(0), weight(1), weight(2)] }
    }
}

//! The base domain: a triangulation of the sphere with the landmarks as vertices.

use crate::landmarks::LandmarkId;
use crate::mesh::SurfaceMesh;
use typed_index_collections::TiVec;

/// A triangulation of the sphere with one vertex per landmark.
#[derive(Clone, Debug)]
pub struct BaseDomain {
    /// Vertex k is landmark k; positions are those of the landmarks on the simplified mesh (by default the target).
    pub mesh: SurfaceMesh,
}

impl BaseDomain {
    /// Sum of the angles of the base domain's triangles at each landmark, in radians: the cone angles.
    ///
    /// Their angle defects `2 pi - angle` sum to 4 pi (Gauss-Bonnet).
    pub fn cone_angles(&self) -> TiVec<LandmarkId, f64> {
        let mesh = &self.mesh;
        let angle = |h: crate::mesh::HalfedgeId| {
            let p = mesh.positions();
            crate::math::triangle::angle_at(p[mesh.tail(h)], p[mesh.head(h)], p[mesh.tail(h.prev())])
        };
        mesh.vertices().map(|v| mesh.star(v).map(angle).sum()).collect()
    }
}

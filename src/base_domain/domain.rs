//! The base domain: a triangulation of the sphere with the landmarks as vertices.

use crate::landmarks::LandmarkId;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// The landmark that a vertex of the base domain is.
fn landmark(v: VertexId) -> LandmarkId {
    LandmarkId(v.0)
}

/// A triangulation of the sphere with one vertex per landmark.
#[derive(Clone, Debug)]
pub struct BaseDomain {
    /// Vertex k is landmark k; positions are those of the landmarks on the simplified mesh (by default the target).
    pub mesh: SurfaceMesh,
}

impl BaseDomain {
    /// All landmarks.
    pub fn landmarks(&self) -> impl ExactSizeIterator<Item = LandmarkId> + use<> {
        self.mesh.vertices().map(landmark)
    }

    /// The landmark at which a base halfedge starts.
    pub fn tail(&self, h: HalfedgeId) -> LandmarkId {
        landmark(self.mesh.tail(h))
    }

    /// The landmark at which a base halfedge ends.
    pub fn head(&self, h: HalfedgeId) -> LandmarkId {
        landmark(self.mesh.head(h))
    }

    /// The base halfedges that start at a landmark, counter-clockwise.
    pub fn star(&self, l: LandmarkId) -> impl Iterator<Item = HalfedgeId> + '_ {
        self.mesh.star(VertexId(l.0))
    }

    /// Sum of the angles of the base domain's triangles at each landmark, in radians: the cone angles.
    ///
    /// Their angle defects `2 pi - angle` sum to 4 pi (Gauss-Bonnet).
    pub fn cone_angles(&self) -> TiVec<LandmarkId, f64> {
        let mesh = &self.mesh;
        let angle = |h: HalfedgeId| {
            let p = mesh.positions();
            crate::math::triangle::angle_at(p[mesh.tail(h)], p[mesh.head(h)], p[mesh.tail(h.prev())])
        };
        mesh.vertices().map(|v| mesh.star(v).map(angle).sum()).collect()
    }
}

//! Places on a mesh by the least element that holds them: a vertex, an edge or a face.
//!
//! A [`SurfacePoint`] names one face; a point of an edge has two such names, a vertex as many as faces. A place has one name only,
//! and is the same seen from every face around it.

use super::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;

/// A point of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A vertex.
    Vertex(VertexId),
    /// A point of an edge that is none of its ends.
    Edge {
        /// The smaller of the edge's halfedges.
        halfedge: HalfedgeId,
        /// Weight of the halfedge's end, between 0 and 1; its start has the rest.
        along: f64,
    },
    /// A point inside a face.
    Face(SurfacePoint),
}

impl Place {
    /// The place of a point: weights that are exactly 0 tell that it lies on an edge or at a vertex.
    pub fn of(mesh: &SurfaceMesh, point: SurfacePoint) -> Self {
        let weights = point.barycentric;
        let corner = |k: usize| HalfedgeId::of(point.face, k);
        match weights.map(|w| w == 0.0) {
            [false, true, true] => Self::Vertex(mesh.tail(corner(0))),
            [true, false, true] => Self::Vertex(mesh.tail(corner(1))),
            [true, true, false] => Self::Vertex(mesh.tail(corner(2))),
            [true, false, false] => Self::on_edge(mesh, corner(1), weights[2]),
            [false, true, false] => Self::on_edge(mesh, corner(2), weights[0]),
            [false, false, true] => Self::on_edge(mesh, corner(0), weights[1]),
            _ => Self::Face(point),
        }
    }

    /// The point of a halfedge whose end has this weight, between 0 and 1.
    pub fn on_edge(mesh: &SurfaceMesh, halfedge: HalfedgeId, along: f64) -> Self {
        let twin = mesh.twin(halfedge);
        if halfedge < twin {
            Self::Edge { halfedge, along }
        } else {
            Self::Edge { halfedge: twin, along: 1.0 - along }
        }
    }

    /// The place as a point of one of the faces that hold it.
    pub fn surface_point(self, mesh: &SurfaceMesh) -> SurfacePoint {
        match self {
            Self::Vertex(v) => SurfacePoint::at_vertex(mesh, v),
            Self::Edge { halfedge, along } => SurfacePoint::on_halfedge(halfedge, along),
            Self::Face(point) => point,
        }
    }

    /// Its weights in a face; `None` where the face does not hold it.
    pub fn weights_in(self, mesh: &SurfaceMesh, face: FaceId) -> Option<[f64; 3]> {
        match self {
            Self::Vertex(v) => {
                let corner = mesh.corner_at(face, v)?.corner();
                Some([0, 1, 2].map(|k| if k == corner { 1.0 } else { 0.0 }))
            }
            Self::Edge { halfedge, along } if halfedge.face() == face => {
                Some(SurfacePoint::on_halfedge(halfedge, along).barycentric)
            }
            Self::Edge { halfedge, along } => {
                let twin = mesh.twin(halfedge);
                (twin.face() == face).then(|| SurfacePoint::on_halfedge(twin, 1.0 - along).barycentric)
            }
            Self::Face(point) => (point.face == face).then_some(point.barycentric),
        }
    }

    /// Position in space.
    pub fn position(self, mesh: &SurfaceMesh) -> DVec3 {
        match self {
            Self::Vertex(v) => mesh.positions()[v],
            _ => self.surface_point(mesh).position(mesh),
        }
    }

    /// A key that is equal for equal places.
    pub fn key(self) -> PlaceKey {
        match self {
            Self::Vertex(v) => PlaceKey(0, v.0, [0; 2]),
            Self::Edge { halfedge, along } => PlaceKey(1, halfedge.0, [along.to_bits(), 0]),
            Self::Face(SurfacePoint { face, barycentric: [_, b, c] }) => {
                PlaceKey(2, face.0, [b.to_bits(), c.to_bits()])
            }
        }
    }
}

/// A key that is equal for equal places: the element and the bits of its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlaceKey(u8, u32, [u64; 2]);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn a_place_is_the_same_from_every_face() {
        let mesh = icosphere(1);
        for h in mesh.halfedges() {
            let twin = mesh.twin(h);
            let [here, there] = [SurfacePoint::on_halfedge(h, 0.25), SurfacePoint::on_halfedge(twin, 0.75)];
            let place = Place::of(&mesh, here);
            assert_eq!(place, Place::of(&mesh, there));
            assert_eq!(place.weights_in(&mesh, h.face()), Some(here.barycentric));
            assert_eq!(place.weights_in(&mesh, twin.face()), Some(there.barycentric));
            assert!(place.position(&mesh).distance(here.position(&mesh)) < 1e-15);
            let v = mesh.tail(h);
            let corner = SurfacePoint::on_halfedge(h, 0.0);
            assert_eq!(Place::of(&mesh, corner), Place::Vertex(v));
            assert_eq!(Place::Vertex(v).weights_in(&mesh, h.face()), Some(corner.barycentric));
        }
        let outside =
            (0..mesh.face_count()).map(FaceId::from).find(|&f| !mesh.triangles()[f].contains(&VertexId(0)));
        assert_eq!(Place::Vertex(VertexId(0)).weights_in(&mesh, outside.unwrap()), None);
        let inside = SurfacePoint { face: FaceId(3), barycentric: [0.2, 0.3, 0.5] };
        assert_eq!(Place::of(&mesh, inside), Place::Face(inside));
        assert_eq!(Place::Face(inside).weights_in(&mesh, FaceId(4)), None);
    }
}

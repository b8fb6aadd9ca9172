//! How much each face of a mesh counts: skin fully, caps (faces made up to close holes) little.

use super::{FaceId, SurfaceMesh, VertexId};
use crate::math::scalar::min;
use typed_index_collections::TiSlice;

/// The weights of the faces of a mesh, from 0 to 1: skin has 1.
#[derive(Clone, Copy, Debug, Default)]
pub struct FaceWeights<'a>(Option<&'a TiSlice<FaceId, f64>>);

impl<'a> FaceWeights<'a> {
    /// Of a mesh that is all skin.
    pub const EVEN: Self = Self(None);

    /// Given by face; `None` for a mesh that is all skin.
    pub fn new(weights: Option<&'a TiSlice<FaceId, f64>>) -> Self {
        Self(weights)
    }

    /// The weight of a face.
    ///
    /// # Panics
    /// When the face does not exist.
    #[inline]
    pub fn of(self, face: FaceId) -> f64 {
        self.0.map_or(1.0, |weights| weights[face])
    }

    /// Whether at least half of a face is skin.
    #[inline]
    pub fn is_skin(self, face: FaceId) -> bool {
        self.of(face) >= 0.5
    }

    /// Whether a vertex of the mesh has a face of skin: vertices on rims have.
    pub fn is_on_skin(self, mesh: &SurfaceMesh, v: VertexId) -> bool {
        self.0.is_none() || mesh.star(v).any(|h| self.is_skin(h.face()))
    }
}

/// The weight of a piece of the overlay of two meshes: the smaller one of its faces on both.
#[inline]
pub fn piece_weight(weights: [FaceWeights<'_>; 2], faces: [FaceId; 2]) -> f64 {
    min(weights[0].of(faces[0]), weights[1].of(faces[1]))
}

/// Whether a piece of the overlay of two meshes is skin on both.
#[inline]
pub fn is_skin_on_both(weights: [FaceWeights<'_>; 2], faces: [FaceId; 2]) -> bool {
    weights[0].is_skin(faces[0]) && weights[1].is_skin(faces[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use typed_index_collections::TiVec;

    #[test]
    fn a_vertex_is_on_skin_where_one_face_is() {
        let ball = icosphere(1);
        // All faces around vertex 0 are a cap.
        let mut weights: TiVec<FaceId, f64> = ball.faces().map(|_| 1.0).collect();
        ball.star(VertexId(0)).for_each(|h| weights[h.face()] = 0.01);
        let counted = FaceWeights::new(Some(&weights));
        let off: Vec<VertexId> = ball.vertices().filter(|&v| !counted.is_on_skin(&ball, v)).collect();
        assert_eq!(off, [VertexId(0)]);
        assert!(ball.vertices().all(|v| FaceWeights::EVEN.is_on_skin(&ball, v)));
        let cap = ball.outgoing(VertexId(0)).face();
        assert_eq!(piece_weight([FaceWeights::EVEN, counted], [FaceId(0), cap]), 0.01);
        assert!(!is_skin_on_both([counted, FaceWeights::EVEN], [cap, FaceId(0)]));
        assert!(is_skin_on_both([FaceWeights::EVEN; 2], [cap, cap]));
    }
}

//! The weights of the faces of a mesh: skin counts fully, and caps (faces made up to close holes) little.

use super::{FaceId, SurfaceMesh, VertexId};
use crate::math::scalar::min;
use typed_index_collections::TiSlice;

/// The weight of a face in an energy of maps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceWeight {
    /// The weight, from 0 to 1: skin has 1.
    pub weight: f64,
    /// The cost per unit of area of lying over a face that has no toll, not negative; half the cost of an isometry is 1. Skin has
    /// none, nor has a cap under which nothing is known; a cap whose rim corresponds to a rim of the other mesh has one.
    pub toll: f64,
}

impl FaceWeight {
    /// The weight of skin.
    pub const SKIN: Self = Self { weight: 1.0, toll: 0.0 };
}

/// The weight of a piece of the overlay of two meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceWeight {
    /// The weight, from 0 to 1, which is the smaller one of both faces: 1 where both are skin.
    pub weight: f64,
    /// The cost per unit of area of faces that do not belong together: the difference of their tolls.
    pub toll: f64,
}

impl PieceWeight {
    /// The weight of a piece that is skin on both meshes.
    pub const SKIN: Self = Self { weight: 1.0, toll: 0.0 };

    /// The weight of a piece of two faces.
    #[inline]
    pub fn of([a, b]: [FaceWeight; 2]) -> Self {
        Self { weight: min(a.weight, b.weight), toll: (a.toll - b.toll).abs() }
    }
}

/// The weights of the faces of a mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct FaceWeights<'a>(Option<&'a TiSlice<FaceId, FaceWeight>>);

impl<'a> FaceWeights<'a> {
    /// The weights of a mesh that is all skin.
    pub const EVEN: Self = Self(None);

    /// The weights that are given by face; `None` for a mesh that is all skin.
    pub fn new(weights: Option<&'a TiSlice<FaceId, FaceWeight>>) -> Self {
        Self(weights)
    }

    /// The weight of a face.
    ///
    /// # Panics
    /// When the face does not exist.
    #[inline]
    pub fn of(self, face: FaceId) -> FaceWeight {
        self.0.map_or(FaceWeight::SKIN, |weights| weights[face])
    }

    /// Whether at least half of a face is skin.
    #[inline]
    pub fn is_skin(self, face: FaceId) -> bool {
        self.of(face).weight >= 0.5
    }

    /// Whether a vertex of the mesh has a face of skin: vertices on rims have.
    pub fn is_on_skin(self, mesh: &SurfaceMesh, v: VertexId) -> bool {
        self.0.is_none() || mesh.star(v).any(|h| self.is_skin(h.face()))
    }
}

/// The weight of a piece of the overlay of two meshes.
#[inline]
pub fn piece_weight(weights: [FaceWeights<'_>; 2], faces: [FaceId; 2]) -> PieceWeight {
    PieceWeight::of([weights[0].of(faces[0]), weights[1].of(faces[1])])
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
        let mut weights: TiVec<FaceId, FaceWeight> = ball.faces().map(|_| FaceWeight::SKIN).collect();
        let of_cap = FaceWeight { weight: 0.01, toll: 0.5 };
        ball.star(VertexId(0)).for_each(|h| weights[h.face()] = of_cap);
        let counted = FaceWeights::new(Some(&weights));
        let off: Vec<VertexId> = ball.vertices().filter(|&v| !counted.is_on_skin(&ball, v)).collect();
        assert_eq!(off, [VertexId(0)]);
        assert!(ball.vertices().all(|v| FaceWeights::EVEN.is_on_skin(&ball, v)));
        let cap = ball.outgoing(VertexId(0)).face();
        let over_skin = PieceWeight { weight: 0.01, toll: 0.5 };
        assert_eq!(piece_weight([FaceWeights::EVEN, counted], [FaceId(0), cap]), over_skin);
        assert_eq!(piece_weight([counted, FaceWeights::EVEN], [cap, FaceId(0)]), over_skin);
        assert_eq!(piece_weight([counted; 2], [cap; 2]), PieceWeight { weight: 0.01, toll: 0.0 });
        assert_eq!(piece_weight([FaceWeights::EVEN; 2], [cap; 2]), PieceWeight::SKIN);
        assert!(!is_skin_on_both([counted, FaceWeights::EVEN], [cap, FaceId(0)]));
        assert!(is_skin_on_both([FaceWeights::EVEN; 2], [cap, cap]));
    }
}

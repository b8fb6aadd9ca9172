//! The pieces of a map, listed by the face in which they lie.

use super::pieces::Correspondence;
use crate::landmarks::MeshSide;
use crate::mesh::FaceId;
use typed_index_collections::{TiVec, ti_vec};

/// The numbers of the pieces in each face of the source or of the target.
#[derive(Clone, Debug)]
pub struct PiecesByFace {
    /// First entry of each face in `pieces`, and the end.
    begins: TiVec<FaceId, u32>,
    pieces: Vec<u32>,
}

impl PiecesByFace {
    /// Sorts the pieces by their face of one mesh, which has `faces` faces.
    pub fn new(map: &Correspondence, side: MeshSide, faces: usize) -> Self {
        let mut begins: TiVec<FaceId, u32> = ti_vec![0; faces + 1];
        for piece in &map.pieces {
            begins[FaceId::from(piece.faces[side].index() + 1)] += 1;
        }
        let mut sum = 0;
        for count in begins.iter_mut() {
            sum += *count;
            *count = sum;
        }
        let mut ends = begins.clone();
        let mut pieces = vec![0; map.pieces.len()];
        for (k, piece) in map.pieces.iter().enumerate() {
            let end = &mut ends[piece.faces[side]];
            pieces[*end as usize] = k as u32;
            *end += 1;
        }
        Self { begins, pieces }
    }

    /// The numbers of the pieces in a face.
    pub fn of(&self, face: FaceId) -> &[u32] {
        let end = self.begins[FaceId::from(face.index() + 1)];
        &self.pieces[self.begins[face] as usize..end as usize]
    }
}

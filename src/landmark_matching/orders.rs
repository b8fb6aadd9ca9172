//! The agreement of two bodies in the orders in which shortest paths lead to their marks.

use super::agreement::turns_left;
use super::shape::Shape;
use crate::landmarks::MeshSide;

/// Share of the cyclic orders of three marks around a fourth that are the same on both bodies; 1 where there are fewer than four pairs.
pub(super) fn agreement(shapes: [&Shape; 2], pairs: &[[usize; 2]]) -> f64 {
    let (mut same, mut all) = (0, 0);
    for (root, of) in pairs.iter().enumerate() {
        let ranks = MeshSide::BOTH.map(|side| &shapes[side].marks[of[side]].ranks);
        let others: Vec<[u32; 2]> = (0..pairs.len())
            .filter(|&k| k != root)
            .map(|k| MeshSide::BOTH.map(|side| ranks[side][pairs[k][side]]))
            .collect();
        for (i, a) in others.iter().enumerate() {
            for (j, b) in others[..i].iter().enumerate() {
                for c in &others[..j] {
                    all += 1;
                    let turns = MeshSide::BOTH.map(|side| turns_left([a[side], b[side], c[side]]));
                    same += usize::from(turns[0] == turns[1]);
                }
            }
        }
    }
    if all == 0 { 1.0 } else { same as f64 / all as f64 }
}

//! Small changes of an assignment, which the search over main tips does not try.
//!
//! Whether nose, ear or crown is the main tip of a head differs from body to body, and so do small tips that both have: the coarse map
//! judges which assignment of them is better.

use super::between::between;
use super::search::{Assignment, Tables};
use crate::landmarks::{LEAST_LANDMARKS, MeshSide};

/// A tip may be replaced by one of the same body within this distance, in units of the root of the area. Chosen by hand.
pub(super) const NEAR: f64 = 0.45;
/// Small tips are paired where their mean misfit (log ratio of distances) is below this. Chosen by hand.
const FITS: f64 = 0.25;

/// With at most this many pairs a further one is tried: the map may wind either way round the body. Chosen by hand.
const FEW: usize = 5;

/// Exchanges that are judged, at most. Chosen by hand.
const EXCHANGES: usize = 3;

/// The assignment `from` with the partners of two near tips exchanged, as those of left and right ears; the cheapest ones.
pub(super) fn exchanged(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let mut found = Vec::new();
    for k in given..from.pairs.len() {
        for l in given..k {
            if are_near(tables, [from.pairs[k], from.pairs[l]]) {
                let mut pairs = from.pairs.clone();
                (pairs[k][1], pairs[l][1]) = (pairs[l][1], pairs[k][1]);
                found.push(tables.changed(from, &pairs));
            }
        }
    }
    found.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
    found.truncate(EXCHANGES);
    found
}

/// Whether two pairs are near each other on both bodies.
pub(super) fn are_near(tables: &Tables<'_>, pairs: [[usize; 2]; 2]) -> bool {
    MeshSide::BOTH.iter().all(|&side| tables.shapes[side].distance(pairs.map(|pair| pair[side])) < NEAR)
}

/// The pairs of marks without a partner in `pairs` that fit it, each with its misfit.
pub(super) fn fitting(tables: &Tables<'_>, pairs: &[[usize; 2]]) -> Vec<(f64, [usize; 2])> {
    let mut fitting = Vec::new();
    for s in free(tables, pairs, MeshSide::Source) {
        for t in free(tables, pairs, MeshSide::Target) {
            let misfit = tables.mean_misfit([s, t], pairs);
            if misfit < FITS {
                fitting.push((misfit, [s, t]));
            }
        }
    }
    fitting
}

/// The marks of a body without a partner in `pairs`, which has the given ones.
fn free(tables: &Tables<'_>, pairs: &[[usize; 2]], side: MeshSide) -> Vec<usize> {
    let shape = tables.shapes[side];
    (shape.given..shape.marks.len()).filter(|k| pairs.iter().all(|pair| pair[side] != *k)).collect()
}

/// Assignments that differ little from one, the cheapest first.
pub(super) fn moves(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let pairs = &from.pairs;
    let free = MeshSide::BOTH.map(|side| free(tables, pairs, side));
    let mut changed: Vec<Vec<[usize; 2]>> = Vec::new();
    for k in given..pairs.len() {
        for side in MeshSide::BOTH {
            for &mark in &free[side] {
                if tables.shapes[side].distance([pairs[k][side], mark]) < NEAR {
                    let mut next = pairs.clone();
                    next[k][side] = mark;
                    changed.push(next);
                }
            }
        }
        if pairs.len() > LEAST_LANDMARKS {
            let mut next = pairs.clone();
            next.remove(k);
            changed.push(next);
        }
    }
    let further = fitting(tables, pairs).into_iter().map(|(_, pair)| [&pairs[..], &[pair]].concat());
    changed.extend(further);
    let mut moves: Vec<Assignment> = changed
        .iter()
        .filter(|pairs| pairs.len() >= LEAST_LANDMARKS)
        .map(|pairs| tables.assignment(pairs))
        .collect();
    moves.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
    if from.between.is_none() && pairs.len() <= FEW {
        let places = between(tables.shapes, pairs).into_iter();
        let with = places.map(|pair| Assignment { between: Some(pair), ..from.clone() });
        moves.splice(0..0, with);
    }
    moves
}

#[cfg(test)]
mod tests {
    use super::super::options::MatchOptions;
    use super::super::test_bodies::{ENDS, ball_with_ends, shape};
    use super::*;
    use glam::DVec3;

    #[test]
    fn partners_of_ears_are_exchanged_and_those_of_feet_are_not() {
        let ears = [0.35, -0.35].map(|y| (DVec3::new(0.9, y, 0.8), 0.7));
        let feet = ENDS[..4].iter().map(|&end| (end, 2.0));
        let body = shape(&ball_with_ends(&feet.chain(ears).collect::<Vec<_>>(), 30.0));
        let tables = Tables::new([&body; 2], &MatchOptions::default());
        let own: Vec<[usize; 2]> = body.tips().map(|k| [k; 2]).collect();
        assert_eq!(own.len(), 6);
        let from = tables.assignment(&own);
        let found = exchanged(&tables, &from);
        let moved: Vec<usize> = found[0].pairs.iter().filter(|[s, t]| s != t).map(|pair| pair[0]).collect();
        assert_eq!((found.len(), moved.len()), (1, 2));
        for k in moved {
            assert!(body.level.mesh.positions()[body.marks[k].vertex].z > 0.0);
        }
    }
}

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
pub(super) const FITS: f64 = 0.25;

/// With at most this many pairs a further one is tried: the map may wind either way round the body. Chosen by hand.
const FEW: usize = 5;

/// Exchanges that are judged, at most. Chosen by hand.
const EXCHANGES: usize = 3;

/// The assignment `from` with the partners of two near tips exchanged, as those of left and right ears; the cheapest ones.
pub(super) fn exchanged(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let near = |pairs: [&[usize; 2]; 2]| {
        MeshSide::BOTH.iter().all(|&s| tables.shapes[s].distance(pairs.map(|pair| pair[s])) < NEAR)
    };
    let mut found = Vec::new();
    for k in given..from.pairs.len() {
        for l in given..k {
            if near([&from.pairs[k], &from.pairs[l]]) {
                let mut pairs = from.pairs.clone();
                (pairs[k][1], pairs[l][1]) = (pairs[l][1], pairs[k][1]);
                found.push(Assignment { between: from.between, ..tables.assignment(&pairs) });
            }
        }
    }
    found.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
    found.truncate(EXCHANGES);
    found
}

/// Assignments that differ little from one, the cheapest first.
pub(super) fn moves(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let pairs = &from.pairs;
    let free = |side: MeshSide| {
        let shape = tables.shapes[side];
        (shape.given..shape.marks.len()).filter(move |&k| pairs.iter().all(|pair| pair[side] != k))
    };
    let mut changed: Vec<Vec<[usize; 2]>> = Vec::new();
    for k in given..pairs.len() {
        for side in MeshSide::BOTH {
            for mark in free(side).filter(|&m| tables.shapes[side].distance([pairs[k][side], m]) < NEAR) {
                let mut next = pairs.clone();
                next[k][side] = mark;
                changed.push(next);
            }
        }
        if pairs.len() > LEAST_LANDMARKS {
            let mut next = pairs.clone();
            next.remove(k);
            changed.push(next);
        }
    }
    for s in free(MeshSide::Source) {
        for t in free(MeshSide::Target) {
            if tables.mean_misfit([s, t], pairs) < FITS {
                changed.push(pairs.iter().copied().chain([[s, t]]).collect());
            }
        }
    }
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

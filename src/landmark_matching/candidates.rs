//! Which assignments are judged by their maps.

use super::between::{LEAST_TO_PLACE, between};
use super::options::MatchOptions;
use super::search::Assignment;
use super::shape::Shape;
use crate::landmarks::LEAST_LANDMARKS;

/// Candidates with the same pairs of main tips, at most.
const SAME_MAIN: usize = 2;

/// The assignments to judge, the most promising first: the first `options.candidates` by cost with few of the same main pairs, then
/// some that keep symmetric partners together, some by cost without regard to orders, then the others for a second look.
pub(super) fn chosen(
    shapes: [&Shape; 2],
    mut all: Vec<Assignment>,
    options: &MatchOptions,
) -> Vec<Assignment> {
    let partners = shapes.map(Shape::partners);
    all.retain(|assignment| assignment.pairs.len() >= LEAST_TO_PLACE);
    let is_main = |side: usize, k: usize| shapes[side].marks[k].persistence >= options.main_persistence;
    let main_pairs = |assignment: &Assignment| {
        let pairs = assignment.pairs.iter().filter(|[s, t]| is_main(0, *s) && is_main(1, *t));
        let mut pairs: Vec<[usize; 2]> = pairs.copied().collect();
        pairs.sort_unstable();
        pairs
    };
    let blind = all.clone();
    all.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
    let mut kinds: Vec<Vec<[usize; 2]>> = Vec::new();
    let mut chosen: Vec<Assignment> = Vec::new();
    let mut take = |from: &[Assignment], most: usize, chosen: &mut Vec<Assignment>| {
        let goal = chosen.len() + most;
        for assignment in from {
            if chosen.len() >= goal {
                break;
            }
            let kind = main_pairs(assignment);
            if !chosen.contains(assignment) && kinds.iter().filter(|k| **k == kind).count() < SAME_MAIN {
                kinds.push(kind);
                chosen.push(assignment.clone());
            }
        }
    };
    take(&all, options.candidates, &mut chosen);
    let symmetric: Vec<Assignment> = all.iter().filter(|a| is_symmetric(&partners, a)).cloned().collect();
    take(&symmetric, options.symmetric, &mut chosen);
    // A long tail that only one of both has must not drive a leg to the other's head.
    let one_missing = |a: &&Assignment| a.unmatched[0] + a.unmatched[1] == 1;
    let mut missing: Vec<Assignment> = all.iter().filter(one_missing).cloned().collect();
    let rest = |a: &Assignment| a.full_cost() - a.unmatched_cost;
    missing.sort_by(|a, b| rest(a).total_cmp(&rest(b)));
    take(&missing, options.one_missing, &mut chosen);
    take(&blind, options.without_orders, &mut chosen);
    take(&all, options.more_candidates, &mut chosen);
    let with_room = |assignment: Assignment| -> Vec<Assignment> {
        if assignment.pairs.len() >= LEAST_LANDMARKS {
            return vec![assignment];
        }
        let places = between(shapes, &assignment.pairs).into_iter();
        places.map(|pair| Assignment { between: Some(pair), ..assignment.clone() }).collect()
    };
    chosen.into_iter().flat_map(with_room).collect()
}

/// Whether partners go to partners, and what has none to what has none: as when two symmetric bodies are laid side by side.
fn is_symmetric(partners: &[Vec<Option<usize>>; 2], assignment: &Assignment) -> bool {
    let image = |s: usize| assignment.pairs.iter().find(|pair| pair[0] == s).map(|pair| pair[1]);
    assignment.pairs.iter().all(|&[s, t]| match (partners[0][s], partners[1][t]) {
        (Some(other), Some(expected)) => image(other) == Some(expected),
        (None, None) => true,
        _ => false,
    })
}

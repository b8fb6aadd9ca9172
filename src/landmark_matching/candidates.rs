//! The choice of the assignments that are judged by their maps.

use super::between::{LEAST_TO_PLACE, between};
use super::options::MatchOptions;
use super::search::{Assignment, Tables};
use super::symmetry::{Turns, equivariant};
use crate::landmarks::{LEAST_LANDMARKS, MeshSide};

/// Candidates with the same pairs of main tips, at most. Chosen by hand.
const SAME_MAIN: usize = 2;

/// The assignments to judge, the most promising first: those that keep left and right, `options.candidates` by cost with few of the same
/// main pairs, then further ones, which are judged only where the best is doubtful.
pub(super) fn chosen(
    tables: &Tables<'_>,
    mut all: Vec<Assignment>,
    options: &MatchOptions,
) -> Vec<Assignment> {
    let shapes = tables.shapes;
    all.retain(|assignment| assignment.pairs.len() >= LEAST_TO_PLACE);
    let is_main =
        |side: MeshSide, mark: usize| shapes[side].marks[mark].persistence >= options.main_persistence;
    let main_pairs = |assignment: &Assignment| {
        let of_main = |pair: &&[usize; 2]| MeshSide::BOTH.iter().all(|&side| is_main(side, pair[side]));
        let mut pairs: Vec<[usize; 2]> = assignment.pairs.iter().filter(of_main).copied().collect();
        pairs.sort_unstable();
        pairs
    };
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
    for (k, groups) in symmetric(tables).iter().enumerate() {
        let cheapest: Vec<Assignment> = groups.iter().map(|turns| turns[0].clone()).collect();
        take(&cheapest, if k == 0 { options.symmetric } else { options.second_symmetric }, &mut chosen);
        // Around a body whose ends lie in a plane the orders say nothing of left and right.
        if let Some(turns) = groups.first().filter(|_| k == 0) {
            take(&turns[1..], options.turns, &mut chosen);
        }
    }
    take(&all, options.candidates, &mut chosen);
    // A long tail that only one of both bodies has must not make a leg the partner of the other's head.
    let one_missing = |a: &&Assignment| a.unmatched[0] + a.unmatched[1] == 1;
    let mut missing: Vec<Assignment> = all.iter().filter(one_missing).cloned().collect();
    let rest = |a: &Assignment| a.full_cost() - a.unmatched_cost;
    missing.sort_by(|a, b| rest(a).total_cmp(&rest(b)));
    take(&missing, options.one_missing, &mut chosen);
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

/// The assignments of least cost, at most so many.
pub(super) fn cheapest(mut all: Vec<Assignment>, most: usize) -> Vec<Assignment> {
    all.retain(|assignment| assignment.pairs.len() >= LEAST_LANDMARKS);
    all.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
    all.truncate(most);
    all
}

/// The assignments that keep left and right, for each pair of reflections of both bodies; none where a body has no reflection.
fn symmetric(tables: &Tables<'_>) -> Vec<Vec<Turns>> {
    let [sources, targets] = &tables.reflections;
    let pairs = sources.iter().flat_map(|source| targets.iter().map(move |target| [source, target]));
    pairs.map(|pair| equivariant(tables, pair)).collect()
}

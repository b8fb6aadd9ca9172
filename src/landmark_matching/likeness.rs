//! Partners that are far less alike than others would be.
//!
//! Which tip of a head or a foot is the most persistent differs from pose to pose. So a nose may get an ear as partner, or a toe the next
//! one, and the coarse map hardly tells: it has few vertices there. The descriptors do.

use super::moves::NEAR;
use super::search::{Assignment, Tables};
use crate::landmarks::{LEAST_LANDMARKS, MeshSide};

/// A pair is crossed where both of its tips have another tip this many times as like: a nose at an ear has 2.5 to 3.9 times on a dog in two
/// poses. Pairs of 68 matches of animals have up to 1.7, where they are less alike than [`UNLIKE`].
const CROSSED: f64 = 2.0;
/// Partners that differ by less than this are alike enough: those of a finger and the next one differ by up to 0.05, a nose and an ear by 0.18.
const UNLIKE: f64 = 0.1;
/// Both tips must have another one that differs by less than this: where only one body has a long tail all are unlike it, and a right pair of
/// a short and a long one, with 0.47 to 0.64, is twice as unlike as the others, from 0.22 on.
const LIKE: f64 = 0.15;
/// A tip gets another partner at the same place where that is this many times as like. Of 20 pairs of people's fingers that were one off and
/// had such a pair at their places, that was the right one for 19.
const NEXT: f64 = 1.4;

impl Tables<'_> {
    /// The number of pairs whose tips are both far more like other tips.
    pub(super) fn crossed(&self, pairs: &[[usize; 2]]) -> usize {
        pairs.iter().filter(|pair| self.is_crossed(**pair)).count()
    }

    fn is_crossed(&self, pair: [usize; 2]) -> bool {
        let [s, t] = pair;
        if self.shapes[0].given > s.min(t) {
            return false;
        }
        let others = MeshSide::BOTH.map(|side| {
            self.most_like(pair[side], side, |other| other != pair[side.other()])
                .map_or(f64::INFINITY, |(difference, _)| difference)
        });
        let other = others[0].max(others[1]);
        other < LIKE && self.difference[s][t] > UNLIKE.max(CROSSED * other)
    }

    /// The tip of the other body that is most like a mark, of those that are not given and `may` be, with the difference of their descriptors.
    fn most_like(&self, mark: usize, side: MeshSide, may: impl Fn(usize) -> bool) -> Option<(f64, usize)> {
        let difference = |other: usize| match side {
            MeshSide::Source => self.difference[mark][other],
            MeshSide::Target => self.difference[other][mark],
        };
        let other = self.shapes[side.other()];
        let tips = (other.given..other.marks.len()).filter(|&k| may(k));
        tips.map(|k| (difference(k), k)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The same pairs, but that lesser tips that are not given are exchanged for ones at the same place that are far more like their
    /// partners: a finger for the next one.
    pub(super) fn with_like_tips(&self, pairs: &[[usize; 2]]) -> Vec<[usize; 2]> {
        let mut pairs = pairs.to_vec();
        for k in self.shapes[0].given..pairs.len() {
            for side in MeshSide::BOTH {
                let (own, other) = (pairs[k][side], pairs[k][side.other()]);
                if self.main[side.other()].contains(&other) {
                    continue;
                }
                let is_taken = |tip: usize| pairs.iter().any(|pair| pair[side.other()] == tip);
                let places = &self.places[side.other()];
                let like = self.most_like(own, side, |tip| places[tip] == places[other] && !is_taken(tip));
                let [s, t] = pairs[k];
                if let Some((_, tip)) =
                    like.filter(|(difference, _)| NEXT * difference < self.difference[s][t])
                {
                    pairs[k][side.other()] = tip;
                }
            }
        }
        pairs
    }
}

/// The assignment `from` with other partners for its crossed pairs, and the one without these pairs; none where no pair is crossed.
pub(super) fn uncrossed(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let (crossed, without): (Vec<[usize; 2]>, Vec<_>) =
        from.pairs.iter().partition(|pair| tables.is_crossed(**pair));
    if crossed.is_empty() {
        return Vec::new();
    }
    let mut with = without.clone();
    for pair in crossed {
        for side in MeshSide::BOTH {
            let (own, before) = (pair[side], pair[side.other()]);
            let shape = tables.shapes[side.other()];
            let is_free = |tip: usize| with.iter().all(|pair| pair[side.other()] != tip);
            let may = |tip: usize| is_free(tip) && shape.distance([tip, before]) < NEAR;
            let is_taken = with.iter().any(|pair| pair[side] == own);
            if let Some((_, tip)) = tables.most_like(own, side, may).filter(|_| !is_taken) {
                let pair = match side {
                    MeshSide::Source => [own, tip],
                    MeshSide::Target => [tip, own],
                };
                with.extend(Some(pair).filter(|pair| !tables.is_crossed(*pair)));
            }
        }
    }
    let has_enough = |pairs: &Vec<[usize; 2]>| pairs.len() >= LEAST_LANDMARKS;
    [with, without].into_iter().filter(has_enough).map(|pairs| tables.changed(from, &pairs)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::options::MatchOptions;
    use super::super::test_bodies::{four_footed, shape};
    use super::*;

    #[test]
    fn a_toe_is_exchanged_for_the_one_beside_it_that_is_more_like_but_not_a_main_tip() {
        let shape = shape(&four_footed());
        let mut tables = Tables::new([&shape; 2], &MatchOptions::default());
        // As if a fore and a hind foot were toes of one foot of the target, and the hind one the lesser.
        let toe = (1..shape.marks.len()).max_by(|a, b| {
            let from_first = |k: usize| tables.difference[0][k];
            from_first(*a).total_cmp(&from_first(*b))
        });
        let (foot, toe) = (0, toe.unwrap());
        tables.places[1][toe] = tables.places[1][foot];
        let like = |tables: &Tables<'_>, pairs: &[[usize; 2]]| tables.with_like_tips(pairs);
        assert_eq!(like(&tables, &[[foot, toe]]), [[foot, toe]]);
        tables.main[1].retain(|&k| k != toe);
        assert_eq!(like(&tables, &[[foot, toe]]), [[foot; 2]]);
        // What is like enough, taken or at another place stays.
        assert_eq!(like(&tables, &[[toe; 2]]), [[toe; 2]]);
        assert_eq!(like(&tables, &[[foot, toe], [toe, foot]]), [[foot, toe], [toe, foot]]);
        tables.places[1][toe] = toe;
        assert_eq!(like(&tables, &[[foot, toe]]), [[foot, toe]]);
    }
}

//! Small ends of a head, as ears and horns, paired by a closer look.
//!
//! A coarse map has some ten vertices on a horn: whether it takes one ear to the other, or a horn without a partner to the wrong one, is
//! left to chance, and so is the score. So the best candidate is stripped of the pairs of small tips beside greater ones, each pair of such
//! tips that fits is judged by a finer map with this pair alone, and those that distort it no more are taken together, the best first. Then
//! finer maps decide about exchanged partners of the same region.

use super::candidate::Candidate;
use super::moves::{NEAR, are_near, exchanged, fitting};
use super::options::MatchOptions;
use super::parting::Parting;
use super::search::{Assignment, Tables};
use super::shape::Shape;
use crate::landmarks::{LEAST_LANDMARKS, MeshSide};

/// Least persistence of a small end: horns have 0.04 to 0.07, what a rough skin has is below. Chosen by hand.
const LEAST: f64 = 0.03;
/// Persistence from which on a tip is no small end: that of horns and ears is up to 0.19. Chosen by hand.
const MOST: f64 = 0.25;
/// A pair may raise the mean log density of the finer map by this much: on bodies made for it right ones raised it by -0.03 to 0.017, those of
/// a horn with the other one by -0.01 to 0.03. With 0.01 a nose went to an ear on one of 68 matches of animals.
const DISTORTS: f64 = 0.005;
/// Several pairs together may raise it by this much. Chosen by hand.
const DISTORT_TOGETHER: f64 = 0.02;
/// A pair must score better than those that contradict it by this much: on the same bodies right ones did by 0.01 to 0.19.
const LEAD: f64 = 0.005;

/// A candidate is near the best where it scores less than this worse: right ears did by up to 0.08. Chosen by hand.
const NEAR_SCORE: f64 = 0.15;
/// Exchanges of near partners that are judged by finer maps, at most. Chosen by hand.
const MOST_EXCHANGES: usize = 2;

/// The small ends of both bodies under an assignment.
pub(super) struct SmallEnds {
    /// The assignment without its pairs of small ends.
    pub(super) plain: Assignment,
    /// These pairs.
    own: Vec<[usize; 2]>,
    /// The plain assignment with one pair of small ends each, the last of its pairs.
    pub(super) with_one: Vec<Assignment>,
}

impl SmallEnds {
    /// The small ends under an assignment; `None` where they have no other partners than they have.
    pub(super) fn new(tables: &Tables<'_>, from: &Assignment, options: &MatchOptions) -> Option<Self> {
        let given = tables.shapes[0].given;
        let is_small = |pair: &&[usize; 2]| {
            pair[0] >= given && MeshSide::BOTH.iter().all(|&side| is_beside(tables.shapes[side], pair[side]))
        };
        let mut own: Vec<[usize; 2]> = from.pairs.iter().filter(is_small).copied().collect();
        if from.pairs.len() < own.len() + LEAST_LANDMARKS {
            own.clear();
        }
        let rest = from.pairs.iter().filter(|pair| !own.contains(pair));
        let plain = tables.changed(from, &rest.copied().collect::<Vec<_>>());
        let with_one: Vec<Assignment> = fitting_small(tables, &plain, from)
            .into_iter()
            .take(options.small_ends)
            .map(|pair| tables.changed(from, &[&plain.pairs[..], &[pair]].concat()))
            .collect();
        let is_open = with_one.iter().any(|one| !own.contains(&last(one)));
        is_open.then_some(Self { plain, own, with_one })
    }

    /// The finer maps that are made, at most.
    pub(super) fn most_looks(&self) -> usize {
        self.with_one.len() + 2 + MOST_EXCHANGES
    }

    /// The assignment with the partner of a small end exchanged for that of a greater one, as of two horns of which one is the farthest end of
    /// the head.
    pub(super) fn exchanged(&self, tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
        let is_of_both = |other: &Assignment| {
            let moved = other.pairs.iter().filter(|pair| !from.pairs.contains(pair));
            let is_plain = |pair: &[usize; 2]| self.plain.pairs.iter().any(|plain| plain[0] == pair[0]);
            moved.filter(|pair| is_plain(pair)).count() == 1
        };
        exchanged(tables, from).into_iter().filter(is_of_both).take(MOST_EXCHANGES).collect()
    }

    /// The assignment with all pairs of small ends that are worth it. `plain` and `with_one` are the candidates of the assignments of these
    /// names on finer maps. A pair that the assignment had is given up for better ones alone.
    pub(super) fn taken(&self, tables: &Tables<'_>, plain: &Candidate, with_one: &[Candidate]) -> Assignment {
        let mut with_one: Vec<&Candidate> = with_one.iter().collect();
        with_one.sort_by(|a, b| a.score.total_cmp(&b.score));
        let mut taken: Vec<[usize; 2]> = Vec::new();
        for one in &with_one {
            let pair = last(&one.assignment);
            let mut rivals = with_one.iter().filter(|other| contradict(last(&other.assignment), pair));
            let leads = rivals.all(|rival| rival.score > one.score + LEAD);
            let fits = leads && one.mean_log < plain.mean_log + DISTORTS;
            let is_free = !taken.iter().any(|&other| other == pair || contradict(other, pair));
            if is_free && (fits || self.own.contains(&pair)) {
                taken.push(pair);
            }
        }
        for &pair in &self.own {
            if !taken.iter().any(|&t| t == pair || contradict(t, pair)) {
                taken.push(pair);
            }
        }
        tables.changed(&self.plain, &[&self.plain.pairs[..], &taken].concat())
    }
}

/// Exchanges of partners of the best candidate, as those of two ears, that another one has whose score and map hardly differ: each as the
/// two exchanged pairs; those of the best such candidates come first.
pub(super) fn near_exchanges(found: &[Candidate], options: &MatchOptions) -> Vec<[[usize; 2]; 2]> {
    let Some((best, others)) = found.split_first() else { return Vec::new() };
    let own = &best.assignment.pairs;
    let mut exchanges: Vec<[[usize; 2]; 2]> = Vec::new();
    for other in others.iter().filter(|other| other.score < best.score + NEAR_SCORE) {
        let pairs = &other.assignment.pairs;
        let of_two = own
            .iter()
            .enumerate()
            .flat_map(|(k, a)| own[..k].iter().map(move |b| [[a[0], b[1]], [b[0], a[1]]]));
        let new: Vec<_> = of_two
            .filter(|exchange| {
                exchange.iter().all(|pair| pairs.contains(pair)) && !exchanges.contains(exchange)
            })
            .collect();
        if !new.is_empty() && Parting::of(best, other).share <= options.limits.parting {
            exchanges.extend(new);
        }
    }
    exchanges.truncate(MOST_EXCHANGES);
    exchanges
}

/// An assignment with two pairs exchanged for these, which have the same tips; `None` where it does not have both.
pub(super) fn with_exchange(
    tables: &Tables<'_>,
    from: &Assignment,
    exchange: [[usize; 2]; 2],
) -> Option<Assignment> {
    let [[a, x], [b, y]] = exchange;
    let mut pairs = from.pairs.clone();
    for (old, new) in [([a, y], [a, x]), ([b, x], [b, y])] {
        *pairs.iter_mut().find(|pair| **pair == old)? = new;
    }
    Some(tables.changed(from, &pairs))
}

/// Whether the finer map with small ends distorts no more than that without.
pub(super) fn are_fit(plain: &Candidate, all: &Candidate) -> bool {
    all.mean_log < plain.mean_log + DISTORT_TOGETHER
}

/// Whether a tip is a small one beside a greater one.
fn is_beside(shape: &Shape, tip: usize) -> bool {
    let persistence = |k: usize| shape.marks[k].persistence;
    let is_greater = |k: usize| persistence(k) > persistence(tip) && shape.distance([k, tip]) < NEAR;
    (LEAST..MOST).contains(&persistence(tip)) && shape.tips().any(is_greater)
}

/// The pairs of small ends without a partner that fit, near to a pair of `from`; the cheapest first.
fn fitting_small(tables: &Tables<'_>, plain: &Assignment, from: &Assignment) -> Vec<[usize; 2]> {
    let is_wanted = |(_, pair): &(f64, [usize; 2])| {
        let are_small = MeshSide::BOTH.iter().all(|&side| is_beside(tables.shapes[side], pair[side]));
        are_small && from.pairs.iter().any(|&other| are_near(tables, [*pair, other]))
    };
    let mut found: Vec<_> = fitting(tables, &plain.pairs).into_iter().filter(is_wanted).collect();
    let cost = |&(misfit, [s, t]): &(f64, [usize; 2])| misfit + tables.difference[s][t];
    found.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    found.into_iter().map(|(_, pair)| pair).collect()
}

fn last(assignment: &Assignment) -> [usize; 2] {
    assignment.pairs[assignment.pairs.len() - 1]
}

/// Whether two different pairs share a tip.
fn contradict(one: [usize; 2], other: [usize; 2]) -> bool {
    (one[0] == other[0]) != (one[1] == other[1])
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{ENDS, ball_with_ends, shape};
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::{SurfacePoint, VertexId};
    use glam::DVec3;

    /// Four feet, a head, a tail, and two ears.
    fn with_ears() -> Shape {
        let ears = [0.4, -0.4].map(|y| (DVec3::new(0.6, y, 0.9), 0.6));
        let limbs = ENDS.iter().map(|&end| (end, if end.z > 0.5 { 1.0 } else { 2.0 }));
        shape(&ball_with_ends(&limbs.chain(ears).collect::<Vec<_>>(), 30.0))
    }

    /// The numbers of the ears among the marks.
    fn ears(body: &Shape) -> Vec<usize> {
        let is_ear = |k: &usize| is_beside(body, *k);
        body.tips().filter(is_ear).collect()
    }

    /// A candidate of two same balls with these pairs of marks, this score and this mean log density.
    fn candidate(assignment: Assignment, score: f64, mean_log: f64) -> Candidate {
        let ball = icosphere(1);
        let images = ball.vertices().map(|v: VertexId| SurfacePoint::at_vertex(&ball, v)).collect();
        Candidate { assignment, score, mean_log, ..Candidate::of_images(&ball, images) }
    }

    #[test]
    fn ears_get_their_partners_by_the_finer_maps() {
        let body = with_ears();
        let tables = Tables::new([&body; 2], &MatchOptions::default());
        let own: Vec<[usize; 2]> = body.tips().map(|k| [k; 2]).collect();
        let ears = ears(&body);
        let [a, b] = ears[..] else { panic!("{ears:?}") };
        let rest: Vec<[usize; 2]> = own.iter().copied().filter(|[k, _]| !ears.contains(k)).collect();
        let options = MatchOptions::default();
        // Whether both ears have no partner, or one has the other's.
        for from in [rest.clone(), [&rest[..], &[[a, b]]].concat()] {
            let from = tables.assignment(&from);
            let ends = SmallEnds::new(&tables, &from, &options).unwrap();
            assert_eq!((&ends.plain.pairs, ends.with_one.len()), (&rest, 4));
            let plain = candidate(ends.plain.clone(), 0.5, 0.1);
            let judged = |right: [f64; 2], wrong: [f64; 2]| -> Vec<Candidate> {
                let one = |one: &Assignment| {
                    let [s, t] = last(one);
                    let [score, mean_log] = if s == t { right } else { wrong };
                    candidate(one.clone(), score, mean_log)
                };
                ends.with_one.iter().map(one).collect()
            };
            let taken = |right: [f64; 2], wrong: [f64; 2]| {
                let mut pairs = ends.taken(&tables, &plain, &judged(right, wrong)).pairs;
                pairs.sort_unstable();
                pairs
            };
            let mut all = own.clone();
            all.sort_unstable();
            let mut before = from.pairs.clone();
            before.sort_unstable();
            assert_eq!(taken([0.52, 0.1], [0.56, 0.12]), all);
            // Pairs that lead by nothing, or that distort the map, are not taken.
            assert_eq!(taken([0.52, 0.1], [0.521, 0.1]), before);
            assert_eq!(taken([0.6, 0.2], [0.7, 0.3]), before);
        }
        let none = MatchOptions { small_ends: 0, ..options };
        assert!(SmallEnds::new(&tables, &tables.assignment(&rest), &none).is_none());
    }

    #[test]
    fn exchanges_are_those_of_candidates_that_hardly_differ() {
        let body = with_ears();
        let options = MatchOptions::default();
        let tables = Tables::new([&body; 2], &options);
        let own: Vec<[usize; 2]> = body.tips().map(|k| [k; 2]).collect();
        let [a, b] = ears(&body)[..] else { panic!() };
        let best = tables.assignment(&own);
        let exchange = [[a.max(b), a.min(b)], [a.min(b), a.max(b)]];
        let other = with_exchange(&tables, &best, exchange).unwrap();
        assert_eq!(other.pairs.iter().filter(|pair| pair[0] != pair[1]).count(), 2);
        // A second time it is undone, and the same pairs are not there to be exchanged.
        assert_eq!(with_exchange(&tables, &other, exchange), None);
        let back = exchange.map(|[s, _]| [s, s]);
        assert_eq!(with_exchange(&tables, &other, back).unwrap().pairs, best.pairs);
        let near = |score: f64| {
            let found = [candidate(best.clone(), 0.5, 0.1), candidate(other.clone(), score, 0.1)];
            near_exchanges(&found, &options)
        };
        assert_eq!((near(0.6), near(0.7)), (vec![exchange], Vec::new()));
    }
}

//! Assignments of the tips of one body to those of another: a beam search over partial assignments.

use super::options::MatchOptions;
use super::orders::orders;
use super::reflection::{Reflection, keeps_sides};
use super::roles::{Roles, kept};
use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::math::scalar::{ln, min};
use crate::mesh::VertexId;

/// An assignment of marks of the source to marks of the target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Assignment {
    /// Numbers of the marks of source and target; the given ones first.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Its cost without regard to orders.
    pub(super) cost: f64,
    /// The part of `cost` for main tips without a partner.
    pub(super) unmatched_cost: f64,
    /// Share of the cyclic orders that are the same on both bodies, 0 to 1; 1 where there are none.
    pub(super) agreement: f64,
    /// Main tips without a partner, by mesh.
    pub(super) unmatched: [usize; 2],
    /// Whether it takes left and right of one body to those of the other.
    pub(super) keeps_sides: bool,
    /// Number of twins that go to twins, as ears to ears.
    pub(super) twins: usize,
    /// Number of tips on the middle line of one body that go to one of twins of the other, as a nose to an ear.
    pub(super) mixed: usize,
    /// Number of pairs whose tips are both far more like other tips.
    pub(super) crossed: usize,
    /// A further pair, of vertices of both levels that are no marks.
    pub(super) between: Option<[VertexId; 2]>,
}

/// Weight of the share of reversed orders, beside the mean log ratio of distances. This weight and the next two were found with a
/// prototype on SHREC07 pairs.
const ORDERS: f64 = 0.3;
/// Weight of the mean log ratio of persistence.
const PERSISTENCE: f64 = 0.05;
/// Weight of the persistence of tips without a partner.
const UNMATCHED: f64 = 0.35;
/// Persistence above which a tip without a partner costs no more: the other body may lack a long tail. Chosen by hand.
const MOST_UNMATCHED: f64 = 0.25;
/// A log ratio of distances above this counts as this. Chosen by hand.
const MOST_RATIO: f64 = 1.0;

impl Assignment {
    /// Its cost with regard to orders.
    pub(super) fn full_cost(&self) -> f64 {
        self.cost + ORDERS * (1.0 - self.agreement)
    }
}

/// Both bodies with tables from which the costs of assignments are computed.
pub(super) struct Tables<'a> {
    pub(super) shapes: [&'a Shape; 2],
    /// The numbers of the main tips of each body.
    pub(super) main: [Vec<usize>; 2],
    /// The reflections of each body, the best first.
    pub(super) reflections: [Vec<Reflection>; 2],
    /// The roles of the tips of each body.
    pub(super) roles: [Roles; 2],
    /// For each mark of each body the one that stands for its place.
    pub(super) places: [Vec<usize>; 2],
    /// The reflections of the places of each body.
    place_reflections: [Vec<Reflection>; 2],
    /// The logarithm of the distance between each two marks of each body.
    log_distance: [Vec<Vec<f64>>; 2],
    /// The difference of descriptors between each mark of the source and each mark of the target.
    pub(super) difference: Vec<Vec<f64>>,
}

impl<'a> Tables<'a> {
    pub(super) fn new(shapes: [&'a Shape; 2], options: &MatchOptions) -> Self {
        let log_distance = shapes.map(|shape| {
            let n = shape.marks.len();
            // Marks nearer than 0.02 of the root of the area count as if at that distance.
            let log = |a: usize, b: usize| ln(shape.distance([a, b]).max(0.02));
            (0..n).map(|a| (0..n).map(|b| log(a, b)).collect()).collect()
        });
        let difference = |s: usize, t: usize| shapes[0].marks[s].difference(&shapes[1].marks[t]);
        let [n, m] = shapes.map(|shape| shape.marks.len());
        let difference = (0..n).map(|s| (0..m).map(|t| difference(s, t)).collect()).collect();
        let main = shapes.map(|shape| shape.main(options));
        let reflections = MeshSide::BOTH.map(|side| Reflection::all_of(shapes[side], &main[side]));
        let roles =
            MeshSide::BOTH.map(|side| Roles::new(shapes[side], reflections[side].first(), &main[side]));
        let places = shapes.map(Shape::places);
        let place_reflections = MeshSide::BOTH
            .map(|side| reflections[side].iter().map(|of| of.of_places(&places[side])).collect());
        Self { shapes, main, reflections, roles, places, place_reflections, log_distance, difference }
    }

    /// Whether pairs of marks, or of their places, take left and right of one body to those of the other. Which toe of a foot is its end
    /// differs from body to body.
    fn keeps_sides(&self, pairs: &[[usize; 2]]) -> bool {
        let keeps = |reflections: &[Vec<Reflection>; 2], pairs: &[[usize; 2]]| {
            keeps_sides(reflections.each_ref().map(Vec::as_slice), pairs)
        };
        let of_places: Vec<[usize; 2]> =
            pairs.iter().map(|pair| MeshSide::BOTH.map(|side| self.places[side][pair[side]])).collect();
        keeps(&self.reflections, pairs) || keeps(&self.place_reflections, &of_places)
    }

    fn misfit(&self, [s, t]: [usize; 2], [p, q]: [usize; 2]) -> f64 {
        min((self.log_distance[0][s][p] - self.log_distance[1][t][q]).abs(), MOST_RATIO)
    }

    /// Mean misfit (log ratio of distances) of a pair to others.
    pub(super) fn mean_misfit(&self, pair: [usize; 2], others: &[[usize; 2]]) -> f64 {
        let others = others.iter().filter(|other| **other != pair);
        let (sum, count) = others.fold((0.0, 0), |(sum, n), &other| (sum + self.misfit(pair, other), n + 1));
        sum / f64::from(count.max(1))
    }

    /// The assignment with these pairs, the given ones first, and its costs.
    pub(super) fn assignment(&self, pairs: &[[usize; 2]]) -> Assignment {
        let mut partial = Partial::of_given(self);
        let pairs = self.with_like_tips(pairs);
        pairs[self.shapes[0].given..].iter().for_each(|&pair| partial.join(self, pair));
        for side in MeshSide::BOTH {
            for &mark in &self.main[side] {
                if !partial.has(side, mark) {
                    partial.leave(self, side, mark);
                }
            }
        }
        partial.finished(self)
    }

    /// The assignment with these pairs in place of those of another one, whose place between it keeps.
    pub(super) fn changed(&self, from: &Assignment, pairs: &[[usize; 2]]) -> Assignment {
        Assignment { between: from.between, ..self.assignment(pairs) }
    }
}

/// A partial assignment.
#[derive(Clone)]
struct Partial {
    pairs: Vec<[usize; 2]>,
    lesser: usize,
    /// Sum of the misfits of all pairs of pairs.
    misfit: f64,
    difference: f64,
    persistence: f64,
    unmatched_cost: f64,
    unmatched: [usize; 2],
}

impl Partial {
    fn of_given(tables: &Tables<'_>) -> Self {
        let mut partial = Self {
            pairs: Vec::new(),
            lesser: 0,
            misfit: 0.0,
            difference: 0.0,
            persistence: 0.0,
            unmatched_cost: 0.0,
            unmatched: [0; 2],
        };
        for k in 0..tables.shapes[0].given {
            partial.join(tables, [k, k]);
        }
        partial
    }

    fn join(&mut self, tables: &Tables<'_>, [s, t]: [usize; 2]) {
        self.misfit += self.pairs.iter().map(|&other| tables.misfit([s, t], other)).sum::<f64>();
        self.pairs.push([s, t]);
        let [source, target] = tables.shapes;
        // Given pairs cost the same in all assignments.
        if s >= source.given && t >= target.given {
            let [a, b] = [&source.marks[s], &target.marks[t]];
            self.difference += tables.difference[s][t];
            self.persistence += ln(a.persistence / b.persistence).abs();
        }
    }

    fn with(&self, tables: &Tables<'_>, pair: [usize; 2]) -> Self {
        let mut next = self.clone();
        next.join(tables, pair);
        next
    }

    fn without(&self, tables: &Tables<'_>, side: MeshSide, mark: usize) -> Self {
        let mut next = self.clone();
        next.leave(tables, side, mark);
        next
    }

    fn leave(&mut self, tables: &Tables<'_>, side: MeshSide, mark: usize) {
        self.unmatched_cost += min(tables.shapes[side].marks[mark].persistence, MOST_UNMATCHED);
        self.unmatched[side] += 1;
    }

    fn finished(self, tables: &Tables<'_>) -> Assignment {
        // Lesser tips lie so near each other on a head that their orders are unreliable, and right pairs of ears could cost more.
        let is_clear = |side: MeshSide, mark: usize| {
            mark < tables.shapes[side].given || tables.main[side].contains(&mark)
        };
        let of_clear = |pair: &[usize; 2]| MeshSide::BOTH.iter().any(|&side| is_clear(side, pair[side]));
        let clear = self.pairs.iter().copied().filter(of_clear);
        let clear: Vec<[usize; 2]> = clear.collect();
        let [twins, mixed] = kept(tables.roles.each_ref(), &self.pairs);
        Assignment {
            twins,
            mixed,
            crossed: tables.crossed(&self.pairs),
            cost: self.cost(tables.shapes[0].given),
            unmatched_cost: UNMATCHED * self.unmatched_cost,
            agreement: 1.0 - orders(tables.shapes, &clear).reversed,
            unmatched: self.unmatched,
            keeps_sides: tables.keeps_sides(&self.pairs),
            pairs: self.pairs,
            between: None,
        }
    }

    fn cost(&self, given: usize) -> f64 {
        let n = self.pairs.len() as f64;
        let tips = (self.pairs.len() - given).max(1) as f64;
        let pairs = (0.5 * n * (n - 1.0)).max(1.0);
        self.misfit / pairs
            + self.difference / tips
            + PERSISTENCE * self.persistence / tips
            + UNMATCHED * self.unmatched_cost
    }

    fn has(&self, side: MeshSide, mark: usize) -> bool {
        self.pairs.iter().any(|pair| pair[side] == mark)
    }
}

/// The cheapest assignments without regard to orders, the cheapest first, each with its agreement of orders.
pub(super) fn assignments(tables: &Tables<'_>, options: &MatchOptions) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let mut beam = vec![Partial::of_given(tables)];
    for side in MeshSide::BOTH {
        for &mark in &tables.main[side] {
            beam = beam.iter().flat_map(|partial| step(tables, partial, side, mark, options)).collect();
            beam.sort_by(|a, b| a.cost(given).total_cmp(&b.cost(given)));
            beam.truncate(options.beam);
        }
    }
    beam.into_iter().map(|partial| partial.finished(tables)).collect()
}

/// All partial assignments that decide on a further main tip of one side: the source's are paired first, with any tip of the target, then
/// the target's that are left with lesser tips of the source.
fn step(
    tables: &Tables<'_>,
    partial: &Partial,
    side: MeshSide,
    mark: usize,
    options: &MatchOptions,
) -> Vec<Partial> {
    if partial.has(side, mark) {
        return vec![partial.clone()];
    }
    let other = tables.shapes[side.other()];
    let mut next = vec![partial.without(tables, side, mark)];
    for partner in (other.given..other.marks.len()).filter(|&k| !partial.has(side.other(), k)) {
        let is_main = other.marks[partner].persistence >= options.main_persistence;
        // The source's main tips have been decided when those of the target come.
        if (is_main && side == MeshSide::Target) || (!is_main && partial.lesser >= options.lesser_partners) {
            continue;
        }
        let pair = match side {
            MeshSide::Source => [mark, partner],
            MeshSide::Target => [partner, mark],
        };
        let mut joined = partial.with(tables, pair);
        joined.lesser += usize::from(!is_main);
        next.push(joined);
    }
    next
}

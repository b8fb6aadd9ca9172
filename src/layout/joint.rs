//! Which paths to draw, in which order: tree first, then the shortest and straightest.

use super::drawing::{Drawing, Plan, Planner};
use super::geodesics::LandmarkDistances;
use super::{LayoutError, TreeOrder};
use crate::base_domain::BaseDomain;
use crate::monitor::{Monitor, Step};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Geodesic lengths that path lengths are compared with: those of the free plans.
#[derive(Clone, Debug)]
pub(super) struct Geodesics {
    landmarks: usize,
    /// NaN where not yet known.
    lengths: Vec<[f64; 2]>,
}

impl Geodesics {
    pub fn new(landmarks: usize) -> Self {
        Self { landmarks, lengths: vec![[f64::NAN; 2]; landmarks * landmarks] }
    }

    /// Lengths of the shortest paths on both meshes, searched on the empty drawing the first time.
    pub fn between(&mut self, empty: &Drawing, planner: &mut Planner, ends: [usize; 2]) -> [f64; 2] {
        let at = ends[0] * self.landmarks + ends[1];
        if self.lengths[at][0].is_nan()
            && let Some(plan) = empty.plan(planner, ends)
        {
            self.lengths[at] = [plan.found[0].length, plan.found[1].length];
        }
        self.lengths[at]
    }
}

/// How one attempt draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Variant {
    pub order: TreeOrder,
    pub midpoint_penalty: f64,
}

/// What an attempt needs beside its variant.
pub(super) struct Ground<'a> {
    pub empty: &'a Drawing,
    pub distances: &'a LandmarkDistances,
}

/// Draws the whole base complex: a spanning tree, then pairs not yet adjacent until every face is a triangle.
pub(super) fn draw(
    ground: &Ground<'_>,
    variant: Variant,
    geodesics: &mut Geodesics,
    monitor: &mut dyn Monitor,
) -> Result<Drawing, LayoutError> {
    let mut planner = Planner::new(variant.midpoint_penalty);
    let mut drawing = ground.empty.clone();
    let landmarks = drawing.rotation.len();
    for ends in tree_in_order(ground.distances, variant.order) {
        let plan = drawing.plan(&mut planner, ends).ok_or(LayoutError::NoPath { landmarks: ends })?;
        drawing.draw(&plan).ok_or(LayoutError::NoPath { landmarks: ends })?;
    }
    let wanted = 3 * landmarks - 6;
    let mut queue = Candidates::new(ground.distances, &drawing);
    while drawing.ends.len() < wanted {
        monitor.step(Step { fraction: drawing.ends.len() as f64 / wanted as f64, residual: None })?;
        let Some(plan) = queue.next(ground, &drawing, &mut planner, geodesics) else {
            return Err(LayoutError::Stuck { paths: drawing.ends.len(), wanted });
        };
        drawing.draw(&plan).ok_or(LayoutError::NoPath { landmarks: plan.ends })?;
    }
    Ok(drawing)
}

/// Draws the edges of a given base domain: its rotation system prescribes every sector.
pub(super) fn draw_base(
    ground: &Ground<'_>,
    base: &BaseDomain,
    monitor: &mut dyn Monitor,
) -> Result<Drawing, LayoutError> {
    let mesh = &base.mesh;
    let mut planner = Planner::new(1.0);
    let mut drawing = ground.empty.clone();
    let mut edges: Vec<[usize; 2]> =
        mesh.edges().map(|h| sorted([mesh.tail(h).index(), mesh.head(h).index()])).collect();
    edges.sort_by(|&a, &b| ground.distances.sum(a).total_cmp(&ground.distances.sum(b)).then(a.cmp(&b)));
    let mut sets = DisjointSets::new(drawing.rotation.len());
    let (tree, rest): (Vec<_>, Vec<_>) = edges.into_iter().partition(|&[i, j]| sets.join(i, j));
    let count = tree.len() + rest.len();
    for (done, ends) in tree.into_iter().rev().chain(rest).enumerate() {
        monitor.step(Step { fraction: done as f64 / count as f64, residual: None })?;
        let slots =
            [prescribed_slot(&drawing, base, ends), prescribed_slot(&drawing, base, [ends[1], ends[0]])];
        let plan = drawing.plan_in_slots(&mut planner, ends, slots);
        let plan = plan.ok_or(LayoutError::NoPath { landmarks: ends })?;
        drawing.draw(&plan).ok_or(LayoutError::NoPath { landmarks: ends })?;
    }
    Ok(drawing)
}

/// The place of the rotation at landmark `i` after which the edge to `j` goes in, by the base domain's own order.
fn prescribed_slot(drawing: &Drawing, base: &BaseDomain, [i, j]: [usize; 2]) -> usize {
    let mesh = &base.mesh;
    let around: Vec<usize> = mesh.star(i.into()).map(|h| mesh.head(h).index()).collect();
    let place = around.iter().position(|&n| n == j).unwrap_or(0);
    let other_end = |path: usize| {
        let [a, b] = drawing.ends[path];
        if a == i { b } else { a }
    };
    for back in 1..=around.len() {
        let neighbour = around[(place + around.len() - back) % around.len()];
        if let Some(slot) = drawing.rotation[i].iter().position(|&p| other_end(p) == neighbour) {
            return slot;
        }
    }
    0
}

fn sorted([i, j]: [usize; 2]) -> [usize; 2] {
    [i.min(j), i.max(j)]
}

struct DisjointSets {
    parent: Vec<usize>,
}

impl DisjointSets {
    fn new(n: usize) -> Self {
        Self { parent: (0..n).collect() }
    }

    fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    /// Joins two sets; `false` when they were one already.
    fn join(&mut self, i: usize, j: usize) -> bool {
        let (a, b) = (self.root(i), self.root(j));
        self.parent[a] = b;
        a != b
    }
}

/// The minimum spanning tree of the summed distances, in drawing order.
fn tree_in_order(distances: &LandmarkDistances, order: TreeOrder) -> Vec<[usize; 2]> {
    let n = distances.len();
    let mut pairs: Vec<[usize; 2]> = (0..n).flat_map(|j| (0..j).map(move |i| [i, j])).collect();
    pairs.sort_by(|&a, &b| distances.sum(a).total_cmp(&distances.sum(b)).then(a.cmp(&b)));
    let mut sets = DisjointSets::new(n);
    let mut tree: Vec<[usize; 2]> = pairs.into_iter().filter(|&[i, j]| sets.join(i, j)).collect();
    match order {
        TreeOrder::ShortestFirst => {}
        TreeOrder::LongestFirst => tree.reverse(),
        TreeOrder::LeavesFirst => tree = leaves_first(tree, n),
    }
    tree
}

/// Peels the tree from its leaves; within a layer the longest first.
fn leaves_first(tree: Vec<[usize; 2]>, n: usize) -> Vec<[usize; 2]> {
    let mut degree = vec![0_usize; n];
    tree.iter().flatten().for_each(|&i| degree[i] += 1);
    let mut left: Vec<[usize; 2]> = tree.into_iter().rev().collect();
    let mut ordered = Vec::with_capacity(left.len());
    while !left.is_empty() {
        let (layer, rest): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|&[i, j]| degree[i] == 1 || degree[j] == 1);
        layer.iter().flatten().for_each(|&i| degree[i] -= 1);
        ordered.extend(layer);
        left = rest;
    }
    ordered
}

struct Candidate {
    key: f64,
    ends: [usize; 2],
    plan: Option<Plan>,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.key.total_cmp(&self.key).then(other.ends.cmp(&self.ends))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Pairs not yet adjacent, smallest key first, planned when they come up.
struct Candidates {
    queue: BinaryHeap<Candidate>,
}

impl Candidates {
    fn new(distances: &LandmarkDistances, drawing: &Drawing) -> Self {
        let n = distances.len();
        let pairs = (0..n).flat_map(|j| (0..j).map(move |i| [i, j]));
        let fresh = pairs.filter(|ends| !drawing.ends.contains(ends));
        // Edge paths are at most some 10 % longer than midpoint paths: a lower bound for a key not yet known.
        let queue =
            fresh.map(|ends| Candidate { key: 0.85 * distances.sum(ends), ends, plan: None }).collect();
        Self { queue }
    }

    fn next(
        &mut self,
        ground: &Ground<'_>,
        drawing: &Drawing,
        planner: &mut Planner,
        geodesics: &mut Geodesics,
    ) -> Option<Plan> {
        while let Some(Candidate { ends, plan, .. }) = self.queue.pop() {
            if let Some(plan) = plan
                && drawing.still_valid(&plan)
            {
                return Some(plan);
            }
            let Some(plan) = drawing.plan(planner, ends) else { continue };
            let key = key(&plan, geodesics.between(ground.empty, planner, ends));
            if self.queue.peek().is_none_or(|next| key <= next.key) {
                return Some(plan);
            }
            self.queue.push(Candidate { key, ends, plan: Some(plan) });
        }
        None
    }
}

/// Total length, times the square of the worse detour.
fn key(plan: &Plan, geodesics: [f64; 2]) -> f64 {
    let detour = (0..2).map(|s| plan.found[s].length / geodesics[s]).fold(1.0, f64::max);
    plan.length() * detour * detour
}

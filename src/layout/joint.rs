//! The order in which paths are drawn: a spanning tree first, then the shortest and straightest paths.

use super::drawing::{Drawing, Plan, Planner, SlotPairs};
use super::error::LayoutError;
use super::landmark_distances::LandmarkDistances;
use super::variants::{PLAIN, TreeOrder, Variant};
use crate::base_domain::BaseDomain;
use crate::landmarks::{LandmarkId, MeshSide};
use crate::math::disjoint_sets::DisjointSets;
use crate::math::min_queue::{MinQueue, Queued};
use crate::monitor::Monitor;
use std::collections::BTreeSet;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The data that all attempts on one pair of meshes share.
pub(super) struct Ground<'a> {
    pub empty: &'a Drawing,
    pub distances: &'a LandmarkDistances,
    /// A drawing whose detours sum to more is given up.
    pub most_detour: f64,
}

impl<'a> Ground<'a> {
    /// A ground without a limit on the detours.
    pub fn new(empty: &'a Drawing, distances: &'a LandmarkDistances) -> Self {
        Self { empty, distances, most_detour: f64::INFINITY }
    }
}

/// Draws the whole base complex: a spanning tree, then pairs not yet adjacent until every face is a triangle.
pub(super) fn draw(
    ground: &Ground<'_>,
    variant: &Variant,
    monitor: &mut dyn Monitor,
) -> Result<Drawing, LayoutError> {
    let mut planner = Planner::new(ground.distances, variant.midpoint_penalty, monitor);
    planner.most_detour = ground.most_detour;
    let mut drawing = ground.empty.clone();
    for ends in tree_in_order(ground.distances, variant) {
        planner.tell(0.0)?;
        let plan = drawing.plan(&mut planner, ends, [f64::INFINITY; 2]);
        planner.draw(&mut drawing, ends, plan)?;
        planner.check_tree(&drawing)?;
    }
    complete(&mut drawing, &mut planner, variant)?;
    planner.midpoint_penalty = 1.0;
    straighten(&mut drawing, &mut planner)?;
    Ok(drawing)
}

/// Adds paths to a connected drawing until every face is a triangle.
pub(super) fn complete(
    drawing: &mut Drawing,
    planner: &mut Planner<'_>,
    variant: &Variant,
) -> Result<(), LayoutError> {
    let wanted = 3 * drawing.rotation.len() - 6;
    let mut queue = PairQueue::new(planner.distances, drawing, variant);
    while drawing.ends.len() < wanted {
        planner.tell(drawing.ends.len() as f64 / wanted as f64)?;
        let Some(plan) = queue.next(drawing, planner) else {
            let stuck = LayoutError::Stuck { paths: drawing.ends.len(), wanted };
            return Err(planner.fault(drawing).map_or(stuck, LayoutError::from));
        };
        planner.draw(drawing, plan.ends, Some(plan))?;
    }
    Ok(())
}

/// Paths longer than this, relative to the shortest, are drawn anew. Chosen by hand, above the 10 % that
/// [`super::LayoutReport::detour`] leaves to paths for giving way.
const BENT: f64 = 1.2;

/// Replaces bent paths, the worst first, by the better diagonal of their quadrilateral; the class stays.
///
/// A path drawn early is straight but may block later ones, and a twist may have made it wind.
pub(super) fn straighten(drawing: &mut Drawing, planner: &mut Planner<'_>) -> Result<(), LayoutError> {
    // The second pass takes the room that the first one has made; ten paths in each bound the time. Chosen by hand.
    for _ in 0..2 {
        let stretch = |p: usize| {
            let geodesics = planner.distances.between(drawing.ends[p]);
            (0..2).map(|s| drawing.sides[s].lengths[p] / geodesics[s]).fold(1.0, f64::max)
        };
        let all = (0..drawing.ends.len()).map(|p| (stretch(p), drawing.ends[p]));
        let mut bent: Vec<(f64, [LandmarkId; 2])> = all.filter(|(stretch, _)| *stretch > BENT).collect();
        bent.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut changed = 0;
        for (_, ends) in bent.into_iter().take(10) {
            if let Some(path) = drawing.ends.iter().position(|&other| other == ends) {
                drawing.erase(path);
                complete(drawing, planner, &PLAIN)?;
                changed += usize::from(drawing.ends.last() != Some(&ends));
            }
        }
        if changed == 0 {
            break;
        }
    }
    Ok(())
}

/// Draws the edges of a given base domain: its rotation system prescribes every sector.
pub(super) fn draw_base(
    ground: &Ground<'_>,
    base: &BaseDomain,
    monitor: &mut dyn Monitor,
) -> Result<Drawing, LayoutError> {
    let mut planner = Planner::new(ground.distances, 1.0, monitor);
    let mut drawing = ground.empty.clone();
    let mut edges: Vec<[LandmarkId; 2]> =
        base.mesh.edges().map(|h| sorted([base.tail(h), base.head(h)])).collect();
    edges.sort_by(|&a, &b| ground.distances.sum(a).total_cmp(&ground.distances.sum(b)).then(a.cmp(&b)));
    let mut sets = DisjointSets::new(drawing.rotation.len());
    let (tree, rest): (Vec<_>, Vec<_>) =
        edges.into_iter().partition(|[i, j]| sets.join(i.index(), j.index()));
    let count = tree.len() + rest.len();
    for (done, ends) in tree.into_iter().rev().chain(rest).enumerate() {
        planner.tell(done as f64 / count as f64)?;
        let slots =
            [prescribed_slot(&drawing, base, ends), prescribed_slot(&drawing, base, [ends[1], ends[0]])];
        let plan = drawing.plan_in_slots(&mut planner, ends, slots);
        planner.draw(&mut drawing, ends, plan)?;
    }
    Ok(drawing)
}

/// The place of the rotation at landmark `i` after which the edge to `j` goes in, by the base domain's own order.
fn prescribed_slot(drawing: &Drawing, base: &BaseDomain, [i, j]: [LandmarkId; 2]) -> usize {
    let around: Vec<LandmarkId> = base.star(i).map(|h| base.head(h)).collect();
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

fn sorted([i, j]: [LandmarkId; 2]) -> [LandmarkId; 2] {
    [i.min(j), i.max(j)]
}

/// All pairs of so many landmarks, smaller first.
fn pairs(landmarks: usize) -> impl Iterator<Item = [LandmarkId; 2]> {
    (0..landmarks).flat_map(|j| (0..j).map(move |i| [i, j].map(LandmarkId::from)))
}

/// The minimum spanning tree of the summed distances, in drawing order.
fn tree_in_order(distances: &LandmarkDistances, variant: &Variant) -> Vec<[LandmarkId; 2]> {
    let n = distances.landmark_count();
    let mut pairs: Vec<[LandmarkId; 2]> = pairs(n).collect();
    let length = |pair| variant.factor(pair) * distances.sum(pair);
    pairs.sort_by(|&a, &b| length(a).total_cmp(&length(b)).then(a.cmp(&b)));
    let mut sets = DisjointSets::new(n);
    let mut tree: Vec<[LandmarkId; 2]> =
        pairs.into_iter().filter(|[i, j]| sets.join(i.index(), j.index())).collect();
    match variant.order {
        TreeOrder::ShortestFirst => {}
        TreeOrder::LongestFirst => tree.reverse(),
        TreeOrder::LeavesFirst => tree = leaves_first(tree, n),
    }
    tree
}

/// Peels the tree from its leaves; within a layer the longest first.
fn leaves_first(tree: Vec<[LandmarkId; 2]>, n: usize) -> Vec<[LandmarkId; 2]> {
    let mut degree: TiVec<LandmarkId, usize> = ti_vec![0; n];
    tree.iter().flatten().for_each(|&i| degree[i] += 1);
    let mut left: Vec<[LandmarkId; 2]> = tree.into_iter().rev().collect();
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

/// Keys above this are no limit to paths: the areas are 1.
const NO_LIMIT: f64 = 1e6;

/// Pairs not yet adjacent, smallest key first, planned when they come up.
struct PairQueue<'a> {
    queue: MinQueue<[LandmarkId; 2], Option<Plan>>,
    variant: &'a Variant,
}

impl<'a> PairQueue<'a> {
    fn new(distances: &LandmarkDistances, drawing: &Drawing, variant: &'a Variant) -> Self {
        let drawn: BTreeSet<[LandmarkId; 2]> = drawing.ends.iter().copied().collect();
        let fresh = pairs(distances.landmark_count()).filter(|ends| !drawn.contains(ends));
        // No path is shorter than without obstacles.
        let key = |ends| variant.factor(ends) * distances.sum(ends);
        let queue = fresh.map(|ends| Queued { cost: key(ends), key: ends, value: None }).collect();
        Self { queue, variant }
    }

    /// The next pair's plan; `None` where there is none, or no search is allowed any more.
    fn next(&mut self, drawing: &Drawing, planner: &mut Planner<'_>) -> Option<Plan> {
        let faces = drawing.faces_by_slot();
        while let Some(Queued { cost: least, key: ends, value: plan }) = self.queue.pop() {
            if let Some(plan) = plan
                && drawing.still_valid(&plan)
            {
                return Some(plan);
            }
            if !planner.may_search() {
                return None;
            }
            // Without a common face there will never be a path.
            let Some(slots) = common_slots(&faces, ends) else { continue };
            let geodesics = planner.distances.between(ends);
            let factor = self.variant.factor(ends);
            let next_key = self.queue.least().unwrap_or(f64::INFINITY);
            // A search within a small limit is cheap: it grows by a fifth whenever the pair comes up again. Chosen by hand.
            let raised = 1.2 * next_key.max(least);
            // The limit grows from a positive number, so it ends; keys beyond the longest of paths need none.
            let limit = if raised > 0.0 && raised < NO_LIMIT { raised } else { f64::INFINITY };
            let limits = MeshSide::BOTH.map(|side| length_limit(limit / factor, geodesics, side));
            let Some(plan) = drawing.plan_within(planner, ends, &slots, limits) else {
                if limit.is_finite() {
                    self.queue.push(limit, ends, None);
                }
                continue;
            };
            let key = factor * key(&plan, geodesics);
            if key <= next_key {
                return Some(plan);
            }
            self.queue.push(key, ends, Some(plan));
        }
        None
    }
}

/// The places of the rotations at both landmarks that border a common face.
fn common_slots(faces: &TiSlice<LandmarkId, Vec<usize>>, [i, j]: [LandmarkId; 2]) -> Option<SlotPairs> {
    let shared = |at: LandmarkId, other: LandmarkId| -> Vec<usize> {
        (0..faces[at].len()).filter(|&k| faces[other].contains(&faces[at][k])).collect()
    };
    let slots = [shared(i, j), shared(j, i)];
    (!slots[0].is_empty()).then_some(slots)
}

/// The key of a plan: its total length times the square of its larger stretch (length / shortest length).
fn key(plan: &Plan, geodesics: [f64; 2]) -> f64 {
    let detour = (0..2).map(|s| plan.found[s].length / geodesics[s]).fold(1.0, f64::max);
    plan.length() * detour * detour
}

/// The length of a path on one mesh beyond which its key exceeds a limit, however short the path on the other mesh is.
fn length_limit(key: f64, geodesics: [f64; 2], side: MeshSide) -> f64 {
    if key.is_infinite() {
        return key;
    }
    let (own, other) = (geodesics[side], geodesics[side.other()]);
    let exceeds = |stretch: f64| (own * stretch + other) * stretch * stretch > key;
    let (mut below, mut above) = (0.0, 1.0 + key / other);
    // Bisection to 1e-9.
    for _ in 0..30 {
        let middle = 0.5 * (below + above);
        *(if exceeds(middle) { &mut above } else { &mut below }) = middle;
    }
    above * own
}

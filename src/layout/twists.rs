//! Neighbouring isotopy classes: Dehn twists, whole turns of the target about a curve between two groups of landmarks.
//!
//! A spanning tree with a single edge e between the groups determines the class. The complement of the tree without e is an
//! annulus between the groups, and the path from one end of e to the other that begins and ends just after (or just before)
//! e goes round it once more than e: exchanging e for it on one mesh alone is a Dehn twist. Both ends must have other
//! tree edges, or the turn is about a single landmark and changes nothing.

use super::drawing::{Drawing, Planner};
use super::error::LayoutError;
use super::joint::{complete, straighten};
use super::path_search::FoundPath;
use super::variants::PLAIN;
use crate::landmarks::{LandmarkId, MeshSide};
use crate::math::disjoint_sets::DisjointSets;
use typed_index_collections::{TiSlice, TiVec};

/// A whole turn of one group of landmarks against the others.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Twist {
    /// Whether each landmark is in the group.
    pub inside: TiVec<LandmarkId, bool>,
    /// The sense of the turn.
    pub turn: Turn,
    /// Length of the path between the groups after the turn, relative to before, on the mesh where that is least: near 1 both
    /// ways round are plausible.
    pub ratio: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    CounterClockwise,
    Clockwise,
}

/// All twists about the curves that a layout suggests, the most plausible first: between the two parts of its shortest tree
/// without an edge, and round two landmarks joined by a path.
///
/// # Errors
/// [`LayoutError::Cancelled`].
pub(super) fn plausible(
    drawing: &Drawing,
    planner: &mut Planner<'_>,
    largest_ratio: f64,
) -> Result<Vec<Twist>, LayoutError> {
    let mut twists = Vec::new();
    for inside in groups(drawing) {
        planner.begin();
        planner.tell(0.0)?;
        let Some(tree) = Tree::new(drawing, &inside) else { continue };
        for turn in [Turn::CounterClockwise, Turn::Clockwise] {
            if let Some(TurnedPath { ratio, .. }) = tree.turned_path(planner, turn)
                && ratio <= largest_ratio
            {
                twists.push(Twist { inside: inside.clone(), turn, ratio });
            }
        }
    }
    planner.tell(0.0)?;
    twists.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    Ok(twists)
}

/// Draws the neighbouring class: the tree with the turned path, completed anew. `None` where there is no such tree or path.
pub(super) fn twisted(
    drawing: &Drawing,
    planner: &mut Planner<'_>,
    twist: &Twist,
) -> Result<Option<Drawing>, LayoutError> {
    planner.begin();
    planner.tell(0.0)?;
    let tree = Tree::new(drawing, &twist.inside).and_then(|tree| tree.turned(planner, twist.turn));
    let Some(Tree { mut drawing, .. }) = tree else { return Ok(None) };
    complete(&mut drawing, planner, &PLAIN)?;
    straighten(&mut drawing, planner)?;
    Ok(Some(drawing))
}

/// Groups of landmarks on one side of a curve that crosses each path at most once.
fn groups(drawing: &Drawing) -> Vec<TiVec<LandmarkId, bool>> {
    let n = drawing.rotation.len();
    let order = shortest_first(drawing);
    let mut sets = DisjointSets::new(n);
    let tree: Vec<[LandmarkId; 2]> =
        order.iter().map(|&p| drawing.ends[p]).filter(|[i, j]| sets.join(i.index(), j.index())).collect();
    let mut groups: Vec<TiVec<LandmarkId, bool>> = Vec::new();
    for cut in 0..tree.len() {
        let mut parts = DisjointSets::new(n);
        for (k, [i, j]) in tree.iter().enumerate() {
            if k != cut {
                parts.join(i.index(), j.index());
            }
        }
        let root = parts.root(tree[cut][0].index());
        groups.push((0..n).map(|i| parts.root(i) == root).collect());
    }
    // Two landmarks at a short path, such as a knee and a foot.
    for &p in order.iter().take(n) {
        groups.push(drawing.rotation.keys().map(|i| drawing.ends[p].contains(&i)).collect());
    }
    for group in &mut groups {
        if !group[LandmarkId(0)] {
            group.iter_mut().for_each(|inside| *inside = !*inside);
        }
    }
    let mut distinct: Vec<TiVec<LandmarkId, bool>> = Vec::new();
    for group in groups {
        let inside = group.iter().filter(|g| **g).count();
        if inside >= 2 && n - inside >= 2 && !distinct.contains(&group) {
            distinct.push(group);
        }
    }
    distinct
}

/// The shortest spanning tree of a drawing: it determines the class.
pub(super) fn shortest_tree(complete: &Drawing) -> Drawing {
    let mut sets = DisjointSets::new(complete.rotation.len());
    let order = shortest_first(complete).into_iter().map(|p| complete.ends[p]);
    with_paths(complete, order.filter(|[i, j]| sets.join(i.index(), j.index())).collect())
}

/// The drawing with only those paths that join the given landmarks.
fn with_paths(complete: &Drawing, mut kept: Vec<[LandmarkId; 2]>) -> Drawing {
    let mut drawing = complete.clone();
    kept.sort_unstable();
    let is_kept = |ends: &[LandmarkId; 2]| kept.binary_search(ends).is_ok();
    while let Some(p) = drawing.ends.iter().rposition(|ends| !is_kept(ends)) {
        drawing.erase(p);
    }
    drawing.thin();
    drawing
}

fn shortest_first(drawing: &Drawing) -> Vec<usize> {
    let length = |p: usize| drawing.sides[0].lengths[p] + drawing.sides[1].lengths[p];
    let mut order: Vec<usize> = (0..drawing.ends.len()).collect();
    order.sort_by(|&p, &q| length(p).total_cmp(&length(q)).then(p.cmp(&q)));
    order
}

/// A drawing reduced to a spanning tree with one path between the groups.
struct Tree {
    drawing: Drawing,
    /// The path between the groups.
    between: usize,
}

/// A path of one mesh that goes round a group of landmarks once more.
struct TurnedPath {
    side: MeshSide,
    found: FoundPath,
    /// Its length relative to that of the path that it replaces.
    ratio: f64,
}

impl Tree {
    /// `None` where a group is not connected by paths inside it.
    fn new(complete: &Drawing, inside: &TiSlice<LandmarkId, bool>) -> Option<Self> {
        let mut sets = DisjointSets::new(inside.len());
        let order = shortest_first(complete);
        let within = |p: &usize| {
            complete.ends[*p].map(|i| inside[i]) != [true, false]
                && complete.ends[*p].map(|i| inside[i]) != [false, true]
        };
        let (within, across): (Vec<usize>, Vec<usize>) = order.into_iter().partition(within);
        let mut kept: Vec<[LandmarkId; 2]> = Vec::new();
        for p in within {
            let [i, j] = complete.ends[p];
            if sets.join(i.index(), j.index()) {
                kept.push([i, j]);
            }
        }
        if kept.len() + 2 != inside.len() {
            return None;
        }
        let bridge = complete.ends[*across.first()?];
        kept.push(bridge);
        let drawing = with_paths(complete, kept);
        let between = drawing.ends.iter().position(|&ends| ends == bridge)?;
        Some(Self { drawing, between })
    }

    /// The tree of the neighbouring class.
    fn turned(mut self, planner: &mut Planner<'_>, turn: Turn) -> Option<Self> {
        let TurnedPath { side, found, .. } = self.turned_path(planner, turn)?;
        self.drawing.exchange(side, self.between, &found)?;
        self.drawing.thin();
        Some(self)
    }

    /// The path that goes round once more, on the mesh where it is the shorter relative to the path that it replaces.
    fn turned_path(&self, planner: &mut Planner<'_>, turn: Turn) -> Option<TurnedPath> {
        let drawing = &self.drawing;
        let ends = drawing.ends[self.between];
        let mut best: Option<TurnedPath> = None;
        for side in MeshSide::BOTH {
            // A turn of one mesh is the opposite turn of the other.
            let after = (turn == Turn::CounterClockwise) == (side == MeshSide::Target);
            let slots = ends.map(|i| {
                let around = &drawing.rotation[i];
                let own = around.iter().position(|&p| p == self.between).unwrap_or(0);
                if after { own } else { (own + around.len() - 1) % around.len() }
            });
            let found = drawing.search_in_slots(planner, side, ends, slots, f64::INFINITY);
            let Some(found) = found else { continue };
            let ratio = found.length / drawing.sides[side].lengths[self.between];
            if best.as_ref().is_none_or(|b| ratio < b.ratio) {
                best = Some(TurnedPath { side, found, ratio });
            }
        }
        best
    }
}

/// Meshes for the tests of layouts.
#[cfg(test)]
pub(super) mod testing {
    use crate::landmarks::Landmarks;
    use crate::mesh::VertexId;
    use crate::mesh::coarsening::Level;
    use crate::monitor::Silent;

    /// A figure in two poses, coarse.
    pub(in crate::layout) fn figures() -> ([Level; 2], Landmarks) {
        let demo = crate::demo::build("poses").unwrap();
        let held = [0, 1].map(|s| demo.landmarks.iter().map(|p| VertexId(p[s])).collect::<Vec<_>>());
        let coarse = |mesh, held| Level::coarse(mesh, held, 500, &mut Silent).unwrap();
        let levels = [coarse(&demo.source, &held[0]), coarse(&demo.target, &held[1])];
        let [source, target] = [0, 1].map(|s| {
            let number = |v: &VertexId| levels[s].vertices.iter().position(|w| w == v).unwrap().into();
            held[s].iter().map(number).collect()
        });
        (levels, Landmarks { source, target })
    }
}

#[cfg(test)]
mod tests {
    use super::super::candidates::Candidates;
    use super::super::same_class;
    use super::testing::figures;
    use super::*;
    use crate::monitor::Silent;

    #[test]
    fn a_turn_leaves_the_class_and_the_turn_back_returns_to_it() {
        let (levels, landmarks) = figures();
        let mut candidates =
            Candidates::new([&levels[0].mesh, &levels[1].mesh], &landmarks, &mut Silent).unwrap();
        let first = candidates.next(&mut Silent).unwrap().unwrap();
        let distances = candidates.distances().clone();
        let mut silent = Silent;
        let mut planner = Planner::new(&distances, 1.0, &mut silent);
        let twists = plausible(first.drawing(), &mut planner, 3.0).unwrap();
        assert!(twists.len() >= 6, "{}", twists.len());
        for twist in twists.iter().take(6) {
            let back = match twist.turn {
                Turn::CounterClockwise => Turn::Clockwise,
                Turn::Clockwise => Turn::CounterClockwise,
            };
            let tree = Tree::new(first.drawing(), &twist.inside).unwrap();
            let once = tree.turned(&mut planner, twist.turn).unwrap();
            let mut completed = once.drawing.clone();
            complete(&mut completed, &mut planner, &PLAIN).unwrap();
            let turned = candidates.candidate(completed).unwrap();
            assert!(!same_class(&first.layout, &turned.layout));
            assert!(!same_class(&turned.layout, &first.layout));
            let mut returned = once.turned(&mut planner, back).unwrap().drawing;
            complete(&mut returned, &mut planner, &PLAIN).unwrap();
            let returned = candidates.candidate(returned).unwrap();
            assert!(same_class(&first.layout, &returned.layout));
            assert!(same_class(&returned.layout, &first.layout));
            assert!(!same_class(&turned.layout, &returned.layout));
        }
    }

    #[test]
    fn candidates_are_of_different_classes() {
        let (levels, landmarks) = figures();
        let mut candidates =
            Candidates::new([&levels[0].mesh, &levels[1].mesh], &landmarks, &mut Silent).unwrap();
        let mut all = Vec::new();
        while let Some(candidate) = candidates.next(&mut Silent).unwrap() {
            assert!(same_class(&candidate.layout, &candidate.layout));
            all.push(candidate);
        }
        let first = all[0].clone();
        all.extend(candidates.twists(&first, 4, 3.0, &mut Silent).unwrap());
        assert!(all.len() >= 5);
        for (k, a) in all.iter().enumerate() {
            assert!(all[..k].iter().all(|b| !same_class(&a.layout, &b.layout)));
        }
    }

    #[test]
    fn straightening_keeps_the_class() {
        let (levels, landmarks) = figures();
        let mut candidates =
            Candidates::new([&levels[0].mesh, &levels[1].mesh], &landmarks, &mut Silent).unwrap();
        let first = candidates.next(&mut Silent).unwrap().unwrap();
        let distances = candidates.distances().clone();
        let mut silent = Silent;
        let mut planner = Planner::new(&distances, 1.0, &mut silent);
        let twist = plausible(first.drawing(), &mut planner, 3.0).unwrap().swap_remove(0);
        let tree = Tree::new(first.drawing(), &twist.inside).unwrap();
        let mut bent = tree.turned(&mut planner, twist.turn).unwrap().drawing;
        complete(&mut bent, &mut planner, &PLAIN).unwrap();
        let mut straight = bent.clone();
        straighten(&mut straight, &mut planner).unwrap();
        let [bent, straight] = [bent, straight].map(|drawing| candidates.candidate(drawing).unwrap());
        assert!(same_class(&bent.layout, &straight.layout));
        assert!(straight.layout.report.detour <= bent.layout.report.detour);
    }

    #[test]
    fn erased_paths_leave_a_drawing_that_completes() {
        let (levels, landmarks) = figures();
        let mut candidates =
            Candidates::new([&levels[0].mesh, &levels[1].mesh], &landmarks, &mut Silent).unwrap();
        let first = candidates.next(&mut Silent).unwrap().unwrap();
        let distances = candidates.distances().clone();
        let mut silent = Silent;
        let mut planner = Planner::new(&distances, 1.0, &mut silent);
        let inside: TiVec<LandmarkId, bool> = groups(first.drawing())[0].clone();
        let mut tree = Tree::new(first.drawing(), &inside).unwrap().drawing;
        assert_eq!(tree.ends.len(), landmarks.len() - 1);
        assert_eq!(tree.rotation.iter().map(Vec::len).sum::<usize>(), 2 * tree.ends.len());
        complete(&mut tree, &mut planner, &PLAIN).unwrap();
        let again = candidates.candidate(tree).unwrap();
        assert!(same_class(&first.layout, &again.layout));
    }
}

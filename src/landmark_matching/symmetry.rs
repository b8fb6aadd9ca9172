//! The assignments that take left and right of one body to those of the other.
//!
//! Where both bodies have a reflection there are few of these, so all are tried, however different the proportions of the bodies are.

use super::reflection::Reflection;
use super::search::{Assignment, Tables};
use super::shape::Shape;
use crate::landmarks::MeshSide;

/// Assignments that differ only in left and right, the cheapest first; at least one.
pub(super) type Turns = Vec<Assignment>;

/// The assignments that take partners to partners and the middle line to the middle line, the cheapest first, in groups of those that differ
/// only in left and right; the groups are in the order of their cheapest ones. The given pairs come first in each. One tip on the middle
/// line may have no partner, without cost.
pub(super) fn equivariant(tables: &Tables<'_>, reflections: [&Reflection; 2]) -> Vec<Turns> {
    let [source, target] = reflections;
    let pairings = injections(source.pairs.len(), target.pairs.len(), 0);
    let middles = injections(source.middle.len(), target.middle.len(), 1);
    let mut found: Vec<Turns> = Vec::new();
    for pairing in &pairings {
        for middle in &middles {
            let on_middle = middle.iter().map(|&[s, t]| [source.middle[s], target.middle[t]]);
            let on_middle: Vec<[usize; 2]> = on_middle.collect();
            let turns = (0..1_usize << pairing.len()).filter_map(|turned| {
                let swap = |k: usize, flank: usize| flank ^ (turned >> k & 1);
                let both = pairing.iter().enumerate().flat_map(|(k, &[s, t])| {
                    [0, 1].map(|flank| [source.pairs[s][flank], target.pairs[t][swap(k, flank)]])
                });
                let pairs = with_given(tables.shapes, on_middle.iter().copied().chain(both))?;
                Some(tables.assignment(&pairs))
            });
            let mut turns: Turns = turns.collect();
            turns.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
            found.push(turns);
        }
    }
    // A limb that only one body has costs nothing.
    let is_rest = |a: &Assignment| a.unmatched.contains(&0);
    let cost = |turns: &Turns| {
        let first = &turns[0];
        first.full_cost() - if is_rest(first) { first.unmatched_cost } else { 0.0 }
    };
    found.retain(|turns| !turns.is_empty());
    found.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    found
}

/// The given pairs, then those of `pairs` that contradict none; `None` where one of them takes the tip that a given pair begins or ends at
/// elsewhere. A given pair between a tip and another place replaces the pairs of that tip.
fn with_given(shapes: [&Shape; 2], pairs: impl Iterator<Item = [usize; 2]>) -> Option<Vec<[usize; 2]>> {
    let given = shapes[0].given;
    let mut all: Vec<[usize; 2]> = (0..given).map(|k| [k, k]).collect();
    for pair in pairs {
        let of_given = MeshSide::BOTH.map(|side| Some(pair[side]).filter(|&k| k < given));
        let joins_tips = |k: usize| shapes.iter().all(|shape| shape.is_tip(k));
        match of_given {
            [None, None] => all.push(pair),
            [Some(s), Some(t)] if s == t => {}
            ends if ends.into_iter().flatten().any(joins_tips) => return None,
            _ => {}
        }
    }
    Some(all)
}

/// All injections of the smaller set into the larger one, and those in which up to `missing` elements of the smaller set have no image.
fn injections(sources: usize, targets: usize, missing: usize) -> Vec<Vec<[usize; 2]>> {
    let least = sources.min(targets).saturating_sub(missing);
    let mut all: Vec<Vec<[usize; 2]>> = vec![Vec::new()];
    for s in 0..sources {
        let longer = all.iter().flat_map(|pairs| {
            let free = (0..targets).filter(|t| pairs.iter().all(|pair| pair[1] != *t));
            free.map(|t| pairs.iter().copied().chain([[s, t]]).collect::<Vec<_>>())
        });
        let longer: Vec<Vec<[usize; 2]>> = longer.collect();
        all.extend(longer);
    }
    all.retain(|pairs| pairs.len() >= least);
    all
}

#[cfg(test)]
mod tests {
    use super::super::options::MatchOptions;
    use super::super::shape::Body;
    use super::super::test_bodies::{ENDS, four_footed};
    use super::*;
    use crate::mesh::VertexId;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    /// Where the ends of a body go that is matched with itself, each by its number, by the cheapest assignment that keeps left and right;
    /// the end `given[0]` is given to go to the end `given[1]`.
    fn images_of_ends(given: [usize; 2]) -> Vec<[usize; 2]> {
        let ball = icosphere(4);
        let at = |end: usize| {
            let distance = |v: &VertexId| ball.positions()[*v].distance(ENDS[end].normalize());
            ball.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
        };
        let mesh = four_footed();
        let options = MatchOptions::default();
        let shapes = given.map(|end| {
            let body = Body { mesh: &mesh, given: &[at(end)], may_mark: None };
            Shape::new(body, &options, &mut Silent).unwrap()
        });
        let tables = Tables::new([&shapes[0], &shapes[1]], &options);
        let [source, target] = &tables.reflections;
        let found = equivariant(&tables, [&source[0], &target[0]]);
        assert!(found.iter().flatten().all(|assignment| assignment.pairs[0] == [0, 0]));
        let end = |shape: &Shape, mark: usize| {
            let p = ball.positions()[shape.on_mesh(shape.marks[mark].vertex)];
            (0..ENDS.len()).find(|&end| ENDS[end].normalize().distance(p) < 0.25).unwrap()
        };
        let mut images: Vec<[usize; 2]> =
            found[0][0].pairs.iter().map(|&[s, t]| [end(&shapes[0], s), end(&shapes[1], t)]).collect();
        images.sort_unstable();
        images
    }

    #[test]
    fn a_given_end_takes_its_partner_along() {
        assert_eq!(images_of_ends([0, 0]), [0, 1, 2, 3, 4, 5].map(|end| [end, end]));
        // Half a turn: fore and hind feet exchanged, and left and right.
        assert_eq!(images_of_ends([0, 3]), [[0, 3], [1, 2], [2, 1], [3, 0], [4, 5], [5, 4]]);
    }

    #[test]
    fn every_way_to_give_partners_is_there_once() {
        assert_eq!(injections(2, 2, 0), [vec![[0, 0], [1, 1]], vec![[0, 1], [1, 0]]]);
        // Two ways with both, four with one.
        assert_eq!(injections(2, 2, 1).len(), 6);
        assert_eq!(injections(1, 3, 0).len(), 3);
        assert_eq!(injections(0, 2, 1), [Vec::<[usize; 2]>::new()]);
    }
}

//! The cyclic orders in which shortest paths to the others leave the landmarks, on both meshes.
//!
//! They show faults that distances do not: a reflection reverses them all, and where two near landmarks that lie side by side have
//! each other's target, the orders around either of the two that contain the other are reversed.

use super::directions::Directions;
use crate::landmarks::{LandmarkId, Landmarks, MeshSide};
use crate::layout::LandmarkDistances;
use crate::math::scalar::{max, min};
use crate::mesh::SurfaceMesh;
use std::f64::consts::TAU;
use typed_index_collections::{TiSlice, TiVec};

/// Landmarks around each landmark whose order is compared. Chosen by hand.
pub(super) const NEIGHBOURS: usize = 8;

/// The agreement, from -1 to 1, of the cyclic orders in which shortest paths leave the landmarks on both meshes.
///
/// Over all landmarks and triples of their nearest landmarks: 1 for the same order, -1 for the reverse, weighted by the
/// least angle between two of the three. A map that keeps the orientation gives a value near 1, a mirrored set near -1.
pub fn order_agreement(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    distances: &LandmarkDistances,
) -> f64 {
    let target_of: TiVec<LandmarkId, LandmarkId> = landmarks.source.keys().collect();
    agreement(&Directions::new(meshes, landmarks, distances), distances, &target_of)
}

/// The agreement of the orders, where `target_of` gives the pair whose target each pair has.
pub(super) fn agreement(
    directions: &Directions,
    distances: &LandmarkDistances,
    target_of: &TiSlice<LandmarkId, LandmarkId>,
) -> f64 {
    let mut votes = Votes::default();
    for i in target_of.keys() {
        let near = nearest(distances, target_of, i);
        for (k, &a) in near.iter().enumerate() {
            let source = directions.turns(MeshSide::Source, i, a);
            let target = directions.turns(MeshSide::Target, target_of[i], target_of[a]);
            for (l, &b) in near[..k].iter().enumerate() {
                for &c in &near[..l] {
                    let onto = [target[target_of[b]], target[target_of[c]]];
                    votes.add([order([source[b], source[c]]), order(onto)]);
                }
            }
        }
    }
    votes.agreement().unwrap_or(1.0)
}

/// A vote of the other landmarks on two pairs.
#[derive(Clone, Copy)]
pub(super) struct Vote {
    /// From -1, where the targets fit exchanged, to 1, where they fit as they are.
    pub agreement: f64,
    /// The strength of the evidence, 0 for none, in the unit of the quantities that vote.
    pub strength: f64,
}

/// The vote of the orders around either of two landmarks that contain the other; its strength is the mean weight of a triple
/// in radians. `target_of` gives the pair whose target each pair has.
pub(super) fn pair_vote(
    directions: &Directions,
    target_of: &TiSlice<LandmarkId, LandmarkId>,
    [a, b]: [LandmarkId; 2],
) -> Vote {
    let mut votes = Votes::default();
    for (at, to) in [(a, b), (b, a)] {
        let source = directions.turns(MeshSide::Source, at, to);
        let target = directions.turns(MeshSide::Target, target_of[at], target_of[to]);
        let others: Vec<LandmarkId> = target_of.keys().filter(|x| *x != a && *x != b).collect();
        for (k, &x) in others.iter().enumerate() {
            for &y in &others[..k] {
                let orders =
                    [order([source[x], source[y]]), order([target[target_of[x]], target[target_of[y]]])];
                votes.add(orders);
            }
        }
    }
    Vote { agreement: votes.agreement().unwrap_or(0.0), strength: votes.total / max(votes.count as f64, 1.0) }
}

/// The landmarks nearest to one on both meshes together, the nearest first.
pub(super) fn nearest(
    distances: &LandmarkDistances,
    target_of: &TiSlice<LandmarkId, LandmarkId>,
    i: LandmarkId,
) -> Vec<LandmarkId> {
    let sum = |j: LandmarkId| {
        let target = distances.between([target_of[i], target_of[j]])[MeshSide::Target];
        distances.between([i, j])[MeshSide::Source] + target
    };
    let mut near: Vec<LandmarkId> = target_of.keys().filter(|&j| j != i).collect();
    near.sort_by(|&j, &k| sum(j).total_cmp(&sum(k)).then(j.cmp(&k)));
    near.truncate(NEIGHBOURS);
    near
}

/// A sum of votes: signs of two values that agree or not, weighted by the lesser absolute value.
#[derive(Default)]
pub(super) struct Votes {
    sum: f64,
    total: f64,
    count: usize,
}

impl Votes {
    pub(super) fn add(&mut self, [s, t]: [f64; 2]) {
        let weight = min(s.abs(), t.abs());
        self.sum += if s * t < 0.0 { -weight } else { weight };
        self.total += weight;
        self.count += 1;
    }

    /// From -1 to 1; `None` without any triple.
    pub(super) fn agreement(&self) -> Option<f64> {
        (self.total > 0.0).then(|| self.sum / self.total)
    }
}

/// The least of the three angles between a first direction and two others at these turns from it, in radians; positive
/// when the three are in counter-clockwise order.
fn order([b, c]: [f64; 2]) -> f64 {
    let gap = min(min(b, c), min((b - c).abs(), TAU - max(b, c)));
    if b < c { gap } else { -gap }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cyclic_orders_have_the_sign_of_their_turn() {
        let of = |[a, b, c]: [f64; 3]| order([(b - a).rem_euclid(TAU), (c - a).rem_euclid(TAU)]);
        assert!((of([0.1, 1.0, 2.5]) - 0.9).abs() < 1e-12);
        assert!((of([1.0, 2.5, 0.1]) - 0.9).abs() < 1e-12);
        assert!((of([1.0, 0.1, 2.5]) + 0.9).abs() < 1e-12);
        assert_eq!(of([1.0, 1.0, 2.5]).abs(), 0.0);
    }

    #[test]
    fn votes_count_by_the_weaker_of_both() {
        let mut votes = Votes::default();
        assert_eq!(votes.agreement(), None);
        votes.add([0.5, 2.0]);
        votes.add([-1.0, 0.25]);
        assert!((votes.agreement().unwrap() - 1.0 / 3.0).abs() < 1e-12);
    }
}

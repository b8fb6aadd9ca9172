//! Landmarks that do not fit, found before a map is made: mirrored sets, swapped pairs, pairs on the wrong limb.
//!
//! All from distances between landmarks on both (coarse) meshes, areas scaled to 1. A map of low distortion nearly keeps
//! them, up to a common factor: log ratios out of line point at pairs. Distances do not see reflections; the order in
//! which shortest paths to the other landmarks leave a landmark does: it is reversed nearly everywhere in a mirrored set.
//! A finding is a doubt with numbers and a repair, not an error: the user knows the shapes.

use crate::landmarks::Landmarks;
use crate::layout::LandmarkDistances;
use crate::math::scalar::ln;
use crate::math::triangle::angle_at;
use crate::mesh::{SurfaceMesh, VertexId};
use std::f64::consts::TAU;
use std::fmt;

/// Added to distances before ratios are taken, in units of the root of the area: nearer landmarks say little.
const SOFTENING: f64 = 0.08;
/// Landmarks around each landmark whose order is compared.
const NEIGHBOURS: usize = 8;

/// Fewer landmarks than these say too little about orders, or about places.
const LEAST_FOR_ORDERS: usize = 6;
const LEAST_FOR_PLACES: usize = 8;
/// Pairs that fit have an agreement of 0.6 to 0.95.
const MIRRORED: f64 = -0.4;
/// An exchange must lower the misfit by this, and to this share.
const SWAP_GAIN: f64 = 0.15;
const SWAP_SHARE: f64 = 0.6;
/// Another place must lower the misfit by this, to this share, and be this far away.
const PLACE_GAIN: f64 = 0.2;
const PLACE_SHARE: f64 = 0.3;
const PLACE_DISTANCE: f64 = 0.3;

/// A doubt about landmark pairs; pairs are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The whole set is mirrored: left on one mesh is right on the other.
    Mirrored {
        /// Agreement of the orders around the landmarks, from -1 (all reversed) to 1 (all equal).
        agreement: f64,
    },
    /// Two pairs have each other's target.
    Swapped {
        /// The pairs.
        pairs: [usize; 2],
        /// Mean misfit of both pairs' distances (absolute log ratio) as it is and with the targets exchanged.
        misfit: [f64; 2],
    },
    /// One pair is far from where the others want it.
    Misplaced {
        /// The pair.
        pair: usize,
        /// Mean misfit of its distances (absolute log ratio) as it is and at the best place.
        misfit: [f64; 2],
        /// Distance of its target to the best place, in units of the root of the target's area.
        distance: f64,
        /// The best place: a vertex of the (coarse) target.
        place: VertexId,
        /// The pair whose target is nearest to that place, itself apart.
        near: usize,
    },
}

/// What to do about a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Repair {
    /// Exchange the targets of two pairs.
    Swap {
        /// The pairs.
        pairs: [usize; 2],
    },
    /// Mirror the target mesh, or exchange left and right in all pairs.
    MirrorTarget,
    /// Look at a pair.
    Check {
        /// The pair.
        pair: usize,
    },
}

impl Finding {
    /// The repair to offer.
    pub fn repair(&self) -> Repair {
        match *self {
            Self::Mirrored { .. } => Repair::MirrorTarget,
            Self::Swapped { pairs, .. } => Repair::Swap { pairs },
            Self::Misplaced { pair, .. } => Repair::Check { pair },
        }
    }

    /// One sentence for the user, with the pairs by name; pairs without a name are counted from 1.
    pub fn sentence(&self, labels: &[String]) -> String {
        let name = |pair: usize| match labels.get(pair).filter(|label| !label.is_empty()) {
            Some(label) => format!("{} ({label})", pair + 1),
            None => (pair + 1).to_string(),
        };
        match *self {
            Self::Mirrored { .. } => {
                "The landmarks are mirrored: left on one mesh is right on the other. Mirror the \
                                      target, or exchange left and right."
                    .into()
            }
            Self::Swapped { pairs: [a, b], .. } => format!(
                "The targets of the pairs {} and {} look swapped: exchanged, their distances to the others fit.",
                name(a),
                name(b)
            ),
            Self::Misplaced { pair, near, .. } => format!(
                "Pair {} does not fit the others: its target is expected elsewhere, near that of pair {}.",
                name(pair),
                name(near)
            ),
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence(&[]))
    }
}

/// Checks whether landmark pairs can belong to a map of low distortion; no findings when all fit.
///
/// `distances` are those of the same meshes and landmarks, coarse ones (some 1000 vertices) for speed.
pub fn landmark_fit(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    distances: &LandmarkDistances,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    if landmarks.len() >= LEAST_FOR_ORDERS {
        let agreement = order_agreement(meshes, landmarks, distances);
        if agreement < MIRRORED {
            findings.push(Finding::Mirrored { agreement });
        }
    }
    let mut fit = Fit::new(landmarks, distances);
    // Any order of n targets is n - 1 exchanges away, and an exchange may make others look worth while again.
    for _ in 1..landmarks.len() {
        let Some(finding) = fit.best_swap() else { break };
        let Finding::Swapped { pairs: [a, b], .. } = finding else { break };
        fit.target_of.swap(a, b);
        findings.push(finding);
    }
    if landmarks.len() >= LEAST_FOR_PLACES {
        while let Some(finding) = fit.worst_misplaced() {
            let Finding::Misplaced { pair, .. } = finding else { break };
            fit.left_out[pair] = true;
            findings.push(finding);
        }
    }
    findings
}

/// How far the cyclic orders in which shortest paths leave the landmarks agree on both meshes, from -1 to 1.
///
/// Over all landmarks and triples of their nearest landmarks: 1 for the same order, -1 for the reverse, weighted by the
/// least angle between two of the three. A map that keeps the orientation gives a value near 1, a mirrored set near -1.
pub fn order_agreement(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    distances: &LandmarkDistances,
) -> f64 {
    let n = landmarks.len();
    let (mut sum, mut total) = (0.0, 0.0);
    for i in 0..n {
        let mut near: Vec<usize> = (0..n).filter(|&j| j != i).collect();
        near.sort_by(|&j, &k| distances.sum([i, j]).total_cmp(&distances.sum([i, k])).then(j.cmp(&k)));
        near.truncate(NEIGHBOURS);
        let vertices = [landmarks.source[i], landmarks.target[i]];
        let angles = [0, 1].map(|s| directions(meshes[s], vertices[s], &near, |j| distances.field(s, j)));
        for a in 0..near.len() {
            for b in 0..a {
                for c in 0..b {
                    let [s, t] = [0, 1].map(|side| cyclic_order([a, b, c].map(|x| angles[side][x])));
                    let weight = s.abs().min(t.abs());
                    sum += weight * (s * t).signum();
                    total += weight;
                }
            }
        }
    }
    if total > 0.0 { sum / total } else { 1.0 }
}

/// The least of the three angles between directions, positive when they are in counter-clockwise order.
fn cyclic_order([a, b, c]: [f64; 3]) -> f64 {
    let (ab, ac) = ((b - a).rem_euclid(TAU), (c - a).rem_euclid(TAU));
    let gap = ab.min(ac).min((ab - ac).abs()).min(TAU - ab.max(ac));
    if ab < ac { gap } else { -gap }
}

/// The directions in which shortest paths to other landmarks leave a vertex; angles around it scaled to 2 pi.
fn directions<'a>(
    mesh: &SurfaceMesh,
    v: VertexId,
    to: &[usize],
    field: impl Fn(usize) -> &'a typed_index_collections::TiSlice<VertexId, f64>,
) -> Vec<f64> {
    let scale = 1.0 / mesh.area().sqrt();
    let place = mesh.positions()[v];
    let mut ring = Vec::new();
    let mut turned = 0.0;
    for h in mesh.star(v) {
        let (from, onto) = (mesh.head(h), mesh.tail(h.prev()));
        let width = angle_at(place, mesh.positions()[from], mesh.positions()[onto]);
        ring.push(([from, onto], turned, width));
        turned += width;
    }
    let direction = |j: &usize| {
        let field = field(*j);
        let mut best = (f64::INFINITY, 0.0);
        for &([from, onto], begin, width) in &ring {
            for share in [0.0, 0.25, 0.5, 0.75] {
                let point = mesh.positions()[from].lerp(mesh.positions()[onto], share);
                let rest = field[from] + share * (field[onto] - field[from]);
                let length = scale * point.distance(place) + rest;
                if length < best.0 {
                    best = (length, begin + share * width);
                }
            }
        }
        best.1 / turned * TAU
    };
    to.iter().map(direction).collect()
}

/// Distances between landmarks on the source against those on the target, by logarithm.
struct Fit<'a> {
    distances: &'a LandmarkDistances,
    /// Which pair's target each pair has.
    target_of: Vec<usize>,
    targets: &'a [VertexId],
    /// Pairs found misplaced: they say nothing about the others.
    left_out: Vec<bool>,
    /// Softened logarithms of the source's distances.
    source: Vec<Vec<f64>>,
    /// Of the target's distances, by landmark and vertex.
    target: Vec<Vec<f64>>,
}

impl<'a> Fit<'a> {
    fn new(landmarks: &'a Landmarks, distances: &'a LandmarkDistances) -> Self {
        let n = landmarks.len();
        let log = |d: f64| ln(d + SOFTENING);
        let source = (0..n).map(|i| (0..n).map(|j| log(distances.between([i, j])[0])).collect()).collect();
        let target = (0..n).map(|j| distances.field(1, j).iter().map(|&d| log(d)).collect()).collect();
        Self {
            distances,
            target_of: (0..n).collect(),
            targets: &landmarks.target,
            left_out: vec![false; n],
            source,
            target,
        }
    }

    fn len(&self) -> usize {
        self.target_of.len()
    }

    /// Mean absolute log ratio of a pair's distances to the others, were its target at `place`; nearer pairs count more.
    fn misfit(&self, pair: usize, place: VertexId, left_out: usize) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for j in (0..self.len()).filter(|&j| j != pair && j != left_out && !self.left_out[j]) {
            let (s, t) = (self.source[pair][j], self.target[self.target_of[j]][place.index()]);
            // The lesser of both distances, as a weight.
            let weight = 1.0 / crate::math::scalar::exp(s.min(t));
            sum += weight * (s - t).abs();
            total += weight;
        }
        sum / total
    }

    fn place(&self, pair: usize) -> VertexId {
        self.targets[self.target_of[pair]]
    }

    /// The exchange of two targets that lowers both pairs' misfit most, where that is much.
    fn best_swap(&self) -> Option<Finding> {
        let mut best: Option<(f64, Finding)> = None;
        for a in 0..self.len() {
            for b in 0..a {
                let now = self.misfit(a, self.place(a), b) + self.misfit(b, self.place(b), a);
                let then = self.misfit(a, self.place(b), b) + self.misfit(b, self.place(a), a);
                let misfit = [0.5 * now, 0.5 * then];
                let gain = misfit[0] - misfit[1];
                let clear = gain > SWAP_GAIN && misfit[1] < SWAP_SHARE * misfit[0];
                if clear && best.as_ref().is_none_or(|(most, _)| gain > *most) {
                    best = Some((gain, Finding::Swapped { pairs: [b, a], misfit }));
                }
            }
        }
        best.map(|(_, finding)| finding)
    }

    /// The pair of the largest misfit that would be much less at a place far from its target.
    fn worst_misplaced(&self) -> Option<Finding> {
        let now = |pair: usize| self.misfit(pair, self.place(pair), usize::MAX);
        let mut doubtful: Vec<(f64, usize)> = (0..self.len())
            .filter(|&pair| !self.left_out[pair])
            .map(|pair| (now(pair), pair))
            .filter(|(misfit, _)| *misfit > PLACE_GAIN)
            .collect();
        doubtful.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        doubtful.into_iter().find_map(|(misfit, pair)| self.better_place(pair, misfit))
    }

    fn better_place(&self, pair: usize, now: f64) -> Option<Finding> {
        let vertices = (0..self.target[0].len()).map(VertexId::from);
        let placed = vertices.map(|v| (self.misfit(pair, v, usize::MAX), v));
        let (then, place) = placed.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let away = |j: usize| self.distances.field(1, self.target_of[j])[place];
        let others = (0..self.len()).filter(|&j| j != pair);
        let near = others.min_by(|&i, &j| away(i).total_cmp(&away(j)))?;
        let distance = away(pair);
        let clear = now - then > PLACE_GAIN && then < PLACE_SHARE * now && distance > PLACE_DISTANCE;
        clear.then_some(Finding::Misplaced { pair, misfit: [now, then], distance, place, near })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cyclic_orders_have_the_sign_of_their_turn() {
        assert!((cyclic_order([0.1, 1.0, 2.5]) - 0.9).abs() < 1e-12);
        assert!((cyclic_order([1.0, 2.5, 0.1]) - 0.9).abs() < 1e-12);
        assert!((cyclic_order([1.0, 0.1, 2.5]) + 0.9).abs() < 1e-12);
        assert_eq!(cyclic_order([1.0, 1.0, 2.5]).abs(), 0.0);
    }

    #[test]
    fn findings_name_pairs_and_repairs() {
        let labels = ["nose", "tail"].map(String::from);
        let swapped = Finding::Swapped { pairs: [0, 1], misfit: [0.5, 0.1] };
        assert_eq!(swapped.repair(), Repair::Swap { pairs: [0, 1] });
        let sentence = swapped.sentence(&labels);
        assert!(sentence.contains("1 (nose)") && sentence.contains("2 (tail)"), "{sentence}");
        assert!(swapped.to_string().contains("pairs 1 and 2"), "{swapped}");
        let mirrored = Finding::Mirrored { agreement: -0.8 };
        assert_eq!(mirrored.repair(), Repair::MirrorTarget);
    }
}

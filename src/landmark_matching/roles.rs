//! The roles of a body's tips under its reflection: twins, as two ears are, or on the middle line, as a nose is.
//!
//! Whether ear, nose or crown is the most persistent tip of a head differs from body to body, so that tips of heads matched by persistence
//! are easily exchanged, and the long neck of one body draws the other's face along. That ears are two and a nose is one holds for all.

use super::reflection::Reflection;
use super::shape::Shape;
use crate::math::scalar::ln;

/// Largest mean log ratio of the distances of twins to mirrored marks: feet of sixteen animals have up to 0.06.
const MIRRORED: f64 = 0.06;
/// Largest distance of twins from each other, and from the tip on the middle line that belongs to them, in units of the root of the area.
/// Chosen by hand.
const NEAR: f64 = 0.5;
/// Weight of the log ratio of persistence beside that of distances: it pairs horn with horn and ear with ear. Chosen by hand.
const PERSISTENCE: f64 = 0.01;

/// The limbs of a body that have a left and a right, and the roles of its other tips.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Roles {
    /// Left and right limbs, in no order.
    pub(super) limbs: Vec<[usize; 2]>,
    /// Other tips that mirror each other, in no order.
    pub(super) twins: Vec<[usize; 2]>,
    /// Tips on the middle line, the most persistent first.
    pub(super) middle: Vec<usize>,
}

impl Roles {
    /// The roles of all tips; none where there are no left and right limbs. `main`: the numbers of the main tips.
    pub(super) fn new(shape: &Shape, reflection: Option<&Reflection>, main: &[usize]) -> Self {
        let Some(reflection) = reflection else { return Self::default() };
        let is_limb = |pair: &&[usize; 2]| pair.iter().all(|k| main.contains(k));
        let limbs: Vec<[usize; 2]> = reflection.pairs.iter().filter(is_limb).copied().collect();
        if limbs.is_empty() {
            return Self::default();
        }
        let others: Vec<usize> =
            shape.tips().filter(|k| !limbs.iter().flatten().any(|limb| limb == k)).collect();
        let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
        for (k, &b) in others.iter().enumerate() {
            for &a in &others[..k] {
                let sides = [a, b].map(|k| to_sides(shape, &limbs, k));
                let cost = off_mirror(shape, &limbs, [a, b]);
                // Each mirrors the other better than itself, which a nose and one of two ears do not.
                let own = [a, b].map(|k| off_mirror(shape, &limbs, [k; 2]));
                let mirrors = cost < MIRRORED && cost < own[0].min(own[1]);
                if sides[0] * sides[1] < 0.0 && mirrors && shape.distance([a, b]) < NEAR {
                    let ratio = ln(shape.marks[a].persistence / shape.marks[b].persistence).abs();
                    pairs.push((cost + PERSISTENCE * ratio, [a, b]));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut roles = Self { limbs, ..Self::default() };
        for (_, pair) in pairs {
            if !pair.iter().any(|&k| roles.is_twin(k)) {
                roles.twins.push(pair);
            }
        }
        let on_middle = |k: &usize| !roles.is_twin(*k) && off_mirror(shape, &roles.limbs, [*k; 2]) < MIRRORED;
        roles.middle = others.into_iter().filter(on_middle).collect();
        roles
    }

    pub(super) fn is_twin(&self, mark: usize) -> bool {
        self.twins.iter().flatten().any(|&k| k == mark)
    }

    /// The most persistent tip on the middle line near twins.
    pub(super) fn between(&self, shape: &Shape, twins: [usize; 2]) -> Option<usize> {
        let is_near = |k: &&usize| twins.iter().all(|&twin| shape.distance([**k, twin]) < NEAR);
        self.middle.iter().find(is_near).copied()
    }
}

/// Mean log ratio of the distances of two marks to mirrored limbs; 0 for twins of a symmetric body.
fn off_mirror(shape: &Shape, limbs: &[[usize; 2]], [a, b]: [usize; 2]) -> f64 {
    let ratio = |x: usize, y: usize| (ln(shape.distance([a, x])) - ln(shape.distance([b, y]))).abs();
    let sum: f64 = limbs.iter().map(|&[l, r]| 0.5 * (ratio(l, r) + ratio(r, l))).sum();
    sum / limbs.len() as f64
}

/// Mean log ratio of a mark's distances to the second and to the first limb of each pair: above 0 on the side of the first limbs.
pub(super) fn to_sides(shape: &Shape, limbs: &[[usize; 2]], mark: usize) -> f64 {
    let ratio = |&[l, r]: &[usize; 2]| ln(shape.distance([mark, r])) - ln(shape.distance([mark, l]));
    limbs.iter().map(ratio).sum::<f64>() / limbs.len() as f64
}

/// The number of the source's twins that go to twins of the target, and of tips on the middle line of one body that go to one of twins of
/// the other.
pub(super) fn kept([source, target]: [&Roles; 2], pairs: &[[usize; 2]]) -> [usize; 2] {
    let image = |s: usize| pairs.iter().find(|pair| pair[0] == s).map(|pair| pair[1]);
    let goes = |&&[a, b]: &&[usize; 2]| {
        let images = [image(a), image(b)];
        target.twins.iter().any(|&[x, y]| images == [Some(x), Some(y)] || images == [Some(y), Some(x)])
    };
    let mixes = |&&[s, t]: &&[usize; 2]| {
        (source.middle.contains(&s) && target.is_twin(t)) || (source.is_twin(s) && target.middle.contains(&t))
    };
    [source.twins.iter().filter(goes).count(), pairs.iter().filter(mixes).count()]
}

//! The orders in which a layout is drawn: that of the spanning tree, and perturbed weights of the paths.

use crate::landmarks::LandmarkId;

/// The order in which the spanning tree's edges are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeOrder {
    /// Longest edge first.
    LongestFirst,
    /// Layer by layer from the leaves.
    LeavesFirst,
    /// Shortest edge first.
    ShortestFirst,
}

/// The parameters of one attempt at a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Variant {
    pub order: TreeOrder,
    /// Multiplies the length of links that touch a midpoint.
    pub midpoint_penalty: f64,
    /// Distances and keys are multiplied by up to 1 + this, by a hash of the pair and the seed.
    pub perturbation: f64,
    pub seed: u64,
}

impl Variant {
    /// The factor of a pair of landmarks, from 1 to 1 + the perturbation.
    pub fn factor(&self, [i, j]: [LandmarkId; 2]) -> f64 {
        // splitmix64 (Steele, Lea, Flood 2014) of the pair and the seed.
        let pair = (u64::from(i.0) << 32) | u64::from(j.0);
        let mut x = pair.wrapping_add(self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        for multiplier in [0xbf58_476d_1ce4_e5b9_u64, 0x94d0_49bb_1331_11eb] {
            x = (x ^ (x >> 30)).wrapping_mul(multiplier);
        }
        1.0 + self.perturbation * ((x >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Without perturbation; the order does not matter once a tree is drawn.
pub(super) const PLAIN: Variant =
    Variant { order: TreeOrder::LongestFirst, midpoint_penalty: 1.0, perturbation: 0.0, seed: 0 };

/// The orders of drawing, the best on average first. Penalties and perturbations were chosen by hand; the figures behind the order
/// were not kept.
pub(super) const VARIANTS: [Variant; 16] = {
    use TreeOrder::{LeavesFirst, LongestFirst, ShortestFirst};
    const fn plain(order: TreeOrder, midpoint_penalty: f64) -> Variant {
        Variant { order, midpoint_penalty, perturbation: 0.0, seed: 0 }
    }
    const fn perturbed(order: TreeOrder, perturbation: f64, seed: u64) -> Variant {
        Variant { order, midpoint_penalty: 1.0, perturbation, seed }
    }
    [
        plain(LongestFirst, 1.0),
        plain(LeavesFirst, 1.0),
        plain(LongestFirst, 1.3),
        plain(LeavesFirst, 1.3),
        plain(ShortestFirst, 1.0),
        plain(ShortestFirst, 1.3),
        perturbed(LongestFirst, 0.3, 1),
        perturbed(LeavesFirst, 0.3, 2),
        perturbed(ShortestFirst, 0.3, 3),
        perturbed(LongestFirst, 0.3, 4),
        perturbed(LeavesFirst, 0.6, 5),
        perturbed(LongestFirst, 0.6, 6),
        perturbed(ShortestFirst, 0.6, 7),
        perturbed(LeavesFirst, 0.6, 8),
        perturbed(LongestFirst, 1.0, 9),
        perturbed(LeavesFirst, 1.0, 10),
    ]
};

/// The starts of descents ([`super::descent`]), in batches; a descent begins with the straightest of each. The longest edge first leads to
/// the straightest drawings, and with a perturbation of 0.6 or 1 more often than with 0.3; with the shortest first paths wind most
/// (detours of 2 to 9 in place of 0.2 on seven pairs). Four batches bound the time where no descent ends straight.
pub(super) const STARTS: [[Variant; 4]; 4] = {
    use TreeOrder::{LeavesFirst, LongestFirst};
    const fn start(order: TreeOrder, perturbation: f64, seed: u64) -> Variant {
        Variant { order, midpoint_penalty: 1.0, perturbation, seed }
    }
    [
        [
            start(LongestFirst, 0.0, 0),
            start(LeavesFirst, 0.0, 0),
            start(LongestFirst, 0.6, 1),
            start(LongestFirst, 1.0, 2),
        ],
        [
            start(LongestFirst, 0.6, 3),
            start(LongestFirst, 1.0, 4),
            start(LeavesFirst, 0.6, 5),
            start(LongestFirst, 0.6, 6),
        ],
        [
            start(LongestFirst, 1.0, 7),
            start(LeavesFirst, 1.0, 8),
            start(LongestFirst, 0.6, 9),
            start(LongestFirst, 0.3, 10),
        ],
        [
            start(LongestFirst, 1.0, 11),
            start(LeavesFirst, 0.6, 12),
            start(LongestFirst, 0.6, 13),
            start(LeavesFirst, 1.0, 14),
        ],
    ]
};

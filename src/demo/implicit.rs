//! Implicit surfaces made of round cones that are blended into each other.

use crate::math::scalar::max;
use crate::math::segment::nearest_share;
use glam::DVec3;

/// A cone between two balls.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundCone {
    pub ends: [DVec3; 2],
    pub radii: [f64; 2],
    /// The middle of its axis, and the radius of a ball around it that holds the cone.
    ball: (DVec3, f64),
}

impl RoundCone {
    pub fn new(a: DVec3, b: DVec3, radii: [f64; 2]) -> Self {
        Self { ends: [a, b], radii, ball: (a.midpoint(b), 0.5 * a.distance(b) + max(radii[0], radii[1])) }
    }

    /// Whether the ball around the cone proves that the cone's value at `p` is larger than `value`.
    fn is_beyond(&self, p: DVec3, value: f64) -> bool {
        let (centre, radius) = self.ball;
        let far = radius + value;
        far < 0.0 || p.distance_squared(centre) > far * far
    }

    /// The distance from the cone's axis minus the cone's radius at the nearest point of the axis; for slender cones nearly the distance
    /// from the cone.
    fn value(&self, p: DVec3) -> f64 {
        let along = self.ends[1] - self.ends[0];
        let t = nearest_share(p, self.ends);
        p.distance(self.ends[0] + along * t) - (self.radii[0] + (self.radii[1] - self.radii[0]) * t)
    }
}

/// Cones blended over a distance.
#[derive(Clone, Debug)]
pub(super) struct SmoothUnion {
    pub cones: Vec<RoundCone>,
    pub blend: f64,
}

impl SmoothUnion {
    /// The value of the union at a place: negative inside, and about the distance from the surface.
    pub fn value(&self, p: DVec3) -> f64 {
        self.cones.iter().fold(f64::INFINITY, |d, cone| {
            // What is farther by the blend leaves the minimum as it is, to the last bit.
            if cone.is_beyond(p, d + self.blend) { d } else { smooth_minimum(d, cone.value(p), self.blend) }
        })
    }

    /// Lowest and highest corner of a box around the surface.
    pub fn bounds(&self) -> [DVec3; 2] {
        let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        self.cones.iter().flat_map(|c| [(c.ends[0], c.radii[0]), (c.ends[1], c.radii[1])]).fold(
            start,
            |[l, h], (p, r)| {
                let margin = DVec3::splat(r + self.blend);
                [l.min(p - margin), h.max(p + margin)]
            },
        )
    }
}

/// The polynomial smooth minimum of width `k`.
fn smooth_minimum(a: f64, b: f64, k: f64) -> f64 {
    if !a.is_finite() {
        return b;
    }
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * k * 0.25
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn place() -> impl Strategy<Value = DVec3> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from_array)
    }

    fn cone() -> impl Strategy<Value = RoundCone> {
        (place(), place(), [0.05..0.4, 0.05..0.4]).prop_map(|(a, b, radii)| RoundCone::new(a, b, radii))
    }

    proptest! {
        #[test]
        fn cones_that_are_left_out_change_no_bit(
            cones in proptest::collection::vec(cone(), 1..8),
            blend in 0.05..0.3,
            p in place(),
        ) {
            let all = cones.iter().fold(f64::INFINITY, |d, cone| smooth_minimum(d, cone.value(p), blend));
            prop_assert_eq!(SmoothUnion { cones, blend }.value(p).to_bits(), all.to_bits());
        }
    }
}

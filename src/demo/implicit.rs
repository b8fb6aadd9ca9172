//! Smooth unions of round cones.

use crate::math::segment::nearest_share;
use glam::DVec3;

/// A cone between two balls.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundCone {
    pub ends: [DVec3; 2],
    pub radii: [f64; 2],
}

impl RoundCone {
    pub fn new(a: DVec3, b: DVec3, radii: [f64; 2]) -> Self {
        Self { ends: [a, b], radii }
    }

    /// Distance to the segment minus the radius at the nearest point: near the true distance for slender cones.
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
    /// Negative inside.
    pub fn value(&self, p: DVec3) -> f64 {
        self.cones.iter().fold(f64::INFINITY, |d, cone| smooth_minimum(d, cone.value(p), self.blend))
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

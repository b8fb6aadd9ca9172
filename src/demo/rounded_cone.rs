//! The distance from a cone whose apex and rim are rounded.

use crate::math::scalar::{max, min};
use crate::math::segment::nearest_share_in_plane;
use glam::{DVec2, DVec3};

/// A cone that stands on the plane y = 0 around the y axis, with rounded apex and rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundedCone {
    /// The base radius and the height of the sharp cone that lies inside at the distance `round` from the surface.
    inner: DVec2,
    round: f64,
}

impl RoundedCone {
    /// The sharp cone of this radius and height with its apex and its rim rounded by balls of radius `round`.
    pub fn new(radius: f64, height: f64, round: f64) -> Self {
        let slant = DVec2::new(radius, height).length();
        // The slant and the base move inwards; the inner cone is similar to the outer one.
        let inner = height - round - round * slant / radius;
        Self { inner: DVec2::new(radius * inner / height, inner), round }
    }

    /// The distance of a place from it; negative inside.
    pub fn value(&self, p: DVec3) -> f64 {
        let q = DVec2::new(DVec2::new(p.x, p.z).length(), p.y - self.round);
        let DVec2 { x: radius, y: height } = self.inner;
        let [rim, apex] = [DVec2::new(radius, 0.0), DVec2::new(0.0, height)];
        let beyond_slant = (q - rim).dot(DVec2::new(height, radius).normalize());
        let sharp = if beyond_slant < 0.0 && q.y > 0.0 {
            max(beyond_slant, -q.y)
        } else {
            min(to_segment(q, [rim, apex]), to_segment(q, [DVec2::ZERO, rim]))
        };
        sharp - self.round
    }

    /// Lowest and highest corner of a box around it.
    pub fn bounds(&self) -> [DVec3; 2] {
        let reach = self.inner.x + self.round;
        [DVec3::new(-reach, 0.0, -reach), DVec3::new(reach, self.inner.y + 2.0 * self.round, reach)]
    }
}

/// The distance of a point from a segment.
fn to_segment(q: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    q.distance(a + (b - a) * nearest_share_in_plane(q, [a, b]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_are_those_of_the_sharp_cone_and_the_edges_are_round() {
        let (radius, height, round) = (0.6, 0.8, 0.1);
        let cone = RoundedCone::new(radius, height, round);
        // On the slant, which is 1 long and has the normal (0.8, 0.6), and on the base.
        let [middle, normal] = [DVec3::new(0.3, 0.4, 0.0), DVec3::new(0.8, 0.6, 0.0)];
        for (place, value) in [
            (middle, 0.0),
            (middle + normal * 0.2, 0.2),
            (middle - normal * 0.05, -0.05),
            (DVec3::ZERO, 0.0),
            (DVec3::new(0.1, -0.3, -0.1), 0.3),
        ] {
            assert!((cone.value(place) - value).abs() < 1e-12, "{place}");
        }
        assert!(cone.value(DVec3::Y * height) > 0.05);
        assert!(cone.value(DVec3::Z * radius) > 0.05);
        let [low, high] = cone.bounds();
        assert!((low.y, high.y) == (0.0, high.y) && cone.value(DVec3::Y * high.y).abs() < 1e-12);
        assert!(cone.value(DVec3::new(high.x, round, 0.0)).abs() < 1e-12);
    }
}

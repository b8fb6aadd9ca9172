//! Faces unfolded into the plane, and the windows through which a source sees them.

use crate::math::scalar::max;
use glam::DVec2;

/// The centre of a circular front, below the edge from (0, 0) to (length, 0), from its distances to both ends.
///
/// `None` where there is no such point: two fronts that have not met, or an edge without length.
pub(super) fn source_below(length: f64, [at_a, at_b]: [f64; 2]) -> Option<DVec2> {
    let x = 0.5 * (length + (at_a - at_b) * ((at_a + at_b) / length));
    let below = (at_a - x) * (at_a + x);
    // Also where one of them is not a number.
    (length > 0.0 && below >= 0.0).then(|| DVec2::new(x, -below.sqrt()))
}

/// The third corner of a triangle to the left of its side from a to b, from the lengths of a b, b c and c a.
pub(super) fn apex([a, b]: [DVec2; 2], [ab, bc, ca]: [f64; 3]) -> DVec2 {
    let along = (b - a) / ab;
    let x = 0.5 * (ab + (ca - bc) * ((ca + bc) / ab));
    let y = max(0.0, (ca - x) * (ca + x)).sqrt();
    a + x * along + y * along.perp()
}

/// The sector that a source sees between two points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub source: DVec2,
    pub left: DVec2,
    pub right: DVec2,
}

impl Window {
    /// The parts to the left and to the right of a point beyond; `None` for an empty part. Both are there where the source sees the point.
    pub(super) fn split(self, at: DVec2) -> [Option<Self>; 2] {
        let (direction, source) = (at - self.source, self.source);
        let is_right_of_left = direction.perp_dot(self.left - source) >= 0.0;
        let is_left_of_right = (self.right - source).perp_dot(direction) >= 0.0;
        let left = Self { right: if is_left_of_right { at } else { self.right }, ..self };
        let right = Self { left: if is_right_of_left { at } else { self.left }, ..self };
        [is_right_of_left.then_some(left), is_left_of_right.then_some(right)]
    }
}

//! Segments of straight lines.

use glam::{DVec2, DVec3};

/// The share of a segment of space, from 0 at its start to 1 at its end, at which it is nearest to a point; 0 where it has no length.
#[inline]
pub fn nearest_share(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    within((p - a).dot(along), along.length_squared())
}

/// The same in the plane.
#[inline]
pub fn nearest_share_in_plane(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    within((p - a).dot(along), along.length_squared())
}

#[inline]
fn within(along: f64, squared_length: f64) -> f64 {
    if squared_length > 0.0 { (along / squared_length).clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_beyond_the_ends_are_nearest_to_them() {
        let ends = [DVec3::new(1.0, 0.0, 2.0), DVec3::new(1.0, 4.0, 2.0)];
        let share = |x: f64, y: f64| nearest_share(DVec3::new(x, y, -1.0), ends);
        assert_eq!([share(0.0, -3.0), share(5.0, 1.0), share(1.0, 9.0)], [0.0, 0.25, 1.0]);
        assert_eq!(nearest_share(DVec3::ONE, [DVec3::X; 2]), 0.0);
        let flat = ends.map(|end| end.truncate());
        assert_eq!(nearest_share_in_plane(DVec2::new(7.0, 3.0), flat), 0.75);
        assert_eq!(nearest_share_in_plane(DVec2::ONE, [DVec2::X; 2]), 0.0);
    }
}

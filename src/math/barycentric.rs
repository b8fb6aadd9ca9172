//! Barycentric coordinates.

use super::triangle::signed_double_area;
use glam::DVec2;
use std::ops::{Add, Mul};

/// Weights without what is negative, scaled to the sum 1.
pub fn clamped(weights: [f64; 3]) -> [f64; 3] {
    let kept = weights.map(|w| w.max(0.0));
    let sum: f64 = kept.iter().sum();
    kept.map(|w| w / sum)
}

/// Double areas of the triangles that a point of the plane makes with the sides of a triangle: its barycentric coordinates, but
/// for their sum.
pub fn shares([a, b, c]: [DVec2; 3], p: DVec2) -> [f64; 3] {
    [signed_double_area(p, b, c), signed_double_area(p, c, a), signed_double_area(p, a, b)]
}

/// Barycentric coordinates of p in a triangle of the plane, clamped to it.
pub fn clamped_in(corners: [DVec2; 3], p: DVec2) -> [f64; 3] {
    clamped(shares(corners, p))
}

/// The value at a point of a triangle, given by its barycentric coordinates, of what is linear there and known at the corners.
#[inline]
pub fn interpolated<T: Mul<f64, Output = T> + Add<Output = T>>([p, q, r]: [T; 3], [u, v, w]: [f64; 3]) -> T {
    p * u + q * v + r * w
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_interpolated_at_a_point_is_the_point() {
        let corners = [DVec2::new(1.0, 0.0), DVec2::new(3.0, 1.0), DVec2::new(0.0, 4.0)];
        let p = DVec2::new(1.5, 1.25);
        let whole = signed_double_area(corners[0], corners[1], corners[2]);
        let found = interpolated(corners, shares(corners, p).map(|share| share / whole));
        assert!(found.distance(p) < 1e-14);
        assert_eq!(interpolated([2.0, 4.0, 8.0], [0.5, 0.25, 0.25]), 4.0);
    }

    #[test]
    fn points_outside_go_to_the_border() {
        let corners = [DVec2::ZERO, DVec2::new(2.0, 0.0), DVec2::new(0.0, 2.0)];
        assert_eq!(clamped_in(corners, DVec2::new(0.5, 0.5)), [0.5, 0.25, 0.25]);
        assert_eq!(clamped_in(corners, DVec2::new(1.0, -0.5)), [0.6, 0.4, 0.0]);
        assert_eq!(clamped_in(corners, DVec2::new(-3.0, -1.0)), [1.0, 0.0, 0.0]);
    }
}

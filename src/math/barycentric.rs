//! Barycentric coordinates.

use super::triangle::signed_double_area;
use glam::DVec2;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_outside_go_to_the_border() {
        let corners = [DVec2::ZERO, DVec2::new(2.0, 0.0), DVec2::new(0.0, 2.0)];
        assert_eq!(clamped_in(corners, DVec2::new(0.5, 0.5)), [0.5, 0.25, 0.25]);
        assert_eq!(clamped_in(corners, DVec2::new(1.0, -0.5)), [0.6, 0.4, 0.0]);
        assert_eq!(clamped_in(corners, DVec2::new(-3.0, -1.0)), [1.0, 0.0, 0.0]);
    }
}

//! Triangles from edge lengths or corner positions.

use super::scalar::{atan2, max};
use glam::{DMat2, DVec2, DVec3};

/// Area of a triangle from its edge lengths by Kahan's stable form of Heron's formula.
///
/// Returns 0 where the triangle inequality fails.
pub fn area_from_lengths(a: f64, b: f64, c: f64) -> f64 {
    let (a, b) = if a < b { (b, a) } else { (a, b) };
    let (a, c) = if a < c { (c, a) } else { (a, c) };
    let (b, c) = if b < c { (c, b) } else { (b, c) };
    let product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    0.25 * max(product, 0.0).sqrt()
}

/// Interior angle, in radians, opposite edge `opposite`; `adjacent` are the two edges at the corner.
pub fn angle_from_lengths(opposite: f64, adjacent: [f64; 2]) -> f64 {
    let [b, c] = adjacent;
    let area = area_from_lengths(opposite, b, c);
    atan2(2.0 * area, 0.5 * ((b - opposite) * (b + opposite) + c * c))
}

/// Interior angle, in radians, at `p` of the triangle p, q, r.
pub fn angle_at(p: DVec3, q: DVec3, r: DVec3) -> f64 {
    angle_between(q - p, r - p)
}

/// The angle between two directions of space, in radians, from 0 to pi.
pub fn angle_between(u: DVec3, v: DVec3) -> f64 {
    atan2(u.cross(v).length(), u.dot(v))
}

/// The cotangent of the angle between two directions of space; infinite or not a number where they are parallel.
pub fn cotangent_between(u: DVec3, v: DVec3) -> f64 {
    u.dot(v) / u.cross(v).length()
}

/// Area of the triangle p, q, r in space.
pub fn area(p: DVec3, q: DVec3, r: DVec3) -> f64 {
    0.5 * (q - p).cross(r - p).length()
}

/// Twice the signed area of the triangle p, q, r in the plane; positive when counter-clockwise.
#[inline]
pub fn signed_double_area(p: DVec2, q: DVec2, r: DVec2) -> f64 {
    (q - p).perp_dot(r - p)
}

/// The angle from one direction of the plane to another, in radians, positive counter-clockwise.
pub fn turn(from: DVec2, to: DVec2) -> f64 {
    atan2(from.perp_dot(to), from.dot(to))
}

/// Gradients of the hat functions of a triangle's corners in its plane.
#[inline]
pub fn hat_gradients([p, q, r]: [DVec2; 3]) -> [DVec2; 3] {
    let double_area = signed_double_area(p, q, r);
    [r - q, p - r, q - p].map(|side| side.perp() / double_area)
}

/// The Jacobian of the affine map that takes a triangle with these gradients of its hat functions to one with these corners.
#[inline]
pub fn jacobian(corners: &[DVec2; 3], hats: &[DVec2; 3]) -> DMat2 {
    let column =
        |c: fn(DVec2) -> f64| corners[0] * c(hats[0]) + corners[1] * c(hats[1]) + corners[2] * c(hats[2]);
    DMat2::from_cols(column(|g| g.x), column(|g| g.y))
}

/// Corner positions in the plane of a triangle with edge lengths |01|, |12|, |20|: corner 0 at the origin, corner 1
/// on the positive x axis, corner 2 above it.
pub fn lay_out([l01, l12, l20]: [f64; 3]) -> [DVec2; 3] {
    let area = area_from_lengths(l01, l12, l20);
    let x = (l01 * l01 + (l20 - l12) * (l20 + l12)) / (2.0 * l01);
    [DVec2::ZERO, DVec2::new(l01, 0.0), DVec2::new(x, 2.0 * area / l01)]
}

#[cfg(test)]
mod tests {
    use super::super::scalar::{cos, sin};
    use super::*;

    #[test]
    fn the_layout_has_the_lengths() {
        let [p, q, r] = lay_out([3.0, 2.5, 1.2]);
        assert!((p.distance(q) - 3.0).abs() < 1e-14);
        assert!((q.distance(r) - 2.5).abs() < 1e-14);
        assert!((r.distance(p) - 1.2).abs() < 1e-14);
        assert!(signed_double_area(p, q, r) > 0.0);
    }

    #[test]
    fn the_jacobian_takes_sides_to_sides() {
        let from = [DVec2::new(0.3, 0.1), DVec2::new(1.2, -0.2), DVec2::new(0.5, 0.9)];
        let onto = [DVec2::new(-1.0, 0.4), DVec2::new(0.7, 1.1), DVec2::new(-0.3, 2.0)];
        let j = jacobian(&onto, &hat_gradients(from));
        for k in 1..3 {
            assert!((j * (from[k] - from[0])).distance(onto[k] - onto[0]) < 1e-14);
        }
    }

    #[test]
    fn the_cotangent_is_that_of_the_angle() {
        let (u, v) = (DVec3::new(1.0, 0.3, -0.2), DVec3::new(-0.4, 1.1, 0.7));
        let angle = angle_between(u, v);
        assert!((cotangent_between(u, v) - cos(angle) / sin(angle)).abs() < 1e-14);
        assert!((angle_at(DVec3::X, DVec3::X + u, DVec3::X + v) - angle).abs() < 1e-14);
        assert!((cotangent_between(DVec3::X, DVec3::X + DVec3::Y) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn angles_of_a_needle_sum_to_pi() {
        let (a, b, c) = (1.0, 1.0, 1e-9);
        let sum =
            angle_from_lengths(a, [b, c]) + angle_from_lengths(b, [a, c]) + angle_from_lengths(c, [a, b]);
        assert!((sum - std::f64::consts::PI).abs() < 1e-12);
    }
}

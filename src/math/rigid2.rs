//! Orientation-preserving rigid motions of the plane.

use glam::{DMat2, DVec2};

/// The rigid motion p -> r p + t, where r is a rotation written as a unit complex number (cos, sin).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid2 {
    /// (cos, sin) of the rotation angle.
    pub rotation: DVec2,
    /// Translation, applied after the rotation.
    pub translation: DVec2,
}

impl Rigid2 {
    /// The motion that moves nothing.
    pub const IDENTITY: Self = Self { rotation: DVec2::X, translation: DVec2::ZERO };

    /// The motion that takes segment `from` to segment `onto` (equal lengths): starts match exactly, directions match.
    pub fn between_segments(from: [DVec2; 2], onto: [DVec2; 2]) -> Self {
        let rotation = conj_mul(from[1] - from[0], onto[1] - onto[0]).normalize_or(DVec2::X);
        Self { rotation, translation: onto[0] - complex_mul(rotation, from[0]) }
    }

    /// The image of a point.
    pub fn apply(&self, p: DVec2) -> DVec2 {
        complex_mul(self.rotation, p) + self.translation
    }

    /// The image of a direction.
    pub fn rotate(&self, d: DVec2) -> DVec2 {
        complex_mul(self.rotation, d)
    }

    /// The rotation as a matrix.
    #[inline]
    pub fn turn(&self) -> DMat2 {
        turn(self.rotation)
    }

    /// `self` after `first`.
    pub fn after(&self, first: &Self) -> Self {
        Self {
            rotation: complex_mul(self.rotation, first.rotation),
            translation: self.apply(first.translation),
        }
    }

    /// The motion back.
    pub fn inverse(&self) -> Self {
        let rotation = DVec2::new(self.rotation.x, -self.rotation.y);
        Self { rotation, translation: -complex_mul(rotation, self.translation) }
    }
}

/// The matrix of a rotation.
#[inline]
pub fn turn(rotation: DVec2) -> DMat2 {
    DMat2::from_cols(rotation, rotation.perp())
}

/// The complex product a b.
pub fn complex_mul(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// The complex product conj(a) b.
pub fn conj_mul(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_after_its_inverse_is_the_identity() {
        let m = Rigid2::between_segments(
            [DVec2::new(1.0, 2.0), DVec2::new(4.0, 6.0)],
            [DVec2::new(-3.0, 0.5), DVec2::new(-3.0, 5.5)],
        );
        let p = DVec2::new(0.3, -0.7);
        assert!((m.after(&m.inverse()).apply(p) - p).length() < 1e-14);
        assert!((m.apply(DVec2::new(4.0, 6.0)) - DVec2::new(-3.0, 5.5)).length() < 1e-14);
    }
}

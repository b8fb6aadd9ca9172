//! Rigid motions of space, small turns and the rotation nearest to a matrix.

use glam::{DMat3, DQuat, DVec3};
use nalgebra::{Matrix3, Vector3};

/// The rigid motion p -> R p + t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid3 {
    /// R.
    pub rotation: DMat3,
    /// t, applied after the rotation.
    pub translation: DVec3,
}

impl Rigid3 {
    /// The motion with this rotation that takes `from` to `onto`.
    pub fn with_point(rotation: DMat3, from: DVec3, onto: DVec3) -> Self {
        Self { rotation, translation: onto - rotation * from }
    }

    /// The image of a point.
    #[inline]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.translation
    }
}

/// The turn about the axis `turn` whose angle a has 2 tan(a / 2) = |turn|: `turn` itself to second order (Cayley's map).
pub fn small_turn(turn: DVec3) -> DMat3 {
    let half = 0.5 * turn;
    DMat3::from_quat(DQuat::from_xyzw(half.x, half.y, half.z, 1.0).normalize())
}

/// The matrix u v^T.
#[inline]
pub fn outer(u: DVec3, v: DVec3) -> DMat3 {
    DMat3::from_cols(u * v.x, u * v.y, u * v.z)
}

/// The rotation R with the largest trace of R^T m, by singular values (Kabsch 1976); `None` where m is not finite.
pub fn nearest_rotation(m: &DMat3) -> Option<DMat3> {
    let svd = Matrix3::from(*m).try_svd(true, true, f64::EPSILON, SWEEPS)?;
    let (u, v_transposed) = (svd.u?, svd.v_t?);
    // Where their product is a reflection, the direction of the least singular value, the last one, is turned round.
    let sign = (u * v_transposed).determinant().signum();
    let rotation = DMat3::from(u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v_transposed);
    rotation.is_finite().then_some(rotation)
}

/// Iterations of a singular value decomposition, at most: few are needed.
const SWEEPS: usize = 100;

#[cfg(test)]
mod tests {
    use super::*;

    fn turn() -> DMat3 {
        small_turn(DVec3::new(0.4, -0.7, 1.1))
    }

    #[test]
    fn a_small_turn_is_a_rotation_and_its_vector_to_second_order() {
        let r = turn();
        assert!((r.determinant() - 1.0).abs() < 1e-14);
        assert!((r * r.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-14));
        let (w, p) = (DVec3::new(1.0, 2.0, -1.0) * 1e-4, DVec3::new(0.3, -0.2, 0.9));
        let exact = p + w.cross(p) + 0.5 * w.cross(w.cross(p));
        assert!((small_turn(w) * p).distance(exact) < 1e-11);
    }

    #[test]
    fn the_rotation_of_a_stretched_turn_is_found() {
        let stretch =
            DMat3::from_cols(DVec3::new(1.5, 0.1, 0.0), DVec3::new(0.1, 1.0, 0.2), DVec3::new(0.0, 0.2, 0.7));
        let found = nearest_rotation(&(turn() * stretch)).unwrap();
        assert!(found.abs_diff_eq(turn(), 1e-14), "{found}");
        assert_eq!(nearest_rotation(&(stretch * f64::NAN)), None);
    }

    #[test]
    fn flat_and_reflected_matrices_have_a_rotation_too() {
        for third in [1e-3, 1e-9, 0.0, -1e-9, -0.1] {
            let stretch = DMat3::from_diagonal(DVec3::new(2.0, 0.5, third));
            let found = nearest_rotation(&(turn() * stretch)).unwrap();
            assert!(found.abs_diff_eq(turn(), 1e-7), "{third} {found}");
        }
    }

    #[test]
    fn a_motion_with_a_point_takes_it_there() {
        let (from, onto) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 0.0));
        assert!(Rigid3::with_point(turn(), from, onto).apply(from).distance(onto) < 1e-14);
    }
}

//! Rigid motions of space, small turns and the rotation nearest to a matrix.

use glam::{DMat3, DQuat, DVec3};

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

/// The rotation R with the largest trace of R^T m, from a rotation not far from it (Müller, Bender, Chentanez and Macklin,
/// "A robust method to extract the rotational part of deformations", 2016, equation 7).
pub fn nearest_rotation(m: &DMat3, start: DMat3) -> DMat3 {
    let mut rotation = start;
    for _ in 0..30 {
        let pairs = [0, 1, 2].map(|k| (rotation.col(k), m.col(k)));
        let torque: DVec3 = pairs.iter().map(|(r, c)| r.cross(*c)).sum();
        let size = pairs.iter().map(|(r, c)| r.dot(*c)).sum::<f64>().abs();
        let turn = torque / size.max(f64::MIN_POSITIVE);
        if !turn.is_finite() {
            break;
        }
        rotation = small_turn(turn) * rotation;
        if turn.length_squared() < 1e-14 {
            break;
        }
    }
    rotation
}

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
    fn the_rotation_of_a_stretched_turn_is_found_from_afar() {
        let stretch =
            DMat3::from_cols(DVec3::new(1.5, 0.1, 0.0), DVec3::new(0.1, 1.0, 0.2), DVec3::new(0.0, 0.2, 0.7));
        let found = nearest_rotation(&(turn() * stretch), DMat3::IDENTITY);
        assert!(found.abs_diff_eq(turn(), 1e-6), "{found}");
    }

    #[test]
    fn a_motion_with_a_point_takes_it_there() {
        let (from, onto) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 0.0));
        assert!(Rigid3::with_point(turn(), from, onto).apply(from).distance(onto) < 1e-14);
    }
}

//! Rigid motions of space, turns, and the rotation nearest to a matrix.

use super::scalar::{atan2, cos, sin};
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

/// The turn about the axis `turn` by the angle |turn|, in radians.
pub fn turned_by(turn: DVec3) -> DMat3 {
    let angle = turn.length();
    if angle == 0.0 {
        return DMat3::IDENTITY;
    }
    let along = turn * (sin(0.5 * angle) / angle);
    DMat3::from_quat(DQuat::from_xyzw(along.x, along.y, along.z, cos(0.5 * angle)))
}

/// The turn of a rotation by at most half a turn: its axis, as long as its angle in radians. [`turned_by`] gives the rotation back.
pub fn turn_of(rotation: &DMat3) -> DVec3 {
    let q = DQuat::from_mat3(rotation);
    let q = if q.w < 0.0 { -q } else { q };
    let along = DVec3::new(q.x, q.y, q.z);
    let length = along.length();
    if length == 0.0 { DVec3::ZERO } else { along * (2.0 * atan2(length, q.w) / length) }
}

/// The rotation R of the polar decomposition m = R S, with S symmetric and positive definite; `None` where m mirrors, or has lost a
/// dimension as far as f64 can tell. Newton's method with scaling (Higham, "Computing the polar decomposition - with
/// applications", 1986), which doubles the right digits with each step.
pub fn polar_rotation(m: &DMat3) -> Option<DMat3> {
    // Far more than doubling digits needs: what has not ended then never does.
    const STEPS: usize = 40;
    // A volume below this, beside the cube of the norm, may be rounding.
    const FLATTEST: f64 = 1e-12;
    let norm = |m: &DMat3| [0, 1, 2].map(|k| m.col(k).length_squared()).iter().sum::<f64>().sqrt();
    let size = norm(m);
    let volume = m.determinant();
    if !(volume.is_finite() && volume > FLATTEST * size * size * size) {
        return None;
    }
    let mut rotation = *m;
    for _ in 0..STEPS {
        let inverse = rotation.inverse().transpose();
        let scale = (norm(&inverse) / norm(&rotation)).sqrt();
        let next = (rotation * scale + inverse * (1.0 / scale)) * 0.5;
        let moved = norm(&(next - rotation));
        rotation = next;
        // After a step this small the next one is below rounding.
        if moved < 1e-9 {
            return Some((rotation + rotation.inverse().transpose()) * 0.5);
        }
    }
    None
}

/// The rigid motion that brings points nearest to their partners in the sense of least squares (Kabsch 1976).
pub fn laid_on(points: &[DVec3], partners: &[DVec3]) -> Rigid3 {
    let mean = |all: &[DVec3]| all.iter().sum::<DVec3>() / all.len().max(1) as f64;
    let (from, onto) = (mean(points), mean(partners));
    let pairs = points.iter().zip(partners);
    let spread: DMat3 = pairs.map(|(p, q)| outer(*q - onto, *p - from)).fold(DMat3::ZERO, |sum, m| sum + m);
    // From any start the search ends at the best rotation, but for starts a half turn away from it.
    let starts =
        [DVec3::ONE, DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::new(-1.0, -1.0, 1.0)];
    Rigid3::with_point(best_rotation(&spread, starts.map(DMat3::from_diagonal)), from, onto)
}

/// The rotation that agrees best with the matrix among those that [`nearest_rotation`] finds from some starts; the identity where there is no
/// start.
pub fn best_rotation(m: &DMat3, starts: impl IntoIterator<Item = DMat3>) -> DMat3 {
    let found = starts.into_iter().map(|start| nearest_rotation(m, start));
    found.max_by(|a, b| agreement(a, m).total_cmp(&agreement(b, m))).unwrap_or(DMat3::IDENTITY)
}

/// The trace of R^T m: the larger, the nearer the rotation R is to the matrix in the sense of least squares.
pub fn agreement(rotation: &DMat3, m: &DMat3) -> f64 {
    (0..3).map(|k| rotation.col(k).dot(m.col(k))).sum()
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
    fn the_best_of_several_rotations_agrees_most() {
        let half = DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0));
        let found = best_rotation(&turn(), [turn() * half, DMat3::IDENTITY]);
        assert!(found.abs_diff_eq(turn(), 1e-6), "{found}");
        assert!((agreement(&turn(), &turn()) - 3.0).abs() < 1e-14);
        assert!(agreement(&(turn() * half), &turn()) < 0.0);
        assert_eq!(best_rotation(&turn(), []), DMat3::IDENTITY);
    }

    #[test]
    fn turns_are_told_by_their_vectors() {
        for vector in [DVec3::ZERO, DVec3::new(1e-9, 0.0, 0.0), DVec3::new(0.4, -0.7, 1.1), DVec3::Y * 3.1] {
            let rotation = turned_by(vector);
            assert!((rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-14));
            assert!(turn_of(&rotation).distance(vector) < 1e-9, "{vector}");
        }
        let axis = DVec3::new(2.0, 1.0, -2.0) / 3.0;
        let (p, along) = (DVec3::new(0.3, 2.0, -1.0), axis * axis.dot(DVec3::new(0.3, 2.0, -1.0)));
        // Rodrigues' formula.
        let expected = along + (p - along) * cos(2.0) + axis.cross(p) * sin(2.0);
        assert!((turned_by(axis * 2.0) * p).distance(expected) < 1e-14);
    }

    #[test]
    fn the_polar_rotation_leaves_a_symmetric_stretch() {
        let stretch =
            DMat3::from_cols(DVec3::new(1.5, 0.1, 0.0), DVec3::new(0.1, 1.0, 0.2), DVec3::new(0.0, 0.2, 0.7));
        for size in [1e-6, 1.0, 1e7] {
            let found = polar_rotation(&(turn() * stretch * size)).unwrap();
            assert!(found.abs_diff_eq(turn(), 1e-13), "{found}");
        }
        let thin = DMat3::from_diagonal(DVec3::new(1.0, 1e-5, 30.0));
        assert!(polar_rotation(&(turn() * thin)).unwrap().abs_diff_eq(turn(), 1e-9));
        for lost in [DMat3::ZERO, DMat3::from_diagonal(DVec3::new(1.0, 1.0, 0.0)), DMat3::IDENTITY * -1.0] {
            assert!(polar_rotation(&lost).is_none(), "{lost}");
        }
    }

    #[test]
    fn a_motion_with_a_point_takes_it_there() {
        let (from, onto) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 0.0));
        assert!(Rigid3::with_point(turn(), from, onto).apply(from).distance(onto) < 1e-14);
    }
}

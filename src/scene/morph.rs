//! The way of the source's shape to the target's: every point goes straight to its image, after the target was laid on the source.

use crate::math::rigid3::{Rigid3, nearest_rotation, outer};
use glam::{DMat3, DVec3, Mat4, Vec3};

/// The rigid motion that brings points nearest to their partners in the sense of least squares (Kabsch 1976).
pub fn laid_on(points: &[Vec3], partners: &[Vec3]) -> Mat4 {
    let mean = |all: &[Vec3]| all.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / all.len().max(1) as f64;
    let (from, onto) = (mean(points), mean(partners));
    let pairs = points.iter().zip(partners);
    let spread: DMat3 = pairs
        .map(|(p, q)| outer(q.as_dvec3() - onto, p.as_dvec3() - from))
        .fold(DMat3::ZERO, |sum, m| sum + m);
    // From any start the search ends at the best rotation, but for starts a half turn away from it.
    let starts =
        [DVec3::ONE, DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::new(-1.0, -1.0, 1.0)];
    let rotations = starts.map(|diagonal| nearest_rotation(&spread, DMat3::from_diagonal(diagonal)));
    let agreement = |r: &DMat3| (0..3).map(|k| r.col(k).dot(spread.col(k))).sum::<f64>();
    let best = rotations.into_iter().max_by(|a, b| agreement(a).total_cmp(&agreement(b)));
    let motion = Rigid3::with_point(best.unwrap_or(DMat3::IDENTITY), from, onto);
    let columns = [0, 1, 2].map(|k| motion.rotation.col(k).as_vec3().extend(0.0));
    Mat4::from_cols(columns[0], columns[1], columns[2], motion.translation.as_vec3().extend(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use glam::Quat;

    #[test]
    fn a_moved_shape_is_found_again_however_it_was_turned() {
        let ball = icosphere(2);
        let shape: Vec<Vec3> = ball
            .positions()
            .iter()
            .map(|p| p.as_vec3() * Vec3::new(1.0, 0.6, 0.3) + 0.1 * p.as_vec3().x.abs())
            .collect();
        for k in 0..12 {
            let angle = 0.55 * k as f32;
            let turn = Quat::from_axis_angle(Vec3::new(1.0, k as f32 - 5.0, 0.3).normalize(), angle);
            let shift = Vec3::new(0.2, -0.4, 1.0);
            let moved: Vec<Vec3> = shape.iter().map(|p| turn * *p + shift).collect();
            let motion = laid_on(&shape, &moved);
            for (p, q) in shape.iter().zip(&moved) {
                assert!(motion.transform_point3(*p).distance(*q) < 1e-4, "{k}");
            }
        }
    }
}

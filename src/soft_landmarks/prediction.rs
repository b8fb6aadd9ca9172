//! The prediction of a point's image from the images of the points around it.

use crate::math::rigid3::{laid_on, outer};
use glam::{DMat3, DVec3};

/// Weight of the best similarity in the affine fit, as a share of the points' variance: it decides along the normal, where points of a
/// smooth surface hardly vary, and counts little within the surface. Chosen by hand.
const SIMILAR: f64 = 0.02;

/// Points around, at least: an affine map of space has four times three unknowns.
const LEAST_POINTS: usize = 4;

/// The image of a point under the affine map that fits the points around it to their images by least squares; along directions in
/// which they do not vary, the map is that of the best similarity. `None` for fewer than four points, or where all coincide.
pub(super) fn predicted(point: DVec3, around: &[DVec3], images: &[DVec3]) -> Option<DVec3> {
    if around.len() < LEAST_POINTS {
        return None;
    }
    let mean = |all: &[DVec3]| all.iter().sum::<DVec3>() / all.len() as f64;
    let (from, onto) = (mean(around), mean(images));
    let rotation = laid_on(around, images).rotation;
    let pairs = || around.iter().zip(images).map(|(p, q)| (*p - from, *q - onto));
    let spread: f64 = pairs().map(|(p, _)| p.length_squared()).sum();
    let scale = pairs().map(|(p, q)| q.dot(rotation * p)).sum::<f64>() / spread;
    let weight = SIMILAR * spread;
    let sum = |of: fn(DVec3, DVec3) -> DMat3| pairs().map(|(p, q)| of(p, q)).fold(DMat3::ZERO, |a, b| a + b);
    let own = sum(|p, _| outer(p, p)) + DMat3::from_diagonal(DVec3::splat(weight));
    let mixed = sum(|p, q| outer(q, p)) + rotation * (scale * weight);
    let image = onto + mixed * own.inverse() * (point - from);
    image.is_finite().then_some(image)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;
    use crate::math::rigid3::small_turn;

    fn points(count: usize) -> Vec<DVec3> {
        let mut random = SplitMix::new(7);
        let mut next = || random.unit() - 0.5;
        (0..count).map(|_| DVec3::new(next(), next(), next())).collect()
    }

    #[test]
    fn similarities_are_continued_exactly() {
        let turn = small_turn(DVec3::new(0.3, -1.0, 0.5)) * 1.7;
        let map = |p: DVec3| turn * p + DVec3::new(3.0, 1.0, -2.0);
        let around = points(12);
        let images: Vec<DVec3> = around.iter().map(|&p| map(p)).collect();
        for p in points(40) {
            assert!(predicted(p, &around, &images).unwrap().distance(map(p)) < 1e-6);
        }
    }

    #[test]
    fn in_a_plane_affine_maps_are_continued_nearly() {
        let flat = |p: DVec3| DVec3::new(p.x, p.y, 0.0);
        let map = |p: DVec3| DVec3::new(1.3 * p.x + 0.2 * p.y, 0.8 * p.y, 0.0);
        let around: Vec<DVec3> = points(16).into_iter().map(flat).collect();
        let images: Vec<DVec3> = around.iter().map(|&p| map(p)).collect();
        let inside = flat(points(3)[2]) * 0.5;
        assert!(predicted(inside, &around, &images).unwrap().distance(map(inside)) < 0.02);
    }

    #[test]
    fn of_too_few_points_or_of_one_alone_nothing_is_told() {
        assert_eq!(predicted(DVec3::X, &points(3), &points(3)), None);
        assert_eq!(predicted(DVec3::X, &[DVec3::Y; 8], &points(8)), None);
    }
}

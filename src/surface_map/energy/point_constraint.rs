//! Soft point constraints: an energy that draws a vertex to a place on the other surface.
//!
//! The energy of a vertex whose image is the point f is 2 K (sqrt(1 + Q / K) - 1) with Q = |B (f - a)|^2, where a is where it
//! should be and B, two rows in the tangent plane there, says how sure that is in each direction. Beyond the knee K it counts
//! like the distance, not like its square, so that one mistaken place does no harm.

use super::vertex_energy::{VertexEnergy, VertexTerm};
use crate::math::matrix2::outer;
use glam::{DMat2, DVec2, DVec3};

/// The place where a vertex should be on the other surface, and how certain it is in each direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointConstraint {
    /// The place a, in space; the other surface has area 1.
    pub place: DVec3,
    /// The rows of B: square root of an energy per unit of length.
    pub rows: [DVec3; 2],
    /// The knee K, an energy.
    pub knee: f64,
}

impl VertexEnergy for PointConstraint {
    /// The Hessian leaves out the part with the second derivative of the root, which is never positive.
    fn term(&self, corners: [DVec3; 3], barycentric: [f64; 3], hats: [DVec2; 3]) -> VertexTerm {
        let at = (0..3).map(|k| corners[k] * barycentric[k]).sum::<DVec3>() - self.place;
        let misses = self.rows.map(|row| row.dot(at));
        let square = misses[0] * misses[0] + misses[1] * misses[1];
        let root = (1.0 + square / self.knee).sqrt();
        let (mut gradient, mut hessian) = (DVec2::ZERO, DMat2::ZERO);
        for (row, miss) in self.rows.iter().zip(misses) {
            let slope: DVec2 = (0..3).map(|k| hats[k] * row.dot(corners[k])).sum();
            gradient += slope * (2.0 * miss / root);
            hessian += outer(slope) * (2.0 / root);
        }
        VertexTerm { energy: 2.0 * square / (1.0 + root), gradient, hessian }
    }
}

#[cfg(test)]
mod tests {
    use super::super::vertex_energy::testing::assert_derivatives;
    use super::*;

    const CORNERS: [DVec3; 3] =
        [DVec3::new(0.0, 0.1, 0.0), DVec3::new(1.1, 0.0, 0.2), DVec3::new(0.1, 0.9, -0.1)];
    const HATS: [DVec2; 3] = [DVec2::new(-1.0, -1.0), DVec2::X, DVec2::Y];

    fn constraint(knee: f64) -> PointConstraint {
        let rows = [DVec3::new(1.0, 0.2, 0.1), DVec3::new(-0.3, 0.6, 0.0)];
        PointConstraint { place: DVec3::new(0.7, 0.4, 0.3), rows, knee }
    }

    fn at(knee: f64, [x, y]: [f64; 2]) -> VertexTerm {
        constraint(knee).term(CORNERS, [1.0 - x - y, x, y], HATS)
    }

    #[test]
    fn the_derivatives_are_difference_quotients() {
        for knee in [1e-3, 0.01, 0.1, 1e6, 1e12] {
            assert_derivatives(&constraint(knee), CORNERS, HATS, knee > 1.0);
        }
    }

    #[test]
    fn far_beyond_the_knee_the_energy_grows_like_the_distance() {
        let far = |x: f64| at(1e-9, [x, 0.0]).energy;
        let steps = [far(100.0) - far(90.0), far(110.0) - far(100.0)];
        assert!((steps[0] / steps[1] - 1.0).abs() < 1e-2, "{steps:?}");
    }
}

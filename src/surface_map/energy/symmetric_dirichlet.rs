//! The symmetric Dirichlet energy of one flat triangle, with gradient and projected Hessian in closed form.
//!
//! e(J) = (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 = |J|^2 (1 + 1 / det J^2) / 4 per unit of rest area: 1 for an isometry,
//! infinite where the triangle degenerates (Schreiner et al. 2004; Smith & Schaefer 2015). The eigenvectors of its
//! Hessian are known from the singular vectors of J, so the projection to positive semidefinite costs nothing
//! (Shtengel et al. 2017; Smith, de Goes & Kim 2019).

use super::density::{Density, HessianTerm, Signed};
use crate::math::matrix2::{cofactor, squares};
use crate::math::scalar::max;
use glam::DMat2;

/// e(J): 1 for an isometry, infinite where det J is not positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SymmetricDirichlet;

impl SymmetricDirichlet {
    /// e(J) of a Jacobian with |J|^2 = `squares` and a positive determinant.
    #[inline]
    pub fn of(squares: f64, det: f64) -> f64 {
        0.25 * squares * (1.0 + 1.0 / (det * det))
    }
}

impl Density for SymmetricDirichlet {
    #[inline]
    fn density(&self, j: &DMat2) -> f64 {
        let det = j.determinant();
        if det > 0.0 { Self::of(squares(j), det) } else { f64::INFINITY }
    }

    /// (J (1 + 1/det^2) / 2) - |J|^2 cof(J) / (2 det^3).
    #[inline]
    fn gradient(&self, j: &DMat2) -> DMat2 {
        let det = j.determinant();
        *j * (0.5 * (1.0 + 1.0 / (det * det))) - cofactor(j) * (0.5 * squares(j) / (det * det * det))
    }

    /// The Hessian projected to positive semidefinite, as four rank-one terms.
    #[inline]
    fn hessian(&self, j: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
        let svd = Signed::of(j);
        let [s1, s2] = svd.s;
        let q = s1 * s2;
        let cube = q * q * q;
        let stretch = |s: f64| 0.5 + 1.5 / (s * s * s * s);
        let shear = 0.5 * (1.0 + (s1 * s1 + q + s2 * s2) / cube);
        let spin = max(0.5 * (1.0 - (s1 * s1 - q + s2 * s2) / cube), 0.0);
        [
            svd.stretch(stretch(s1), [1.0, 0.0]),
            svd.stretch(stretch(s2), [0.0, 1.0]),
            svd.twist(shear, 1.0),
            svd.twist(spin, -1.0),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::density::testing::assert_derivatives;
    use super::*;

    #[test]
    fn an_isometry_has_density_one_and_no_gradient() {
        let j = DMat2::from_angle(0.7);
        assert!((SymmetricDirichlet.density(&j) - 1.0).abs() < 1e-14);
        assert!(SymmetricDirichlet.gradient(&j).abs_diff_eq(DMat2::ZERO, 1e-14));
        assert_eq!(
            SymmetricDirichlet.density(&DMat2::from_diagonal(glam::DVec2::new(1.0, -1.0))),
            f64::INFINITY
        );
    }

    #[test]
    fn the_derivatives_are_difference_quotients() {
        // Both singular values at least 1: all four eigenvalues are positive.
        let exact = [[2.0, 0.3, -0.4, 1.9], [1.2, 0.9, -1.0, 1.6], [3.0, 0.0, 0.0, 1.3]];
        assert_derivatives(&SymmetricDirichlet, &exact.map(|c| DMat2::from_cols_array(&c)));
    }
}

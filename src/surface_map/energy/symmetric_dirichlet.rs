//! The symmetric Dirichlet energy of one flat triangle, with gradient and projected Hessian in closed form.
//!
//! e(J) = (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 = |J|^2 (1 + 1 / det J^2) / 4 per unit of rest area: 1 for an isometry,
//! infinite where the triangle degenerates (Schreiner et al. 2004; Smith & Schaefer 2015). The eigenvectors of its
//! Hessian are known from the singular vectors of J, so the projection to positive semidefinite costs nothing
//! (Shtengel et al. 2017; Smith, de Goes & Kim 2019).

use crate::math::matrix2::{cofactor, squares};
use crate::math::scalar::max;
use glam::{DMat2, DVec2};

/// e(J); `None` where det J is not positive.
#[inline]
pub fn density(j: &DMat2) -> Option<f64> {
    let det = j.determinant();
    (det > 0.0).then(|| 0.25 * squares(j) * (1.0 + 1.0 / (det * det)))
}

/// de/dJ = (J (1 + 1/det^2) / 2) - |J|^2 cof(J) / (2 det^3), as a matrix of the shape of J.
#[inline]
pub fn gradient(j: &DMat2) -> DMat2 {
    let det = j.determinant();
    *j * (0.5 * (1.0 + 1.0 / (det * det))) - cofactor(j) * (0.5 * squares(j) / (det * det * det))
}

/// One term `weight M (x) M` of the projected Hessian.
#[derive(Clone, Copy, Debug)]
pub struct HessianTerm {
    /// Eigenvalue, not negative.
    pub weight: f64,
    matrix: DMat2,
}

impl HessianTerm {
    /// M g.
    #[inline]
    pub fn apply(&self, g: DVec2) -> DVec2 {
        self.matrix * g
    }

    /// M.
    #[inline]
    pub fn matrix(&self) -> DMat2 {
        self.matrix
    }
}

/// The singular value decomposition J = s1 u1 v1^T + s2 u2 v2^T, both bases right-handed; det J must be positive.
///
/// As complex numbers u1 and v1 occur only in the products a = u1 conj(v1) and b = u1 v1, and with J(z) = alpha z +
/// beta conj(z) these are the directions of alpha and beta: no angle has to be halved.
pub(super) struct Signed {
    a: DVec2,
    b: DVec2,
    /// The singular values, the larger one first.
    pub(super) s: [f64; 2],
}

impl Signed {
    #[inline]
    pub(super) fn of(j: &DMat2) -> Self {
        let (k1, k2) = (j.x_axis, j.y_axis);
        let alpha = 0.5 * DVec2::new(k1.x + k2.y, k1.y - k2.x);
        let beta = 0.5 * DVec2::new(k1.x - k2.y, k1.y + k2.x);
        let s1 = alpha.length() + beta.length();
        // Similarities have no b: any will do.
        let [a, b] = [alpha, beta].map(|z| z.normalize_or(DVec2::X));
        Self { a, b, s: [s1, j.determinant() / s1] }
    }

    /// `weight` on the matrix x u1 v1^T + y u2 v2^T.
    #[inline]
    pub(super) fn stretch(&self, weight: f64, [x, y]: [f64; 2]) -> HessianTerm {
        let (p, q) = (self.a * (0.5 * (x + y)), self.b * (0.5 * (x - y)));
        HessianTerm { weight, matrix: DMat2::from_cols(p + q, (p - q).perp()) }
    }

    /// `weight` on (u1 v2^T + sign u2 v1^T) / sqrt 2.
    #[inline]
    pub(super) fn twist(&self, weight: f64, sign: f64) -> HessianTerm {
        let half = 0.5 * std::f64::consts::FRAC_1_SQRT_2;
        let (p, q) = (self.a.perp() * (half * (sign - 1.0)), self.b.perp() * (half * (sign + 1.0)));
        HessianTerm { weight, matrix: DMat2::from_cols(p + q, (p - q).perp()) }
    }
}

/// The Hessian of e at J, projected to positive semidefinite, as four rank-one terms; det J must be positive.
pub fn hessian(j: &DMat2) -> [HessianTerm; 4] {
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

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub fn samples() -> Vec<DMat2> {
        [
            [1.0, 0.2, -0.3, 0.8],
            [0.3, 0.0, 1.0, 2.0],
            [-1.0, 0.5, -0.2, -0.9],
            [2.0, 1.0, 1.0, 0.9],
            [1.1, 0.0, 0.0, 1.1],
        ]
        .iter()
        .map(DMat2::from_cols_array)
        .collect()
    }

    pub fn unit(k: usize) -> DMat2 {
        let mut e = [0.0; 4];
        e[k] = 1.0;
        DMat2::from_cols_array(&e)
    }

    #[test]
    fn an_isometry_has_density_one_and_no_gradient() {
        let j = DMat2::from_angle(0.7);
        assert!((density(&j).unwrap() - 1.0).abs() < 1e-14);
        assert!(gradient(&j).abs_diff_eq(DMat2::ZERO, 1e-14));
    }

    #[test]
    fn the_gradient_is_the_difference_quotient() {
        for j in samples() {
            for k in 0..4 {
                let h = 1e-6;
                let quotient =
                    (density(&(j + unit(k) * h)).unwrap() - density(&(j - unit(k) * h)).unwrap()) / (2.0 * h);
                let exact = gradient(&j).to_cols_array()[k];
                assert!((quotient - exact).abs() < 1e-6 * exact.abs().max(1.0), "{quotient} {exact}");
            }
        }
    }

    /// sum weight M (x) M as a 4 x 4 matrix on column-major J.
    pub fn assembled(terms: &[HessianTerm]) -> [[f64; 4]; 4] {
        let mut full = [[0.0; 4]; 4];
        for term in terms {
            let m = DMat2::from_cols(term.apply(DVec2::X), term.apply(DVec2::Y)).to_cols_array();
            for r in 0..4 {
                for c in 0..4 {
                    full[r][c] += term.weight * m[r] * m[c];
                }
            }
        }
        full
    }

    #[test]
    fn where_nothing_is_projected_the_hessian_is_the_difference_quotient() {
        // Both singular values at least 1: all four eigenvalues are positive.
        for j in [[2.0, 0.3, -0.4, 1.9], [1.2, 0.9, -1.0, 1.6], [3.0, 0.0, 0.0, 1.3]]
            .map(|c| DMat2::from_cols_array(&c))
        {
            let exact = assembled(&hessian(&j));
            for k in 0..4 {
                let h = 1e-5;
                let plus = gradient(&(j + unit(k) * h)).to_cols_array();
                let minus = gradient(&(j - unit(k) * h)).to_cols_array();
                for r in 0..4 {
                    let quotient = (plus[r] - minus[r]) / (2.0 * h);
                    assert!((quotient - exact[r][k]).abs() < 1e-6, "{r} {k}: {quotient} {}", exact[r][k]);
                }
            }
        }
    }

    /// Checks that x^T (`projected` - true) x >= 0 on many directions, also where the true Hessian is indefinite.
    pub fn assert_dominates(j: DMat2, projected: &[HessianTerm], gradient: impl Fn(&DMat2) -> DMat2) {
        let projected = assembled(projected);
        for k in 0..50_u32 {
            let d: Vec<f64> = (0..4_u32).map(|i| f64::from((k * 37 + i * 101) % 23) - 11.0).collect();
            let direction = DMat2::from_cols_array(&[d[0], d[1], d[2], d[3]]) * 1e-5;
            let second = (gradient(&(j + direction)) - gradient(&(j - direction))) * 0.5;
            let dot = |a: DMat2, b: DMat2| a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis);
            let truth = dot(second, direction) * 1e10;
            let model: f64 = (0..4).map(|r| (0..4).map(|c| d[r] * projected[r][c] * d[c]).sum::<f64>()).sum();
            assert!(model >= truth - 1e-3 * truth.abs().max(1.0), "{model} < {truth}");
        }
    }

    #[test]
    fn the_projected_hessian_dominates_the_true_one() {
        for j in samples() {
            assert_dominates(j, &hessian(&j), gradient);
        }
    }
}

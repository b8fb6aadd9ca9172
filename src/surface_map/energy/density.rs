//! Energy densities of maps as functions of the Jacobian. A further energy is a further file that implements [`Density`], tested by
//! `testing`.

use glam::{DMat2, DVec2};

/// An energy per unit of area of a map with the Jacobian J, where det J is positive.
pub trait Density {
    /// The density. It may be infinite where det J is not positive.
    fn density(&self, j: &DMat2) -> f64;

    /// The derivative of the density by J, as a matrix of the shape of J.
    fn gradient(&self, j: &DMat2) -> DMat2;

    /// Rank-one terms whose sum is positive semidefinite and no less than the Hessian of the density at J: only negative parts are
    /// projected away or left out. Where an implementation leaves out another part it says which; Newton's step still descends.
    fn hessian(&self, j: &DMat2) -> impl IntoIterator<Item = HessianTerm>;
}

/// One term `weight M (x) M` of the projected Hessian.
#[derive(Clone, Copy, Debug)]
pub struct HessianTerm {
    /// Eigenvalue, not negative.
    pub weight: f64,
    matrix: DMat2,
}

impl HessianTerm {
    /// The term with its weight multiplied by `factor`, which is not negative.
    #[inline]
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { weight: factor * self.weight, ..self }
    }

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
        // beta is 0 for similarities: any direction will do for b.
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

#[cfg(test)]
pub(super) mod testing {
    //! The same difference quotients for every density.

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

    fn unit(k: usize) -> DMat2 {
        let mut e = [0.0; 4];
        e[k] = 1.0;
        DMat2::from_cols_array(&e)
    }

    /// sum weight M (x) M as a 4 x 4 matrix on column-major J.
    fn assembled(terms: impl IntoIterator<Item = HessianTerm>) -> [[f64; 4]; 4] {
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

    /// Asserts that gradient and Hessian belong to the density: the gradient is its difference quotient, and the Hessian is
    /// that of the gradient at `exact`, where nothing is projected or left out, and dominates it elsewhere.
    pub fn assert_derivatives(density: &impl Density, exact: &[DMat2]) {
        assert_derivatives_without(&Nothing, density, exact);
    }

    /// The same of a density whose Hessian is that of `density` without the part `left_out`.
    pub fn assert_derivatives_without(left_out: &impl Density, density: &impl Density, exact: &[DMat2]) {
        let told = Difference { density, left_out };
        for j in samples() {
            assert_gradient(density, &j);
            assert_dominates(&told, &j);
        }
        exact.iter().for_each(|j| assert_hessian(&told, j));
    }

    /// The density 0.
    struct Nothing;

    impl Density for Nothing {
        fn density(&self, _: &DMat2) -> f64 {
            0.0
        }

        fn gradient(&self, _: &DMat2) -> DMat2 {
            DMat2::ZERO
        }

        fn hessian(&self, _: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
            []
        }
    }

    /// A density minus a part of it; its Hessian is that of the whole density.
    struct Difference<'a, D, L> {
        density: &'a D,
        left_out: &'a L,
    }

    impl<D: Density, L: Density> Density for Difference<'_, D, L> {
        fn density(&self, j: &DMat2) -> f64 {
            self.density.density(j) - self.left_out.density(j)
        }

        fn gradient(&self, j: &DMat2) -> DMat2 {
            self.density.gradient(j) - self.left_out.gradient(j)
        }

        fn hessian(&self, j: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
            self.density.hessian(j)
        }
    }

    fn assert_gradient(density: &impl Density, j: &DMat2) {
        for k in 0..4 {
            let h = 1e-6;
            let at = |h: f64| density.density(&(*j + unit(k) * h));
            let quotient = (at(h) - at(-h)) / (2.0 * h);
            let exact = density.gradient(j).to_cols_array()[k];
            assert!((quotient - exact).abs() < 1e-5 * exact.abs().max(1.0), "{quotient} {exact}");
        }
    }

    fn assert_hessian(density: &impl Density, j: &DMat2) {
        let exact = assembled(density.hessian(j));
        for k in 0..4 {
            let h = 1e-5;
            let plus = density.gradient(&(*j + unit(k) * h)).to_cols_array();
            let minus = density.gradient(&(*j - unit(k) * h)).to_cols_array();
            for r in 0..4 {
                let quotient = (plus[r] - minus[r]) / (2.0 * h);
                assert!((quotient - exact[r][k]).abs() < 1e-5, "{r} {k}: {quotient} {}", exact[r][k]);
            }
        }
    }

    /// Asserts that x^T (projected - true) x >= 0 in many directions, also where the true Hessian is indefinite.
    fn assert_dominates(density: &impl Density, j: &DMat2) {
        let projected = assembled(density.hessian(j));
        for k in 0..50_u32 {
            let d: Vec<f64> = (0..4_u32).map(|i| f64::from((k * 37 + i * 101) % 23) - 11.0).collect();
            let direction = DMat2::from_cols_array(&[d[0], d[1], d[2], d[3]]) * 1e-5;
            let second = (density.gradient(&(*j + direction)) - density.gradient(&(*j - direction))) * 0.5;
            let dot = |a: DMat2, b: DMat2| a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis);
            let truth = dot(second, direction) * 1e10;
            let model: f64 = (0..4).map(|r| (0..4).map(|c| d[r] * projected[r][c] * d[c]).sum::<f64>()).sum();
            assert!(model >= truth - 1e-3 * truth.abs().max(1.0), "{model} < {truth}");
        }
    }
}

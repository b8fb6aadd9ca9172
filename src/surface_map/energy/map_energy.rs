//! The energy of a map between two surfaces, counted on both alike, with gradient and projected Hessian in closed form.
//!
//! With S = |J|^2 and q = det J > 0 the distortion at a point is
//!
//! x(J) = S / (2 q) (1 + b (q - 1 + 1/q)) / (1 + b),
//!
//! the same for J and its inverse, and 1 for an isometry only (b > 0). Its integral over both surfaces, times 2 (1 + b), is
//! the integral over the source of h(J) = S (1 + 1/q) + b S (q + 1/q^2). The first part is E = |J|^2 over the source and
//! |J^-1|^2 over the target, 4 for every conformal map between surfaces of area 1; it weighs a region by the area of its
//! image, so that a collapsing region costs little. The second, |J|^2 over the target and |J^-1|^2 over the source, weighs a
//! region by its own area, and penalises unequal areas.
//!
//! Between two poses of one body most of the skin moves rigidly and what stretches is found around few joints. There the
//! sum of squares is the wrong measure: it spreads the stretch over everything. So the distortion may be counted as
//!
//! rho(1 + y) = 1 + 2 k (sqrt(1 + y / k) - 1),
//!
//! which is 1 + y far below the knee k and grows like the stretch itself above it (pseudo-Huber; Charbonnier et al. 1997).

use super::density::{Density, HessianTerm, Signed};
use crate::math::matrix2::{SymmetricEigen, cofactor, squares, symmetric_eigen};
use crate::math::scalar::max;
use glam::DMat2;

/// An energy of maps with the density 2 (1 + b) (1 + q) rho(x) per unit of source area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapEnergy {
    /// The weight b of the second part, which asks for equal areas.
    pub balance: f64,
    /// The knee k: the distortion beyond 1 above which it counts like the stretch, not like its square.
    pub knee: f64,
}

impl MapEnergy {
    /// E alone.
    pub const PLAIN: Self = Self { balance: 0.0, knee: f64::INFINITY };
    /// E plus 0.02 times the second part, which keeps regions from collapsing: the mean distortion of nine SHREC07 pairs fell from
    /// between 11 and 22 to below 3, for 2 % of E.
    pub const SMOOTH: Self = Self { balance: 0.02, knee: f64::INFINITY };
    /// The energy by which maps of different isotopy classes are compared: that of a collapsed or stretched region grows slowly
    /// enough that no single limb decides. Weight and knee were chosen by hand.
    pub const JUDGE: Self = Self { balance: 0.2, knee: 0.1 };
    /// The energy for poses of one body, whose least maps are nearly isometric wherever possible. With both numbers the distance to the
    /// known map fell from 0.49 to 0.28 % of the root of the area (horse-horse05) and from 0.92 to 0.45 % (horse-horse01).
    pub const POSES: Self = Self { balance: 1.0, knee: 0.1 };

    /// h / S with its first and second derivative by q.
    #[inline]
    fn factor(&self, q: f64) -> [f64; 3] {
        let (r, b) = (1.0 / q, self.balance);
        let (r2, r3) = (r * r, r * r * r);
        [1.0 + r + b * (q + r2), -r2 + b * (1.0 - 2.0 * r3), 2.0 * r3 + 6.0 * b * r2 * r2]
    }

    /// A quarter of the energy of an isometry between surfaces of area 1: 1 + b.
    #[inline]
    pub fn unit(&self) -> f64 {
        1.0 + self.balance
    }

    /// 2 (1 + b).
    #[inline]
    fn scale(&self) -> f64 {
        2.0 * self.unit()
    }

    /// The energy of an isometry per unit of both areas.
    #[inline]
    pub(super) fn isometry(&self) -> f64 {
        self.scale()
    }

    /// rho and its derivative.
    #[inline]
    fn counted(&self, x: f64) -> [f64; 2] {
        let y = max(x - 1.0, 0.0);
        let root = (1.0 + y / self.knee).sqrt();
        [1.0 + 2.0 * y / (1.0 + root), 1.0 / root]
    }

    /// The distortion x.
    #[inline]
    pub fn distortion(&self, j: &DMat2) -> f64 {
        let q = j.determinant();
        squares(j) * self.factor(q)[0] / (self.scale() * (1.0 + q))
    }
}

impl Density for MapEnergy {
    /// The energy per unit of source area.
    #[inline]
    fn density(&self, j: &DMat2) -> f64 {
        let [rho, _] = self.counted(self.distortion(j));
        self.scale() * (1.0 + j.determinant()) * rho
    }

    /// The derivative of the density by J.
    #[inline]
    fn gradient(&self, j: &DMat2) -> DMat2 {
        let (squares, q) = (squares(j), j.determinant());
        let [f, slope, _] = self.factor(q);
        let x = squares * f / (self.scale() * (1.0 + q));
        let [rho, weight] = self.counted(x);
        let by_area = weight * squares * slope + self.scale() * (rho - weight * x);
        *j * (2.0 * weight * f) + cofactor(j) * by_area
    }

    /// The Hessian of the density at J as four rank-one terms, projected to positive semidefinite after the part with rho'',
    /// which is never positive, has been left out.
    fn hessian(&self, j: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
        let svd = Signed::of(j);
        let [s1, s2] = svd.s;
        let (q, squares) = (s1 * s2, s1 * s1 + s2 * s2);
        let [f, slope, bend] = self.factor(q);
        let x = squares * f / (self.scale() * (1.0 + q));
        let [rho, weight] = self.counted(x);
        let [f, slope, bend] = [f, slope, bend].map(|part| weight * part);
        let by_area = self.scale() * (rho - weight * x);
        let own = 2.0 * f + 4.0 * q * slope;
        let (h11, h22) = (own + squares * bend * s2 * s2, own + squares * bend * s1 * s1);
        let h12 = squares * (3.0 * slope + q * bend) + by_area;
        // The eigenvalues of the 2 x 2 block of stretches.
        let SymmetricEigen { values: [larger, smaller], first } = symmetric_eigen([h11, h12, h22]);
        let turning = squares * slope + by_area;
        [
            svd.stretch(max(larger, 0.0), [first.x, first.y]),
            svd.stretch(max(smaller, 0.0), [-first.y, first.x]),
            svd.twist(max(2.0 * f - turning, 0.0), 1.0),
            svd.twist(max(2.0 * f + turning, 0.0), -1.0),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_map::energy::density::testing::{assert_derivatives, samples};

    const KINDS: [MapEnergy; 5] = [
        MapEnergy::PLAIN,
        MapEnergy::SMOOTH,
        MapEnergy::JUDGE,
        MapEnergy::POSES,
        MapEnergy { balance: 0.3, knee: 0.5 },
    ];

    #[test]
    fn the_energy_is_that_of_the_inverse() {
        for j in samples() {
            let (det, inverse) = (j.determinant(), j.inverse());
            for kind in KINDS {
                let (there, back) = (kind.density(&j), det * kind.density(&inverse));
                assert!((there - back).abs() < 1e-9 * there.max(1.0));
            }
        }
    }

    #[test]
    fn plain_is_the_sum_of_both_dirichlet_energies() {
        for j in samples() {
            let inverse = squares(&j.inverse()) * j.determinant();
            let plain = MapEnergy::PLAIN.density(&j);
            assert!((plain - squares(&j) - inverse).abs() < 1e-12 * plain, "{plain}");
        }
        assert!((MapEnergy::PLAIN.density(&DMat2::IDENTITY) - 4.0).abs() < 1e-15);
    }

    #[test]
    fn an_isometry_is_the_minimum() {
        for kind in KINDS {
            let turn = DMat2::from_angle(0.7);
            assert!((kind.distortion(&turn) - 1.0).abs() < 1e-15);
            // The image grows with J, so of one density only what keeps the area may be compared.
            let sheared = turn * DMat2::from_cols_array(&[1.1, 0.0, 0.0, 1.0 / 1.1]);
            assert!(kind.density(&sheared) > kind.density(&turn));
        }
    }

    #[test]
    fn the_derivatives_are_difference_quotients() {
        // Where nothing is projected; with a knee a part is left out everywhere.
        let exact = [[1.1, 0.1, -0.1, 0.9], [1.5, 0.2, 0.1, 1.6]].map(|c| DMat2::from_cols_array(&c));
        for kind in KINDS {
            assert_derivatives(&kind, if kind.knee == f64::INFINITY { &exact } else { &[] });
        }
    }
}

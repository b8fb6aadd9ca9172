//! The energy of a map that counts by a weight.
//!
//! What counts little costs little, but it must not be free to cover, or skin would slide into caps or out of them for the area
//! alone. So an isometry costs the same everywhere, and the weight is that of what a piece costs beyond it:
//!
//! h_w(J) = w h(J) + (1 - w) c (1 + q), c the energy of an isometry per unit of both areas.
//!
//! Summed over the map, the last part is c times both areas less what the weights leave out of it: with w the weighted sum of
//! h - c (1 + q), to which the energy of an isometry of the whole is added back. So the energy of a map is never below that.

use super::density::{Density, HessianTerm};
use super::map_energy::MapEnergy;
use crate::math::matrix2::cofactor;
use glam::DMat2;

/// The energy of a piece of a map, per unit of source area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedEnergy {
    /// The energy where the weight is 1.
    pub energy: MapEnergy,
    /// The weight, from 0 to 1.
    pub weight: f64,
}

impl Density for WeightedEnergy {
    #[inline]
    fn density(&self, j: &DMat2) -> f64 {
        let still = (1.0 - self.weight) * self.energy.isometry();
        self.weight * self.energy.density(j) + still * (1.0 + j.determinant())
    }

    #[inline]
    fn gradient(&self, j: &DMat2) -> DMat2 {
        let still = (1.0 - self.weight) * self.energy.isometry();
        self.energy.gradient(j) * self.weight + cofactor(j) * still
    }

    /// Of the weighted part only: that of the area is indefinite, and is left out as where the weight is 1.
    fn hessian(&self, j: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
        self.energy.hessian(j).into_iter().map(|term| term.scaled(self.weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_map::energy::density::testing::samples;
    use glam::DVec2;

    const KINDS: [MapEnergy; 4] = [MapEnergy::PLAIN, MapEnergy::SMOOTH, MapEnergy::JUDGE, MapEnergy::POSES];

    #[test]
    fn the_gradient_is_the_difference_quotient() {
        for (energy, weight) in KINDS.into_iter().zip([0.01, 0.3, 0.0, 1.0]) {
            let weighted = WeightedEnergy { energy, weight };
            for j in samples() {
                for k in 0..4 {
                    let mut unit = [0.0; 4];
                    unit[k] = 1e-6;
                    let h = DMat2::from_cols_array(&unit);
                    let quotient = (weighted.density(&(j + h)) - weighted.density(&(j - h))) / 2e-6;
                    let exact = weighted.gradient(&j).to_cols_array()[k];
                    assert!((quotient - exact).abs() < 1e-5 * exact.abs().max(1.0), "{quotient} {exact}");
                }
            }
        }
    }

    #[test]
    fn skin_counts_exactly_as_without_weights() {
        for energy in KINDS {
            let skin = WeightedEnergy { energy, weight: 1.0 };
            for j in samples() {
                assert_eq!(skin.density(&j).to_bits(), energy.density(&j).to_bits());
                assert_eq!(skin.gradient(&j), energy.gradient(&j));
                let terms = skin.hessian(&j).into_iter().zip(energy.hessian(&j));
                for (own, plain) in terms {
                    assert_eq!(own.weight.to_bits(), plain.weight.to_bits());
                    assert_eq!(own.apply(DVec2::ONE), plain.apply(DVec2::ONE));
                }
            }
        }
    }

    #[test]
    fn an_isometry_costs_the_same_whatever_the_weight_and_a_shear_costs_its_share() {
        let shear = DMat2::from_cols_array(&[1.5, 0.0, 0.0, 1.0 / 1.5]);
        for energy in KINDS {
            let density = |weight: f64, j: &DMat2| WeightedEnergy { energy, weight }.density(j);
            let turn = DMat2::from_angle(0.7);
            assert!((density(0.01, &turn) - density(1.0, &turn)).abs() < 1e-13);
            let beyond = |weight: f64| density(weight, &shear) - density(weight, &turn);
            assert!((beyond(0.01) - 0.01 * beyond(1.0)).abs() < 1e-13);
        }
    }
}

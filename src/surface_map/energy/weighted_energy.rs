//! The energy of a map with a weight for each piece.
//!
//! A piece of small weight adds little for its distortion, but covering it must not be free, or skin would slide into caps or out of them
//! to save area. So an isometry costs the same everywhere, and the weight multiplies what a piece costs beyond that:
//!
//! h_w(J) = w h(J) + (1 - w) c (1 + q), c the energy of an isometry per unit of both areas.
//!
//! Summed over the map, h_w is the weighted sum of h - c (1 + q) plus c times both whole areas. So the energy of a map is never below
//! that of an isometry.
//!
//! Where the rim of one mesh corresponds to one of the other, skin over a cap is wrong, and a piece of it pays a toll t for its area
//! on both meshes: u t (1 + q), u = c / 2. A larger weight could not do that: a slide without distortion would still be free. The
//! toll's gradient at the rims is the jump of this density across them, from the pieces' moving borders.

use super::density::{Density, HessianTerm};
use super::map_energy::MapEnergy;
use crate::math::matrix2::cofactor;
use crate::mesh::face_weights::PieceWeight;
use glam::DMat2;

/// The energy of a piece of a map, per unit of source area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedEnergy {
    /// The energy where the weight is 1.
    pub energy: MapEnergy,
    /// The weight of the piece, 0 to 1, and its toll.
    pub counted: PieceWeight,
}

impl MapEnergy {
    /// The density of a piece that counts so: the only place that says which one it is.
    #[inline]
    pub fn of_piece(self, counted: PieceWeight) -> impl Density {
        WeightedEnergy { energy: self, counted }
    }
}

impl WeightedEnergy {
    /// The part of the energy that does not depend on distortion, per unit of both areas: what the weight takes from an isometry, and
    /// the toll.
    #[inline]
    fn still(&self) -> f64 {
        let PieceWeight { weight, toll } = self.counted;
        (1.0 - weight) * self.energy.isometry() + toll * self.energy.unit()
    }
}

impl Density for WeightedEnergy {
    #[inline]
    fn density(&self, j: &DMat2) -> f64 {
        self.counted.weight * self.energy.density(j) + self.still() * (1.0 + j.determinant())
    }

    #[inline]
    fn gradient(&self, j: &DMat2) -> DMat2 {
        self.energy.gradient(j) * self.counted.weight + cofactor(j) * self.still()
    }

    /// The Hessian of the weighted part only: that of the area is indefinite, and is left out.
    fn hessian(&self, j: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
        self.energy.hessian(j).into_iter().map(|term| term.scaled(self.counted.weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_map::energy::density::testing::{assert_derivatives_without, samples};
    use glam::DVec2;

    const KINDS: [MapEnergy; 4] = [MapEnergy::PLAIN, MapEnergy::SMOOTH, MapEnergy::JUDGE, MapEnergy::POSES];

    /// The cost of a piece by its areas alone.
    struct AreaCost(f64);

    impl Density for AreaCost {
        fn density(&self, j: &DMat2) -> f64 {
            self.0 * (1.0 + j.determinant())
        }

        fn gradient(&self, j: &DMat2) -> DMat2 {
            cofactor(j) * self.0
        }

        fn hessian(&self, _: &DMat2) -> impl IntoIterator<Item = HessianTerm> {
            []
        }
    }

    #[test]
    fn the_derivatives_are_difference_quotients() {
        let exact = [[1.1, 0.1, -0.1, 0.9], [1.5, 0.2, 0.1, 1.6]].map(|c| DMat2::from_cols_array(&c));
        let counted = [[0.01, 1.0], [0.3, 0.0], [0.0, 0.7], [1.0, 0.2]];
        for (energy, [weight, toll]) in KINDS.into_iter().zip(counted) {
            let weighted = WeightedEnergy { energy, counted: PieceWeight { weight, toll } };
            let exact = if energy.knee == f64::INFINITY { &exact[..] } else { &[] };
            assert_derivatives_without(&AreaCost(weighted.still()), &weighted, exact);
        }
    }

    #[test]
    fn skin_counts_exactly_as_without_weights() {
        for energy in KINDS {
            let skin = WeightedEnergy { energy, counted: PieceWeight::SKIN };
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
            let density = |weight: f64, j: &DMat2| {
                WeightedEnergy { energy, counted: PieceWeight { weight, toll: 0.0 } }.density(j)
            };
            let turn = DMat2::from_angle(0.7);
            assert!((density(0.01, &turn) - density(1.0, &turn)).abs() < 1e-13);
            let beyond = |weight: f64| density(weight, &shear) - density(weight, &turn);
            assert!((beyond(0.01) - 0.01 * beyond(1.0)).abs() < 1e-13);
        }
    }

    #[test]
    fn a_toll_is_paid_for_the_area_on_both_meshes() {
        for energy in KINDS {
            for j in samples() {
                let density = |toll: f64| {
                    WeightedEnergy { energy, counted: PieceWeight { weight: 0.3, toll } }.density(&j)
                };
                let paid = density(0.5) - density(0.0);
                let areas = 1.0 + j.determinant();
                assert!((paid - 0.25 * energy.isometry() * areas).abs() < 1e-12 * density(0.5), "{paid}");
            }
        }
    }
}

//! The energy by which dents are healed: that of the map, and a steep cost of large densities.

use crate::mesh::face_weights::PieceWeight;
use crate::surface_map::energy::density::Density;
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::measures::distortion::LocalDistortion;
use glam::DMat2;

/// The energy of the map plus the cost of dents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DentEnergy {
    /// The energy of the map.
    pub energy: MapEnergy,
    /// The density above which a piece is a dent.
    pub brink: f64,
}

impl DentEnergy {
    /// The density, in units of the brink, at which the cost of a dent is 1 on either surface; it grows with the density's
    /// sixth power. Chosen by hand.
    const DEAR: f64 = 2.5;

    /// E alone, without a cost of dents.
    pub(super) const NONE: Self = Self { energy: MapEnergy::PLAIN, brink: f64::INFINITY };

    /// The energy per unit of source area of a piece.
    #[inline]
    pub(super) fn density(&self, j: &DMat2, counted: PieceWeight) -> f64 {
        let local = LocalDistortion::of(j);
        let excess = local.density / (Self::DEAR * self.brink);
        let cube = excess * excess * excess;
        self.energy.of_piece(counted).density(j) + counted.weight * ((1.0 + local.area) * cube * cube)
    }
}

//! Options of the coarse map and of its refinement.

use super::rim_draws::RimDrawOptions;
use super::rims::RimOptions;
use crate::registration::rigid_patches::RigidPatchOptions;
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::parametrisation::initial::InitialOptions;
use crate::surface_map::parametrisation::problem::FlatRelaxOptions;
use crate::surface_map::relaxation::dents::DentOptions;
use crate::surface_map::relaxation::map_relaxation::MapRelaxationOptions;

/// Options of the coarse map and of its refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultilevelOptions {
    /// Vertices of the coarse level.
    pub coarse_vertices: usize,
    /// Factor of the number of vertices from level to level.
    pub growth: f64,
    /// The first parametrisation of a coarse level.
    pub initial: InitialOptions,
    /// The relaxation of each coarse parametrisation on its own.
    pub relax: FlatRelaxOptions,
    /// The relaxation of the map of the coarse level by which a layout is judged.
    pub judge: MapRelaxationOptions,
    /// Layouts that are judged a second time: those of least mean log density.
    pub finalists: usize,
    /// Largest mean log density of a layout that is judged a second time, relative to the least one.
    pub close: f64,
    /// Maps whose mean log density is within this factor of the least one after the second judgement are judged again on
    /// finer levels.
    pub undecided: f64,
    /// Finer levels on which these maps are judged, at most.
    pub finer: usize,
    /// The relaxation for the second judgement.
    pub decide: MapRelaxationOptions,
    /// The relaxation of the map of the coarse level that was chosen.
    pub coarse: MapRelaxationOptions,
    /// The weight of caps over holes in the energies of the map, from 0 to 1; that of skin is 1.
    pub cap_weight: f64,
    /// The energy, per unit of area, of skin that is mapped onto a cap whose rim corresponds to one of the other mesh; that of an isometry
    /// is 2.
    pub border_toll: f64,
    /// Options by which corresponding rims are drawn to each other on finer levels.
    pub rim_draws: RimDrawOptions,
    /// The numbers of vertices that the coarse level keeps on the rims of caps.
    pub rims: RimOptions,
    /// A coarse map with a median distortion below this is between two poses of one body, where its mean log density is small as well: it
    /// is relaxed by [`MapEnergy::POSES`] from then on.
    pub pose_median: f64,
    /// The largest mean log density of a map between two poses of one body.
    pub pose_mean_log: f64,
    /// The factor by which E of a map between two poses of one body grows, at most, when it is relaxed by [`MapEnergy::POSES`].
    pub pose_cost: f64,
    /// The relaxation of the map on every finer level.
    pub fine: MapRelaxationOptions,
    /// Options of the registration of patches between two poses of one body.
    pub rigid_patches: RigidPatchOptions,
    /// Options of the repair of dents of the full map.
    pub dents: DentOptions,
}

impl MultilevelOptions {
    /// Vertices of the level after one with `live` vertices, of a mesh with `full`.
    pub(super) fn next_level(&self, live: usize, full: usize) -> usize {
        let next = (live as f64 * self.growth) as usize;
        // A level with more than half of the full vertices is skipped: it is hardly coarser than the full mesh.
        if 2 * next > full { full } else { next }
    }
}

impl Default for MultilevelOptions {
    fn default() -> Self {
        Self {
            // A coarse map takes a fraction of a second, so that many layouts can be judged; 1500 was the first choice.
            coarse_vertices: 500,
            // 4 in the first versions, when a relaxation cost more. Chosen by hand, not measured at half and double.
            growth: 2.0,
            initial: InitialOptions::default(),
            relax: FlatRelaxOptions::default(),
            judge: MapRelaxationOptions {
                max_rounds: 1,
                energy: MapEnergy::JUDGE,
                ..MapRelaxationOptions::default()
            },
            // Both numbers: chosen by hand, not measured at half and double.
            finalists: 4,
            close: 1.3,
            // At 594 vertices two classes of horse-horse05 were 2 % apart in the wrong order.
            undecided: 1.1,
            finer: 1,
            // Five more rounds widen the gap between the right class and the next threefold (horse-horse05).
            decide: MapRelaxationOptions {
                max_rounds: 5,
                energy: MapEnergy::JUDGE,
                ..MapRelaxationOptions::default()
            },
            // A round costs little here, and what is left undone shows on every finer level.
            coarse: MapRelaxationOptions {
                max_rounds: 60,
                relative_decrease: 2e-5,
                ..MapRelaxationOptions::default()
            },
            // The best of 0.1, 0.01 and 0.001 on poses with punched holes, in a prototype (see docs/experiments.md).
            cap_weight: 0.01,
            // The least of 1, 2, 4 and 10 that brings the rims of horse-camel together (see docs/experiments.md).
            border_toll: 4.0,
            // Both numbers were tried on two pairs cut at the neck (see docs/experiments.md).
            rim_draws: RimDrawOptions { rounds: 3, strength: 4000.0 },
            // An octagon leaves a tenth of a disc outside. Both numbers: chosen by hand.
            rims: RimOptions { each: 8, share: 0.25 },
            // Chosen by hand between the test pairs that are two poses of one body and the others, which would pay 5 to
            // 20 % of the energy for it.
            pose_median: 1.09,
            // Poses of horses have .09 to .15, those of people with 6 landmarks up to .23; cat and lion .18, other pairs of the same kind of
            // animal .21 and more: patches that do not fit each other tell those apart on finer levels.
            pose_mean_log: 0.3,
            // Poses have up to 1.025 (some three hundred coarse maps), cat and lion up to 1.017, shrec07-387-397 from 1.05 to 1.10, whose patches
            // fit as those of two people do.
            pose_cost: 1.04,
            // A finer level starts near its optimum. Chosen by hand, not measured at half and double.
            fine: MapRelaxationOptions {
                max_rounds: 10,
                relative_decrease: 3e-4,
                ..MapRelaxationOptions::default()
            },
            rigid_patches: RigidPatchOptions::default(),
            dents: DentOptions::default(),
        }
    }
}

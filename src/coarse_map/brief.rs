//! Coarse maps that are only compared with each other: which of several sets of landmark pairs fits best.

use super::class_search::{ClassChoice, ClassSearchOptions, choose_class};
use super::landmarked_mesh::{LEAST_PER_LANDMARK, LandmarkedMesh};
use super::mesh_with_coarse::MeshWithCoarse;
use super::multilevel::CoarseMap;
use super::options::MultilevelOptions;
use crate::landmarks::MeshSide;
use crate::layout::SearchOptions;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::parametrisation::initial::InitialOptions;
use crate::surface_map::parametrisation::problem::FlatRelaxOptions;
use crate::surface_map::relaxation::map_relaxation::MapRelaxationOptions;

/// Options of a brief map. On 2 x 500 vertices it takes some hundredths of a second.
#[derive(Clone, Debug, PartialEq)]
pub struct BriefOptions {
    /// Vertices of the coarse levels, unless the landmarks need more.
    pub vertices: usize,
    /// Options of the search for layouts.
    pub search: SearchOptions,
    /// Options by which the coarse maps are made, judged and relaxed.
    pub multilevel: MultilevelOptions,
    /// The last relaxation before a map is measured.
    pub relaxation: MapRelaxationOptions,
}

/// The relaxation of each coarse parametrisation on its own. With a least decrease of 1e-4, as for maps, judging took 1.6 times as long, for
/// the same order of candidates on five pairs (both directions); with 0.1, or looser linear solves, a right one of 387-397 was lost.
const START: FlatRelaxOptions =
    FlatRelaxOptions { relative_decrease: 0.01, max_steps: 100, linear_tolerance: 0.03 };

impl Default for BriefOptions {
    fn default() -> Self {
        Self {
            // With 300 vertices the order of close candidates changed, with three drawings and three twists in place of one it did not,
            // at twice the time (four pairs, both directions).
            vertices: 500,
            // Of 122 twists of bent drawings of people and animals that made them straighter 119 were the first or second that was tried; descents
            // that tried all others in vain took a sixth of the time.
            // The first layout of 9 of 534 sets of landmarks had no map, the right ones of a dragon among them; one of the first four always had.
            search: SearchOptions {
                candidates: 1,
                until_mapped: 4,
                descent_patience: 2,
                twists: 0,
                ..SearchOptions::default()
            },
            multilevel: MultilevelOptions {
                finer: 0,
                finalists: 2,
                initial: InitialOptions { level: START, ..InitialOptions::default() },
                relax: START,
                ..MultilevelOptions::default()
            },
            relaxation: MapRelaxationOptions {
                max_rounds: 10,
                energy: MapEnergy::JUDGE,
                ..MapRelaxationOptions::default()
            },
        }
    }
}

impl BriefOptions {
    /// The options for a closer look at ears and horns, which have some ten vertices on other brief maps, at about twice the time. On 54 pairs
    /// of bodies with such ends 700 vertices left four more of them wrong, four drawings in place of one none fewer.
    pub fn closer() -> Self {
        Self { vertices: 1000, ..Self::default() }
    }
}

/// Makes a brief map with these vertices of both meshes as landmarks, and lets `measure` look at it and relax it further; `None` where
/// there is no map, or nothing is measured.
///
/// # Errors
/// [`Cancelled`].
pub fn brief_map<T>(
    meshes: [&SurfaceMesh; 2],
    landmarks: [&[VertexId]; 2],
    options: &BriefOptions,
    monitor: &mut dyn Monitor,
    measure: impl FnOnce(&[LandmarkedMesh; 2], CoarseMap<'_>, &mut dyn Monitor) -> Result<Option<T>, Cancelled>,
) -> Result<Option<T>, Cancelled> {
    let landmarked = |side: MeshSide| LandmarkedMesh::new(meshes[side], landmarks[side]);
    let [Ok(source), Ok(target)] = MeshSide::BOTH.map(landmarked) else { return Ok(None) };
    let full = [source, target];
    let vertices = options.vertices.max(LEAST_PER_LANDMARK * landmarks[0].len());
    let mut coarse = |k: usize| {
        let preparing = &mut Portion::new(monitor, 0.0, 0.0);
        MeshWithCoarse::new(&full[k], vertices, options.multilevel.rims, preparing)
    };
    let levels = [coarse(0)?, coarse(1)?];
    let class = ClassSearchOptions {
        multilevel: &options.multilevel,
        search: &options.search,
        choice: ClassChoice::Best,
    };
    let chosen = unless_stopped(choose_class(&levels, class, &mut Portion::new(monitor, 0.0, 0.8).unseen()))?;
    let Some(chosen) = chosen else { return Ok(None) };
    measure(&full, chosen.map, &mut Portion::new(monitor, 0.8, 1.0))
}

//! An attempt at a map: the size of its coarse levels, its coarse map, and its solution before that is certified.

use super::{Base, MapInput, PipelineError, PipelineOptions};
use crate::base_domain;
use crate::coarse_map::class_search::{Chosen, ClassChoice, ClassSearchOptions, choose_class};
use crate::coarse_map::multilevel::{CoarseMap, solve_coarse, solve_fine};
use crate::coarse_map::own_cones::{OwnConeOptions, Refined};
use crate::coarse_map::{LEAST_PER_LANDMARK, LandmarkedMesh, MeshWithCoarse, coarse_landmarks};
use crate::layout::{self, BaseLayout, LayoutError, SearchOptions, SearchReport};
use crate::monitor::{Monitor, Portion};
use crate::surface_map::{ConeSurface, Embedding, MapError};
use std::sync::Arc;

/// Vertices of the coarse level for each landmark and each cone of the program's own, where these are added: with 500 vertices in
/// place of 640 for 12 landmarks and 20 own cones a limb was left turned on two poses of a horse (distance from the truth 0.5 and 0.6 % of
/// the root of the area, in place of 0.2 and 0.3).
const PER_OWN_CONE: usize = 20;

/// Whether cones of the program's own are tried with this many landmarks.
pub(super) fn has_own_cones(landmarks: usize, options: &PipelineOptions) -> bool {
    landmarks <= options.own_cones.most_landmarks && options.own_cones.count > 0
}

/// Whether cones of the program's own are tried with this many landmarks between two poses of one body. A search with them would go back to
/// the best class.
pub(super) fn has_own_cones_of_poses(landmarks: usize, options: &PipelineOptions) -> bool {
    let OwnConeOptions { most_pose_landmarks, count, .. } = options.own_cones;
    landmarks <= most_pose_landmarks && count > 0 && options.class == ClassChoice::Best
}

/// Vertices of the coarse level on which the search for the class begins.
pub(super) fn first_level(landmarks: usize, options: &PipelineOptions) -> usize {
    let least = options.multilevel.coarse_vertices.max(LEAST_PER_LANDMARK * landmarks);
    if has_own_cones(landmarks, options) { least.max(level_with_own(landmarks, options)) } else { least }
}

/// Vertices of a coarse level that has enough of them for this many landmarks and the program's own cones.
pub(super) fn level_with_own(landmarks: usize, options: &PipelineOptions) -> usize {
    PER_OWN_CONE * (landmarks + options.own_cones.count)
}

/// An attempt at a map: the size of its coarse levels, and the options of its search.
#[derive(Clone, Copy)]
pub(super) struct Attempt {
    /// Vertices of the coarse levels.
    pub(super) vertices: usize,
    pub(super) search: SearchOptions,
    pub(super) scale: Scale,
}

/// The scaling of meshes with caps.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// Both meshes have area 1 with their caps.
    ByArea,
    /// The skin that both meshes share has the same area on both.
    BySkin,
}

/// Number of times that coarse levels grow where no layout has a map. With the two numbers below, chosen by hand together, the user has
/// the answer that there is no map within about the time of two maps.
pub(super) const FINER_LEVELS: usize = 2;
/// Factor of the number of vertices by which they grow.
const FINER_GROWTH: usize = 4;
/// Layouts that are judged on each finer level, at most.
const FINER_CANDIDATES: usize = 3;

impl Attempt {
    pub(super) fn finer(self) -> Self {
        // Each layout costs as many times more as the level has more vertices, and where one fails most do.
        let candidates = self.search.candidates.min(FINER_CANDIDATES);
        let search = SearchOptions { candidates, ..self.search };
        Self { vertices: FINER_GROWTH * self.vertices, search, ..self }
    }
}

/// Both parametrisations before they are certified.
pub(super) struct Solved {
    pub(super) layout: BaseLayout,
    pub(super) search: SearchReport,
    pub(super) surface: Arc<ConeSurface>,
    pub(super) embeddings: [Embedding; 2],
    /// The meshes where they are not those given: with own cones, or scaled.
    pub(super) meshes: Option<[LandmarkedMesh; 2]>,
}

impl Solved {
    /// The solution whose meshes have cones of the program's own.
    pub(super) fn with_own(refined: Refined, layout: BaseLayout, search: SearchReport) -> Self {
        let Refined { surface, embeddings, full } = refined;
        Self { layout, search, surface, embeddings, meshes: Some(full) }
    }
}

/// A coarse map with its layout.
pub(super) struct Coarse<'a> {
    pub(super) layout: BaseLayout,
    pub(super) search: SearchReport,
    pub(super) map: CoarseMap<'a>,
}

impl Coarse<'_> {
    /// The coarse map relaxed up to the full meshes.
    pub(super) fn solved(
        self,
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Solved, PipelineError> {
        let Self { layout, search, map } = self;
        let surface = map.surface.clone();
        let embeddings = solve_fine(map, &options.multilevel, monitor)?;
        Ok(Solved { layout, search, surface, embeddings, meshes: None })
    }
}

/// The coarse map of least mean log density among the classes of layouts that are tried.
pub(super) fn coarse<'a>(
    input: MapInput<'_>,
    sides: &'a [MeshWithCoarse<'a>; 2],
    options: &PipelineOptions,
    search: &SearchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Coarse<'a>, PipelineError> {
    match options.base {
        Base::Joint => {
            let PipelineOptions { multilevel, class, .. } = options;
            let search_options = ClassSearchOptions { multilevel, search, choice: *class };
            let chosen = choose_class(sides, search_options, &mut Portion::new(monitor, 0.0, 0.9))?;
            let Chosen { candidate, search, mut map } = chosen;
            map.finish(&options.multilevel, &mut Portion::new(monitor, 0.9, 1.0))?;
            monitor.preview(&map);
            Ok(Coarse { layout: candidate.layout, search, map })
        }
        Base::Qem => {
            let landmarks = coarse_landmarks(sides);
            let meshes = [&sides[0].coarse.mesh, &sides[1].coarse.mesh];
            let part = &mut Portion::new(monitor, 0.0, 0.3);
            let base = base_domain::simplify(input.target, &input.landmarks.target.raw, part)?;
            let part = &mut Portion::new(monitor, 0.3, 0.5);
            let layout = layout::from_base(meshes, &landmarks, &base, part)?;
            let part = &mut Portion::new(monitor, 0.5, 0.8);
            let map = solve_coarse(sides, &layout, &options.multilevel, part);
            let mut map = map.map_err(|error| match error {
                MapError::Cancelled(stop) => PipelineError::from(stop),
                _ => LayoutError::NoMap { layouts: 1, near: Vec::new() }.into(),
            })?;
            map.finish(&options.multilevel, &mut Portion::new(monitor, 0.8, 1.0))?;
            monitor.preview(&map);
            Ok(Coarse { layout, search: SearchReport::default(), map })
        }
    }
}

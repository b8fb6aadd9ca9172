//! The certified parametrisations of both meshes: class search, own cones, refinement, certificate.

use super::borders::{BordersReport, CountedCaps, counted_caps};
use super::{Base, MapInput, PipelineError, PipelineOptions, Relaxation};
use crate::base_domain;
use crate::coarse_map::class_search::{Chosen, ClassChoice, ClassSearchOptions, choose_class};
use crate::coarse_map::multilevel::{CoarseMap, LevelImages, solve_coarse, solve_fine};
use crate::coarse_map::own_cones::{self, OwnConeOptions, Owners, Refined, Rounds, Start};
use crate::coarse_map::unrelaxed::{Unrelaxed, solve_unrelaxed};
use crate::coarse_map::{
    LEAST_PER_LANDMARK, LandmarkedMesh, MeshWithCoarse, coarse_landmarks, coarse_levels, share_elsewhere,
};
use crate::landmarks::Landmarks;
use crate::layout::{self, BaseLayout, LayoutError, MOST_DISTANCES, SearchOptions, SearchReport};
use crate::monitor::{Monitor, Portion, Stage, Step};
use crate::surface_map::{Certificate, ConeSurface, Embedding, MapError, Parametrised, certify};
use std::sync::Arc;

/// The certified parametrisations of both sides.
pub(super) struct Parametrisation {
    pub(super) layout: BaseLayout,
    pub(super) search: SearchReport,
    pub(super) surface: Arc<ConeSurface>,
    pub(super) sides: [LandmarkedMesh; 2],
    pub(super) embeddings: [Embedding; 2],
    pub(super) certificate: Certificate,
    pub(super) stopped_early: bool,
    /// The report of the rims of holes; `None` where not both meshes have any.
    pub(super) borders: Option<BordersReport>,
}

impl Parametrisation {
    /// The same with source and target exchanged.
    pub(super) fn exchanged(mut self) -> Self {
        let BaseLayout { source, target, .. } = &mut self.layout;
        std::mem::swap(source, target);
        self.sides.reverse();
        self.embeddings.reverse();
        self.borders = self.borders.map(BordersReport::exchanged);
        self
    }

    pub(super) fn sides(&self) -> [Parametrised<'_>; 2] {
        [0, 1].map(|k| self.sides[k].parametrised(&self.embeddings[k]))
    }
}

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
fn first_level(landmarks: usize, options: &PipelineOptions) -> usize {
    let least = options.multilevel.coarse_vertices.max(LEAST_PER_LANDMARK * landmarks);
    if has_own_cones(landmarks, options) { least.max(level_with_own(landmarks, options)) } else { least }
}

/// Vertices of a coarse level that has enough of them for this many landmarks and the program's own cones.
fn level_with_own(landmarks: usize, options: &PipelineOptions) -> usize {
    PER_OWN_CONE * (landmarks + options.own_cones.count)
}

/// An attempt at a map: the size of its coarse levels, and the options of its search.
#[derive(Clone, Copy)]
struct Attempt {
    /// Vertices of the coarse levels.
    vertices: usize,
    search: SearchOptions,
    scale: Scale,
}

/// The scaling of meshes with caps.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Scale {
    /// Both meshes have area 1 with their caps.
    ByArea,
    /// The skin that both meshes share has the same area on both.
    BySkin,
}

/// Number of times that coarse levels grow where no layout has a map. With the two numbers below, chosen by hand together, the user has
/// the answer that there is no map within about the time of two maps.
const FINER_LEVELS: usize = 2;
/// Factor of the number of vertices by which they grow.
const FINER_GROWTH: usize = 4;
/// Layouts that are judged on each finer level, at most.
const FINER_CANDIDATES: usize = 3;

impl Attempt {
    fn finer(self) -> Self {
        // Each layout costs as many times more as the level has more vertices, and where one fails most do.
        let candidates = self.search.candidates.min(FINER_CANDIDATES);
        let search = SearchOptions { candidates, ..self.search };
        Self { vertices: FINER_GROWTH * self.vertices, search, ..self }
    }
}

/// Makes and certifies both parametrisations: coarse map, fine map, certificate. Coarse levels grow where no layout has a map.
pub(super) fn parametrise(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Parametrisation, PipelineError> {
    monitor.enter(Stage::ClassSearch);
    let Landmarks { source, target } = input.landmarks;
    let CountedCaps { weights: [on_source, on_target], report: borders } =
        counted_caps(input, options, monitor)?;
    monitor.step(Step::default())?;
    let source = LandmarkedMesh::new(input.source, &source.raw)?.with_weights(on_source);
    monitor.step(Step::default())?;
    let target = LandmarkedMesh::new(input.target, &target.raw)?.with_weights(on_target);
    let full = [source, target];
    let most = full.iter().map(|mesh| mesh.refined.mesh.vertex_count()).max().unwrap_or(0);
    let vertices = first_level(input.landmarks.len(), options);
    let mut attempt = Attempt { vertices, search: options.search, scale: Scale::ByArea };
    let mut finer_levels = FINER_LEVELS;
    let solved = loop {
        match solve(input, &full, attempt, options, monitor) {
            Err(PipelineError::Layout(LayoutError::NoMap { .. }))
                if attempt.vertices < most
                    && finer_levels > 0
                    && input.landmarks.len() * attempt.finer().vertices <= MOST_DISTANCES =>
            {
                finer_levels -= 1;
                attempt = attempt.finer();
            }
            outcome => break outcome?,
        }
    };
    let Solved { layout, search, surface, embeddings, meshes } = solved;
    let full = meshes.unwrap_or(full);
    let stopped_early = monitor.wants_result();
    let certificate = certified([0, 1].map(|k| full[k].parametrised(&embeddings[k])), &surface, monitor)?;
    let sides = full;
    Ok(Parametrisation { layout, search, surface, sides, embeddings, certificate, stopped_early, borders })
}

/// The certificate of both parametrisations.
///
/// # Errors
/// [`PipelineError::NotCertified`] where they are no homeomorphisms, or cancellation.
pub(super) fn certified(
    sides: [Parametrised<'_>; 2],
    surface: &ConeSurface,
    monitor: &mut dyn Monitor,
) -> Result<Certificate, PipelineError> {
    monitor.enter(Stage::Certificate);
    let [source, target] = sides;
    monitor.step(Step::default())?;
    let source = certify(source, surface);
    monitor.step(Step { fraction: 0.5, residual: None })?;
    let certificate = source.and(&certify(target, surface));
    if certificate.bijective { Ok(certificate) } else { Err(PipelineError::NotCertified(certificate)) }
}

/// Both parametrisations before they are certified.
struct Solved {
    layout: BaseLayout,
    search: SearchReport,
    surface: Arc<ConeSurface>,
    embeddings: [Embedding; 2],
    /// The meshes where they are not those given: with own cones, or scaled.
    meshes: Option<[LandmarkedMesh; 2]>,
}

impl Solved {
    /// The solution whose meshes have cones of the program's own.
    fn with_own(refined: Refined, layout: BaseLayout, search: SearchReport) -> Self {
        let Refined { surface, embeddings, full } = refined;
        Self { layout, search, surface, embeddings, meshes: Some(full) }
    }
}

/// Progress of the search for the class before ends of limbs are looked at. Chosen by hand, for display only.
const SEARCHED: f64 = 0.8;

/// Solves an attempt, from its coarse levels to the full meshes.
fn solve(
    input: MapInput<'_>,
    full: &[LandmarkedMesh; 2],
    attempt: Attempt,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Solved, PipelineError> {
    let Attempt { vertices, search, scale } = attempt;
    let coarsening = &mut Portion::new(monitor, 0.0, 0.0);
    let sides = coarse_levels(full, vertices, options.multilevel.rims, coarsening)?;
    // Cones at ends of limbs are part of the search where there are too many landmarks for a stage of own cones.
    let has_own = has_own_cones(input.landmarks.len(), options);
    let searched = if has_own { 1.0 } else { SEARCHED };
    let searching = &mut Portion::new(monitor, 0.0, searched);
    let Coarse { layout, mut search, map } = coarse(input, &sides, options, &search, searching)?;
    if scale == Scale::ByArea
        && !monitor.wants_result()
        && let Some(factor) = map.better_scale()
    {
        // Begun anew: the class was judged, and poses of one body were recognised, at the wrong scale.
        let scaled = [full[0].clone(), full[1].scaled(factor)];
        let solved = solve(input, &scaled, Attempt { scale: Scale::BySkin, ..attempt }, options, monitor)?;
        return Ok(Solved { meshes: Some(solved.meshes.unwrap_or(scaled)), ..solved });
    }
    if options.relaxation == Relaxation::None {
        monitor.enter(Stage::Relaxation);
        let Unrelaxed { surface, embeddings } =
            solve_unrelaxed(&sides, &layout, &options.multilevel, monitor)?;
        return Ok(Solved { layout, search, surface, embeddings, meshes: None });
    }
    if !has_own && has_own_cones_of_poses(input.landmarks.len(), options) && map.is_of_poses() {
        let first = Coarse { layout, search, map };
        return poses_with_many_landmarks(input, full, first, attempt, options, monitor);
    }
    if has_own {
        monitor.enter(Stage::OwnCones);
    }
    // A search with ends of limbs would go back to the best class.
    let ends = if options.class == ClassChoice::Best { options.own_cones.ends } else { 0 };
    let own_options = OwnConeOptions { ends, ..options.own_cones };
    let (meshes, levels) = (Rounds::new(&own_options), Rounds::new(&own_options));
    let start = Start { inputs: [input.source, input.target], full, map: &map, vertices, is_one_body: false };
    let owners = Owners { meshes: &meshes, levels: &levels };
    let adding = &mut Portion::new(monitor, if has_own { 0.0 } else { SEARCHED }, 1.0);
    let own = own_cones::add(start, owners, &options.multilevel, &own_options, adding)?;
    monitor.enter(Stage::Relaxation);
    if let Some(own) = own {
        let worse = map.mean_log / own.mean_log();
        if let Some(refined) = own.refined(&options.multilevel, monitor)? {
            if !has_own {
                // The runner-up has no cones at ends of limbs.
                search.rival = search.rival.map(|rival| worse * rival);
            }
            return Ok(Solved::with_own(refined, layout, search));
        }
    }
    Coarse { layout, search, map }.solved(options, monitor)
}

/// With many landmarks another map between two poses of one body is taken where its mean log density on a finer level is below this many
/// times that of the first one. Own cones that turned a limb back brought it to .49 to .80; where nothing is turned they brought it to .91
/// and more, and the map no nearer to the truth.
const TURNED: f64 = 0.9;

/// Two coarse maps between poses, of levels with fewer and with more vertices, are the same where less than this share of the vertices has other
/// images. Of sixteen maps between poses of people those with a head or a limb to turn back had .015 to .16; twenty maps between poses of a child,
/// hands, horses and a cat, with nothing to turn back, had .002 at most.
const ELSEWHERE: f64 = 0.005;

/// Progress of the second look at two poses after the first map was judged, after the search on other levels, and after its map was
/// judged. Chosen by hand, for display only.
const LOOKED: [f64; 3] = [0.1, 0.3, 0.4];

/// The map between two poses of one body with many landmarks: the first one, or where that turns a limb between its landmarks, the one that turns
/// it back.
fn poses_with_many_landmarks(
    input: MapInput<'_>,
    full: &[LandmarkedMesh; 2],
    mut first: Coarse<'_>,
    attempt: Attempt,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Solved, PipelineError> {
    if !monitor.wants_result() {
        monitor.enter(Stage::OwnCones);
        let PipelineOptions { multilevel, own_cones: own_options, .. } = options;
        let images = first.map.images();
        let judging = &mut Portion::new(monitor, 0.0, LOOKED[0]);
        if own_cones::on_finer_level(&mut first.map, own_options, multilevel, judging)? {
            let doubted = Doubted { images, mean_log: first.map.mean_log };
            if let Some(solved) = turned_back(input, full, doubted, attempt, options, monitor)? {
                return Ok(solved);
            }
        }
    }
    monitor.enter(Stage::Relaxation);
    first.solved(options, monitor)
}

/// The map between two poses that may turn a limb between its landmarks.
struct Doubted {
    /// The images of the coarse map; `None` where a vertex could not be located.
    images: Option<LevelImages>,
    /// Its mean log density on a finer level.
    mean_log: f64,
}

/// A map of coarse levels with more vertices that is clearly better on a finer level ([`TURNED`]); where it has other images than the first one
/// ([`ELSEWHERE`]), which then turns a limb or its rival does, also one with own cones. `None` where there is none.
fn turned_back(
    input: MapInput<'_>,
    full: &[LandmarkedMesh; 2],
    first: Doubted,
    attempt: Attempt,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<Solved>, PipelineError> {
    let PipelineOptions { multilevel, own_cones: own_options, .. } = options;
    // More cones need levels with more vertices, and their maps are compared with one on such levels.
    let vertices = attempt.vertices.max(level_with_own(input.landmarks.len(), options));
    let searching = &mut Portion::new(monitor, LOOKED[0], LOOKED[1]).unseen();
    let sides = coarse_levels(full, vertices, multilevel.rims, &mut Portion::new(searching, 0.0, 0.0))?;
    let found = match coarse(input, &sides, options, &attempt.search, searching) {
        Ok(found) => found,
        Err(PipelineError::Layout(LayoutError::NoMap { .. })) => return Ok(None),
        Err(error) => return Err(error),
    };
    if !found.map.is_of_poses() {
        return Ok(None);
    }
    let mut least = TURNED * first.mean_log;
    let mut finer = found.map.clone();
    let judging = &mut Portion::new(monitor, LOOKED[1], LOOKED[2]);
    let is_better = match own_cones::on_finer_level(&mut finer, own_options, multilevel, judging) {
        Ok(is_of_one_body) => is_of_one_body && finer.mean_log < least,
        Err(MapError::Cancelled(stop)) => return Err(stop.into()),
        // The first map stays.
        Err(_) => false,
    };
    if is_better {
        least = TURNED * finer.mean_log;
    }
    let both = first.images.zip(found.map.images());
    let agree = both.is_some_and(|(here, there)| share_elsewhere([&here, &there]) < ELSEWHERE);
    if !agree {
        let (inputs, map) = ([input.source, input.target], &found.map);
        let start = Start { inputs, full, map, vertices, is_one_body: true };
        if let Some(refined) = with_own_cones(start, least, options, monitor)? {
            return Ok(Some(Solved::with_own(refined, found.layout, found.search)));
        }
    }
    if !is_better {
        return Ok(None);
    }
    monitor.enter(Stage::Relaxation);
    Coarse { map: finer, ..found }.solved(options, monitor).map(Some)
}

/// The map between two poses with own cones, where its mean log density on a finer level is below `least`.
fn with_own_cones(
    start: Start<'_>,
    least: f64,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<Refined>, PipelineError> {
    let PipelineOptions { multilevel, own_cones: own_options, .. } = options;
    let (meshes, levels) = (Rounds::new(own_options), Rounds::new(own_options));
    let owners = Owners { meshes: &meshes, levels: &levels };
    let adding = &mut Portion::new(monitor, LOOKED[2], 1.0);
    if let Some(own) = own_cones::add(start, owners, multilevel, own_options, adding)?
        && let Some(own) = own.on_finer_level(own_options, multilevel, adding)?
        && own.mean_log() < least
    {
        monitor.enter(Stage::Relaxation);
        return Ok(own.refined(multilevel, monitor)?);
    }
    Ok(None)
}

/// A coarse map with its layout.
struct Coarse<'a> {
    layout: BaseLayout,
    search: SearchReport,
    map: CoarseMap<'a>,
}

impl Coarse<'_> {
    /// The coarse map relaxed up to the full meshes.
    fn solved(self, options: &PipelineOptions, monitor: &mut dyn Monitor) -> Result<Solved, PipelineError> {
        let Self { layout, search, map } = self;
        let surface = map.surface.clone();
        let embeddings = solve_fine(map, &options.multilevel, monitor)?;
        Ok(Solved { layout, search, surface, embeddings, meshes: None })
    }
}

/// The coarse map of least mean log density among the classes of layouts that are tried.
fn coarse<'a>(
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

//! Cones that the program adds: at ends of limbs without a landmark, and where the user gave few landmarks.
//!
//! Ends of limbs that both bodies have become cones where that lowers the mean log density, or hardly raises it (`limb_ends`).
//!
//! A cone surface with few cones is a poor image of a body with many limbs, and the descent of a map over it ends in a poor
//! minimum. So points are added and carried to the target by the present map; the map is solved again with all as cones.
//! Every round takes fresh points, so that those of the round before are free to move. Between two poses of one body the last rounds place
//! their points by a map that was refined first: on finer levels patches are registered.

use super::best_images::SeenMaps;
use super::class_search::{ClassChoice, ClassSearchOptions, choose_class};
use super::distance_guess::{self, Guess};
use super::landmarked_mesh::LandmarkedMesh;
use super::limb_ends;
use super::mesh_with_coarse::{self, MeshWithCoarse};
use super::multilevel::{CoarseMap, LevelImages, solve_fine};
use super::options::MultilevelOptions;
pub use super::own_points::OwnPair;
use super::own_points::{PointChoice, apart, pairs, with};
use crate::layout::SearchOptions;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use crate::surface_map::relaxation::map_relaxation::MapRelaxationOptions;
use crate::surface_map::{ConeSurface, Embedding, MapError, certify};
use std::cell::OnceCell;
use std::sync::Arc;
use typed_index_collections::TiVec;

/// Options of the program's own cones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnConeOptions {
    /// Points that are added in each round, beside further ones in gaps; 0 for none, and for no ends of limbs either.
    pub count: usize,
    /// Further points are added as long as one is farther than this from all others; the root of the area is 1.
    pub gap: f64,
    /// Points that are added in each round with those in gaps, at most.
    pub most: usize,
    /// Ends of limbs that are looked at on each mesh, at most, the most remote; 0 for none.
    pub ends: usize,
    /// Other points than ends of limbs are added where there are at most this many landmarks.
    pub most_landmarks: usize,
    /// Between two poses of one body they are added where there are at most this many.
    pub most_pose_landmarks: usize,
    /// Points are added only where the mean log density of the coarse map is at least this; 0 for an isometry.
    pub least_mean_log: f64,
    /// Rounds, each with another set of points, at most, beside those with ends of limbs.
    pub rounds: usize,
    /// Stops after this many rounds without a gain.
    pub patience: usize,
    /// Further rounds between two poses of one body, whose points are placed by the map of a finer level; 0 for none.
    pub finer_rounds: usize,
    /// Least number of vertices of that finer level.
    pub finer_vertices: usize,
    /// The share by which a gain lowers the mean log density.
    pub least_gain: f64,
    /// Options of the search for the layout with own points.
    pub search: SearchOptions,
}

impl Default for OwnConeOptions {
    fn default() -> Self {
        let search = SearchOptions { candidates: 2, twists: 2, ..SearchOptions::default() };
        Self {
            // With 12 of 33 landmarks that makes about as many cones as all 33. Rounds and gains were chosen by hand.
            count: 20,
            // With 20 points bodies of many long limbs, as ants and spiders, have gaps of .16 to .18, and four-footed animals with 12 landmarks
            // .12 to .14. With gaps of .12 at most E of the former falls by up to 12 % (see docs/experiments.md).
            gap: 0.12,
            most: 40,
            ends: 12,
            most_landmarks: 16,
            // Of sixteen maps between poses of people with 33 landmarks eight had a limb or the head turned, 0.6 to 2.4 % of the root of
            // the area from the truth on the mean; with own cones none has. More than 40 landmarks were not tried.
            most_pose_landmarks: 40,
            // The mean log density of a map of energy 4.01.
            least_mean_log: 0.0025,
            rounds: 6,
            patience: 2,
            // With one a leg of a horse stayed turned, with two none did; with levels of 1200 vertices two of three pairs were farther
            // from the truth, for a twentieth less time (see docs/experiments.md).
            finer_rounds: 2,
            finer_vertices: 2000,
            least_gain: 0.02,
            search,
        }
    }
}

impl OwnConeOptions {
    /// The number of rounds with points far from all others, at most.
    fn all_rounds(&self) -> usize {
        self.rounds + self.finer_rounds
    }

    /// The options for ends of limbs. Twists change nothing for them on 28 pairs of animals, beyond what another drawing changes; with one
    /// drawing in place of two a tail was left in a dent on one of 102 pairs with clicked landmarks.
    fn untwisted(&self) -> SearchOptions {
        SearchOptions { twists: 0, ..self.search }
    }

    /// The options for poses with many landmarks: what finer rounds gain was seen with few landmarks alone.
    fn of_poses(&self) -> Self {
        Self { finer_rounds: 0, ..*self }
    }

    /// The options for points whose class is known.
    fn drawn_once(&self) -> SearchOptions {
        SearchOptions { candidates: 1, ..self.untwisted() }
    }
}

/// Storage for the meshes or levels of all rounds, which their maps borrow: each round fills one cell.
pub struct Rounds<T>(Vec<OnceCell<[T; 2]>>);

impl<T> Rounds<T> {
    /// Empty storage for all rounds.
    pub fn new(options: &OwnConeOptions) -> Self {
        // Each round with ends of limbs has half as many as the one before.
        let with_ends = usize::BITS - options.ends.leading_zeros();
        Self((0..with_ends as usize + options.all_rounds()).map(|_| OnceCell::new()).collect())
    }
}

/// Storage for the meshes and the levels of all rounds.
#[derive(Clone, Copy)]
pub struct Owners<'a> {
    /// Both meshes with own landmarks.
    pub meshes: &'a Rounds<LandmarkedMesh>,
    /// These meshes with their coarse levels.
    pub levels: &'a Rounds<MeshWithCoarse<'a>>,
}

/// The cells of both that are not filled yet, round by round.
type Cells<'a> = std::iter::Zip<
    std::slice::Iter<'a, OnceCell<[LandmarkedMesh; 2]>>,
    std::slice::Iter<'a, OnceCell<[MeshWithCoarse<'a>; 2]>>,
>;

impl<'a> Owners<'a> {
    fn cells(self) -> Cells<'a> {
        self.meshes.0.iter().zip(&self.levels.0)
    }
}

/// Both meshes with own landmarks after the user's, and the coarse map of all.
#[derive(Clone)]
pub struct OwnCones<'a> {
    full: &'a [LandmarkedMesh; 2],
    map: CoarseMap<'a>,
}

impl OwnCones<'_> {
    /// Mean log density of the coarse map.
    pub fn mean_log(&self) -> f64 {
        self.map.mean_log
    }

    /// Shows the coarse map to whoever waits.
    pub fn show(&self, monitor: &mut dyn Monitor) {
        monitor.preview(&self.map);
    }

    /// The same on a finer level ([`on_finer_level`]); `None` where there is none, or where patches of both meshes do not fit each other there.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn on_finer_level(
        self,
        own: &OwnConeOptions,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>, Cancelled> {
        let finer = self.finer(own.finer_vertices, options, monitor)?;
        Ok(finer.filter(|finer| finer.map.is_of_one_body()))
    }

    /// The same on a level with at least this many vertices; `None` where there are none between the coarse level and the full meshes, or
    /// where there is no map.
    fn finer(
        self,
        vertices: usize,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>, Cancelled> {
        let Self { full, mut map } = self;
        let is_finer = unless_stopped(map.refine_to(vertices, options, monitor))?;
        Ok(is_finer.unwrap_or(false).then_some(Self { full, map }))
    }

    /// The map of the full meshes; `None` where it is not found or not certified.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn refined(
        self,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Refined>, Cancelled> {
        let Self { full, map } = self;
        let surface = map.surface.clone();
        let Some(embeddings) = unless_stopped(solve_fine(map, options, monitor))? else { return Ok(None) };
        let certified = |k: usize| certify(full[k].parametrised(&embeddings[k]), &surface).bijective;
        let bijective = certified(0) && certified(1);
        Ok(bijective.then(|| Refined { surface, embeddings, full: full.clone() }))
    }
}

/// The map of the full meshes with own landmarks.
pub struct Refined {
    /// The cone surface.
    pub surface: Arc<ConeSurface>,
    /// Both parametrisations.
    pub embeddings: [Embedding; 2],
    /// Both meshes with own landmarks after the user's.
    pub full: [LandmarkedMesh; 2],
}

/// Both meshes and their coarse map before own cones are added.
#[derive(Clone, Copy)]
pub struct Start<'a> {
    /// The meshes that the user gave.
    pub inputs: [&'a SurfaceMesh; 2],
    /// The meshes with the user's landmarks.
    pub full: &'a [LandmarkedMesh; 2],
    /// The coarse map with the user's landmarks alone.
    pub map: &'a CoarseMap<'a>,
    /// Vertices of the coarse levels.
    pub vertices: usize,
    /// Whether patches of both meshes are known to fit each other ([`on_finer_level`]).
    pub is_one_body: bool,
}

/// Goes on with a map between two poses to a finer level, on which patches of both meshes are registered and maps of different coarse levels can be
/// compared; `false` where there is no finer level, or where the patches tell that there are two bodies.
///
/// # Errors
/// [`MapError::NoStart`], [`MapError::Cancelled`].
pub fn on_finer_level(
    map: &mut CoarseMap<'_>,
    own: &OwnConeOptions,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<bool, MapError> {
    Ok(map.refine_to(own.finer_vertices, options, monitor)? && map.is_of_one_body())
}

/// The number of ends of limbs that are farther than `distance` from all landmarks, of at most as many as the options say: that of the mesh with fewer;
/// 0 where the coarse map gives no images. The area is 1.
///
/// # Errors
/// Cancellation only.
pub fn unmarked_ends(
    start: Start<'_>,
    distance: f64,
    own: &OwnConeOptions,
    monitor: &mut dyn Monitor,
) -> Result<usize, Cancelled> {
    let Some(images) = start.map.images() else { return Ok(0) };
    limb_ends::unmarked(start.full, &images, own.ends, distance, monitor)
}

/// Adds own landmarks round by round, as long as they lower the mean log density of the coarse map; `None` where they do not.
///
/// Ends of limbs without a landmark are added. Where there are few landmarks, and between two poses of one body, there are rounds of points
/// far from all others as well: they begin with images under the map and, for the case that it is of a wrong class, with images guessed from
/// distances (`distance_guess`). Every further round takes fresh points at their images under that of the maps so far which distorts least
/// around them (`best_images`). Between poses with few landmarks the map is then refined, and gives the images of the points of further rounds.
///
/// # Errors
/// Cancellation only.
pub fn add<'a>(
    start: Start<'_>,
    owners: Owners<'a>,
    multilevel: &MultilevelOptions,
    own: &OwnConeOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let Start { full, map, .. } = start;
    if own.count == 0 || map.mean_log < own.least_mean_log {
        return Ok(None);
    }
    let Some(images) = map.images() else { return Ok(None) };
    let is_one_body = start.is_one_body.then_some(true);
    let of_poses = &own.of_poses();
    let own = if start.is_one_body { of_poses } else { own };
    let mut adding = Adding { is_one_body, ..Adding::new(start, owners, multilevel, own) };
    if start.is_one_body || full[0].landmarks.len() <= own.most_landmarks {
        adding.far_points(&images, monitor)
    } else {
        adding.at_limb_ends(&images, monitor)
    }
}

/// Adds own landmarks in the same rounds, but begins with given pairs, as ends of limbs that a matching has found, and with points at their images
/// under the map; `None` where there are no such pairs, or no map with them. A pair may be wrong, and a limb may be turned under the map, so
/// further rounds see both.
///
/// # Errors
/// Cancellation only.
pub fn add_at<'a>(
    start: Start<'_>,
    owners: Owners<'a>,
    given: &[OwnPair],
    multilevel: &MultilevelOptions,
    own: &OwnConeOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let given = apart(start.full, given);
    let mut adding = Adding::new(start, owners, multilevel, own);
    let Some(first) = adding.with_pairs(&given, adding.settled(own.search), monitor)? else {
        return Ok(None);
    };
    let mut maps = vec![first];
    if adding.may_go_on(own.finer_rounds, monitor)
        && let Some(images) = start.map.images()
    {
        maps.extend(adding.round(&images, |_| true, &own.search, monitor)?);
    }
    // The next round takes the levels of the last map.
    maps.sort_by(|a, b| b.mean_log().total_cmp(&a.mean_log()));
    let mut seen = SeenMaps::new(start.full[0].refined.mesh.vertex_count());
    maps.iter().for_each(|map| seen.extend(map.map.images()));
    let best = maps.pop();
    best.iter().for_each(|best| monitor.preview(&best.map));
    let best = adding.further_rounds(SoFar { seen, best }, monitor)?;
    adding.on_finer_levels(best, monitor)
}

/// Rounds of own landmarks, one after the other.
struct Adding<'s, 'a> {
    start: Start<'s>,
    multilevel: &'s MultilevelOptions,
    own: &'s OwnConeOptions,
    cells: Cells<'a>,
    /// The source's vertices that were own points in the round before.
    before: Vec<VertexId>,
    /// Whether patches of both meshes fit each other; `None` before they were registered.
    is_one_body: Option<bool>,
}

/// The maps of the rounds so far.
struct SoFar<'a> {
    seen: SeenMaps,
    /// The best of those that are better than the start.
    best: Option<OwnCones<'a>>,
}

/// What a round's map is searched and relaxed with.
#[derive(Clone, Copy)]
struct Effort {
    search: SearchOptions,
    relaxation: MapRelaxationOptions,
}

/// The maps that begin with own points at images guessed from distances.
#[derive(Default)]
struct Beginning<'a> {
    /// The images under the map with points at the guesses themselves.
    strained: Option<LevelImages>,
    /// The map whose points were placed by it.
    placed: Option<OwnCones<'a>>,
}

impl<'s, 'a> Adding<'s, 'a> {
    /// No round yet, on bodies whose patches were not registered.
    fn new(
        start: Start<'s>,
        owners: Owners<'a>,
        multilevel: &'s MultilevelOptions,
        own: &'s OwnConeOptions,
    ) -> Self {
        Self { start, multilevel, own, cells: owners.cells(), before: Vec::new(), is_one_body: None }
    }

    /// Whether a round may come before the last `kept` ones.
    fn may_go_on(&self, kept: usize, monitor: &mut dyn Monitor) -> bool {
        self.cells.len() > kept && !monitor.wants_result()
    }

    /// Leaves the cells of rounds that were not needed empty, but for the last ones.
    fn leave_all_but(&mut self, last: usize) {
        while self.cells.len() > last {
            self.cells.next();
        }
    }

    /// The best map with cones at ends of limbs without a landmark, where its mean log density is lower than that of the start, or hardly
    /// higher ([`WORTH`]): with all that fit, or with half as many each time, those farthest from the landmarks.
    ///
    /// Between poses of one body there are none: patches that are registered place a limb better than two vertices of coarse levels do.
    fn at_limb_ends(
        &mut self,
        present: &LevelImages,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let mut best: Option<OwnCones<'a>> = None;
        if self.start.map.is_of_poses() || !self.may_go_on(0, monitor) {
            return Ok(best);
        }
        let looking = &mut Portion::new(monitor, 0.0, 0.0);
        let mut ends = limb_ends::pairs(self.start.full, present, self.own.ends, looking)?;
        while !ends.is_empty() && self.may_go_on(0, monitor) {
            let least = best.as_ref().map_or(WORTH * self.start.map.mean_log, OwnCones::mean_log);
            let next = self.with_pairs(
                &ends,
                Effort { search: self.own.untwisted(), relaxation: self.multilevel.coarse },
                monitor,
            )?;
            if let Some(next) = next.filter(|next| next.mean_log() < least) {
                monitor.preview(&next.map);
                best = Some(next);
            }
            ends.truncate(ends.len() / 2);
        }
        Ok(best)
    }

    /// The best of the maps of rounds with points far from all others; `None` where none is better than the start, or where the first rounds
    /// give little hope of that ([`HOPEFUL`]).
    fn far_points(
        &mut self,
        images: &LevelImages,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        if !self.may_go_on(self.own.finer_rounds, monitor) {
            return Ok(None);
        }
        let begun = self.first_rounds(images, monitor)?;
        if self.start.is_one_body && self.least(&begun.best) >= HOPEFUL * self.start.map.mean_log {
            return Ok(None);
        }
        let best = self.further_rounds(begun, monitor)?;
        self.on_finer_levels(best, monitor)
    }

    /// The best map after the rounds on finer levels, which are for poses of one body alone.
    fn on_finer_levels(
        &mut self,
        best: Option<OwnCones<'a>>,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        match best {
            Some(best) if best.map.is_of_poses() && self.is_one_body != Some(false) => {
                Ok(Some(self.by_finer_levels(best, monitor)?))
            }
            best => Ok(best),
        }
    }

    /// The mean log density of the best map so far, or of the start.
    fn least(&self, best: &Option<OwnCones<'a>>) -> f64 {
        best.as_ref().map_or(self.start.map.mean_log, OwnCones::mean_log)
    }

    /// The rounds whose points have images under the present map, or images guessed from distances.
    fn first_rounds(
        &mut self,
        images: &LevelImages,
        monitor: &mut dyn Monitor,
    ) -> Result<SoFar<'a>, Cancelled> {
        let mut seen = SeenMaps::new(self.start.full[0].refined.mesh.vertex_count());
        seen.add(images.clone());
        let first = self.round(images, |_| true, &self.own.search, monitor)?;
        seen.extend(first.as_ref().and_then(|first| first.map.images()));
        let mut best = first.filter(|first| first.mean_log() < self.start.map.mean_log);
        // The class of a map with ends may be another one, and wrong: so the first round begins without it.
        if !best.as_ref().is_some_and(|first| first.map.is_of_poses()) {
            let ends = self.at_limb_ends(images, monitor)?;
            best = ends.filter(|ends| ends.mean_log() < self.least(&best)).or(best);
        }
        self.leave_all_but(self.own.all_rounds().saturating_sub(1));
        let search = self.search_after(best.as_ref(), monitor)?;
        let Beginning { strained, placed } =
            self.by_distances(images, self.least(&best), &search, monitor)?;
        seen.extend(strained);
        seen.extend(placed.as_ref().and_then(|placed| placed.map.images()));
        match placed.filter(|placed| placed.mean_log() < self.least(&best)) {
            Some(placed) => best = Some(placed),
            // The next round takes the levels of the last map.
            None => seen.extend(best.as_ref().and_then(|best| best.map.images())),
        }
        if let Some(best) = &best {
            monitor.preview(&best.map);
        }
        Ok(SoFar { seen, best })
    }

    /// The best map after further rounds, whose points have their images under the best of all maps around them.
    fn further_rounds(
        &mut self,
        so_far: SoFar<'a>,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let SoFar { mut seen, mut best } = so_far;
        let mut without_gain = usize::from(best.is_none());
        while without_gain < self.own.patience && self.may_go_on(self.own.finer_rounds, monitor) {
            without_gain += 1;
            let search = self.search_after(best.as_ref(), monitor)?;
            let Some(images) = seen.best_images() else { break };
            let Some(next) = self.round(&images, |_| true, &search, monitor)? else { continue };
            seen.extend(next.map.images());
            let (reached, least) = (next.mean_log(), self.least(&best));
            if reached >= least {
                continue;
            }
            if reached < (1.0 - self.own.least_gain) * least {
                without_gain = 0;
            }
            monitor.preview(&next.map);
            best = Some(next);
        }
        Ok(best)
    }

    /// The last of the maps, on finer levels, whose own points were placed by the map of a finer level.
    ///
    /// On the coarse level a point's image is off by about a per cent of the root of the area, and a limb may be turned a little. On finer
    /// levels patches of both bodies are registered, which turns it back; but there the own points are held, so that fresh ones are needed. There
    /// are no further ones in gaps: each that is held keeps its error.
    fn by_finer_levels(
        &mut self,
        best: OwnCones<'a>,
        monitor: &mut dyn Monitor,
    ) -> Result<OwnCones<'a>, Cancelled> {
        self.leave_all_but(self.own.finer_rounds);
        if !self.may_go_on(0, monitor) {
            return Ok(best);
        }
        let Some(mut last) = self.finer(best.clone(), self.own.finer_vertices, monitor)? else {
            return Ok(best);
        };
        monitor.preview(&last.map);
        // Patches may tell that there are two bodies; their limbs are placed well enough.
        while last.map.is_of_poses() && self.may_go_on(0, monitor) {
            let Some(images) = last.map.images() else { break };
            let points = self.own_points(&images, |_| true, self.own.count, monitor)?;
            let Some(next) = self.with_pairs(&points, self.settled(self.own.drawn_once()), monitor)? else {
                break;
            };
            let Some(next) = self.finer(next, self.own.finer_vertices, monitor)? else { break };
            if !next.map.is_of_poses() || next.mean_log() >= CREDIBLE * last.mean_log() {
                break;
            }
            monitor.preview(&next.map);
            last = next;
        }
        Ok(last)
    }

    /// The same on a level with at least this many vertices ([`OwnCones::finer`]).
    fn finer(
        &self,
        found: OwnCones<'a>,
        vertices: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        found.finer(vertices, self.multilevel, &mut Portion::new(monitor, self.done(0.0), self.done(0.0)))
    }

    /// The search of the next round. Between poses of one body twists are judged in every round, or legs stay turned.
    fn search_after(
        &mut self,
        best: Option<&OwnCones<'a>>,
        monitor: &mut dyn Monitor,
    ) -> Result<SearchOptions, Cancelled> {
        let Some(best) = best.filter(|best| best.map.is_of_poses()) else { return Ok(self.own.drawn_once()) };
        let is_one_body = match self.is_one_body {
            Some(known) => known,
            None => match self.finer(best.clone(), ONE_LEVEL, monitor)? {
                Some(finer) => *self.is_one_body.insert(finer.map.is_of_one_body()),
                None => true,
            },
        };
        Ok(if is_one_body { self.own.search } else { self.own.drawn_once() })
    }

    /// A map that begins with own points at images guessed from distances. Those are not exact, so the first map is distorted too much; it
    /// only finds the class, and a second round places the points anew by it.
    fn by_distances(
        &mut self,
        present: &LevelImages,
        least: f64,
        search: &SearchOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Beginning<'a>, Cancelled> {
        let kept = self.own.finer_rounds;
        if !self.may_go_on(kept, monitor) {
            return Ok(Beginning::default());
        }
        let quiet = &mut Portion::new(monitor, 0.0, 0.0);
        let guesses = guesses(present, self.start.full, quiet)?;
        let target = &present.levels[1].mesh;
        let image = |guess: &Guess| SurfacePoint::at_vertex(target, guess.vertex);
        let images = present.with_images(guesses.iter().map(image).collect());
        self.before.clear();
        let drawn_once = self.own.drawn_once();
        let strained = self.round(&images, |v| guesses[v].is_trusted, &drawn_once, monitor)?;
        let Some((strained, images)) = strained.and_then(|map| Some((map.mean_log(), map.map.images()?)))
        else {
            return Ok(Beginning::default());
        };
        if strained >= PROMISING * least || !self.may_go_on(kept, monitor) {
            return Ok(Beginning { strained: Some(images), placed: None });
        }
        let placed = self.round(&images, |_| true, search, monitor)?;
        Ok(Beginning { strained: Some(images), placed })
    }

    /// A map with fresh own points, of the vertices that `may` be taken, at the given images; `None` where there are none, or no map.
    fn round(
        &mut self,
        images: &LevelImages,
        may: impl Fn(VertexId) -> bool,
        search: &SearchOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let points = self.own_points(images, may, self.own.most, monitor)?;
        self.with_pairs(&points, self.settled(*search), monitor)
    }

    /// Fresh own points, of the vertices that `may` be taken, at the given images; at most `most` with those in gaps.
    fn own_points(
        &self,
        images: &LevelImages,
        may: impl Fn(VertexId) -> bool,
        most: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<OwnPair>, Cancelled> {
        let placing = &mut Portion::new(monitor, 0.0, 0.0);
        let OwnConeOptions { count, gap, .. } = *self.own;
        let choice = PointChoice { count, most, gap, may: &may };
        pairs(self.start.full, images, &self.before, choice, placing)
    }

    /// The effort of a round whose points the next round places anew.
    fn settled(&self, search: SearchOptions) -> Effort {
        let relaxation = MapRelaxationOptions { relative_decrease: SETTLED, ..self.multilevel.coarse };
        Effort { search, relaxation }
    }

    /// Progress, 0 to 1, where this share of the present round is done.
    fn done(&self, share: f64) -> f64 {
        let all = self.own.all_rounds();
        ((all - self.cells.len().min(all)) as f64 + share) / all.max(1) as f64
    }

    /// A map with these own points; `None` where there are none, or no map.
    fn with_pairs(
        &mut self,
        pairs: &[OwnPair],
        effort: Effort,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let Start { inputs, full, vertices, .. } = self.start;
        let multilevel = self.multilevel;
        let [begun, placed, chosen, done] = [0.0, 0.1, 0.8, 1.0].map(|share| self.done(share));
        let Some((full_cell, levels_cell)) = self.cells.next() else { return Ok(None) };
        let placing = &mut Portion::new(monitor, begun, placed);
        let Some(with_own) = with(inputs, full, pairs, placing)? else { return Ok(None) };
        self.before = pairs.iter().map(|pair| pair.source).collect();
        let with_own = full_cell.get_or_init(|| with_own);
        let coarsening = &mut Portion::new(monitor, placed, placed);
        let levels = mesh_with_coarse::both(with_own, vertices, multilevel.rims, coarsening)?;
        let levels = levels_cell.get_or_init(|| levels);
        // The class is looked for in every round: close maps are not compared on finer levels as well.
        let judged = &MultilevelOptions { finer: 0, ..*multilevel };
        let options =
            ClassSearchOptions { multilevel: judged, search: &effort.search, choice: ClassChoice::Best };
        let looking = Portion::new(monitor, placed, chosen);
        // Where there is no map with these points, there may be one with others.
        let best = unless_stopped(choose_class(levels, options, &mut looking.unseen()))?;
        let Some(best) = best else { return Ok(None) };
        let part = &mut Portion::new(monitor, chosen, done);
        let relaxed = MultilevelOptions { coarse: effort.relaxation, ..*multilevel };
        Ok(Some(OwnCones { full: with_own, map: finished(best.map, &relaxed, part)? }))
    }
}

/// A map with cones at ends of limbs is taken up to this many times the mean log density of the start: a coarse level hardly shows a thin
/// limb. On horse-camel, 387-394 and clicked landmarks of 385-397 it is 1 to 1.03 times as large; on the full meshes it is then lower with
/// the cones, by 1 to 6 %. The next pairs of animals have 1.08 and more.
const WORTH: f64 = 1.03;

/// Between poses with many landmarks there are further rounds where the first ones brought the mean log density below this many times that of the start.
/// Where a limb was turned they brought it to .92 and less; on a cat and two horses, whose limbs are right, to .97 to 1.
const HOPEFUL: f64 = 0.96;

/// A map whose points were placed by a finer level is taken where its mean log density there is below this many times that of the last one:
/// registered patches raise it by up to 22 % on two pairs of horses and bring the map nearer to the truth. Chosen by hand.
const CREDIBLE: f64 = 1.3;

/// A map with own points at guessed images is gone on with where its mean log density is below this many times the least. Such images are
/// inexact: on twelve pairs with 8 landmarks it was 0.9 to 1.6 times that of the other map. Of the six pairs above this limit one gained
/// by placing the points anew (12 %).
const PROMISING: f64 = 1.2;

/// Relative decrease of the energy in one step at which the relaxation of a round's map ends. With a tenth of it, as where the map of the user's
/// landmarks is relaxed, maps of twelve pairs of animals are as good, and take longer; with five times as much they are worse by 1 %.
const SETTLED: f64 = 2e-4;

/// Vertices of the level on which patches tell whether both meshes are one body: the first on which they are registered.
const ONE_LEVEL: usize = 1000;

/// The image of each vertex of the source level on the target level, guessed from distances.
fn guesses(
    present: &LevelImages,
    full: &[LandmarkedMesh; 2],
    monitor: &mut dyn Monitor,
) -> Result<TiVec<VertexId, Guess>, Cancelled> {
    let [source, target] = &present.levels;
    let landmarks = [(source, &full[0]), (target, &full[1])]
        .map(|(level, full)| level.numbers(&full.landmarks).collect());
    let [on_source, on_target]: [Vec<VertexId>; 2] = landmarks;
    distance_guess::guess([&source.mesh, &target.mesh], [&on_source, &on_target], monitor)
}

/// The chosen map, relaxed.
fn finished<'a>(
    mut map: CoarseMap<'a>,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<CoarseMap<'a>, Cancelled> {
    unless_stopped(map.finish(options, monitor))?;
    Ok(map)
}

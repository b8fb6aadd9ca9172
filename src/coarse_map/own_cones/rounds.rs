//! Rounds of own cones, one after the other: the points of each are placed by the maps before it.

use super::best_images::SeenMaps;
use super::distance_guess::{self, Guess};
use super::own_points::{PointChoice, apart, pairs, with};
use super::owners::Cells;
use super::{OwnConeInput, OwnConeOptions, OwnCones, OwnPair, Owners, Start};
use crate::coarse_map::class_search::{ClassChoice, ClassSearchOptions, choose_class};
use crate::coarse_map::multilevel::{CoarseMap, LevelImages};
use crate::coarse_map::{LandmarkedMesh, MultilevelOptions, mesh_with_coarse};
use crate::landmarks::MeshSide;
use crate::layout::SearchOptions;
use crate::mesh::{SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use crate::surface_map::relaxation::map_relaxation::MapRelaxationOptions;
use typed_index_collections::TiVec;

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
    start: &Start<'_>,
    owners: Owners<'a>,
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let mut adding = Adding::new(start, owners);
    if start.has_far_points() { adding.far_points(monitor) } else { adding.at_limb_ends(monitor) }
}

/// Adds own landmarks in the same rounds, but begins with given pairs, as ends of limbs that a matching has found, and with points at their images
/// under the map; `None` where there are no such pairs, or no map with them. A pair may be wrong, and a limb may be turned under the map, so
/// further rounds see both.
///
/// # Errors
/// Cancellation only.
pub fn add_at<'a>(
    start: &Start<'_>,
    owners: Owners<'a>,
    given: &[OwnPair],
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    Adding::new(start, owners).at_pairs(given, monitor)
}

/// Rounds of own landmarks, one after the other.
pub(super) struct Adding<'s, 'a> {
    pub(super) start: &'s Start<'s>,
    pub(super) own: &'s OwnConeOptions,
    cells: Cells<'a>,
    /// The source's vertices that were own points in the round before.
    before: Vec<VertexId>,
    /// Whether patches of both meshes fit each other; `None` before they were registered.
    pub(super) is_one_body: Option<bool>,
}

/// The maps of the rounds so far.
struct SoFar<'a> {
    seen: SeenMaps,
    /// Those that are better than the start, the best last.
    better: Vec<OwnCones<'a>>,
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
    /// No round yet.
    fn new(start: &'s Start<'s>, owners: Owners<'a>) -> Self {
        let is_one_body = start.input.is_one_body.then_some(true);
        Self { start, own: &start.own, cells: owners.cells(), before: Vec::new(), is_one_body }
    }

    /// The best map of rounds that begin with these pairs ([`add_at`]).
    fn at_pairs(
        &mut self,
        given: &[OwnPair],
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let OwnConeInput { full, .. } = self.start.input;
        let given = apart(full, given);
        let Some(first) = self.with_pairs(&given, self.settled(self.own.search), monitor)? else {
            return Ok(None);
        };
        let mut better = vec![first];
        if self.may_go_on(self.own.rounds_of_poses(), monitor) {
            better.extend(self.round(&self.start.images, &self.own.search, monitor)?);
        }
        sort(&mut better);
        // The next round takes the levels of the last map.
        let mut seen = SeenMaps::new(full[0].refined.mesh.vertex_count());
        better.iter().for_each(|map| seen.extend(map.map.images()));
        if let Some(best) = better.last() {
            best.show(monitor);
        }
        self.further_rounds(SoFar { seen, better }, monitor)
    }

    /// Whether a round may come before the last `kept` ones.
    pub(super) fn may_go_on(&self, kept: usize, monitor: &mut dyn Monitor) -> bool {
        self.cells.len() > kept && !monitor.wants_result()
    }

    /// Leaves the cells of rounds that were not needed empty, but for the last ones.
    pub(super) fn leave_all_but(&mut self, last: usize) {
        while self.cells.len() > last {
            self.cells.next();
        }
    }

    /// The best map with cones at ends of limbs without a landmark, where its mean log density is lower than that of the start, or hardly
    /// higher ([`WORTH`]): with all that fit, or with half as many each time, those farthest from the landmarks.
    ///
    /// Between poses of one body there are none: patches that are registered place a limb better than two vertices of coarse levels do.
    fn at_limb_ends(&mut self, monitor: &mut dyn Monitor) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let OwnConeInput { full, map, multilevel, .. } = self.start.input;
        let mut best: Option<OwnCones<'a>> = None;
        if map.is_of_poses() || !self.may_go_on(0, monitor) {
            return Ok(best);
        }
        let looking = &mut Portion::new(monitor, 0.0, 0.0);
        let mut ends = self.start.ends(looking)?.pairs(full, &self.start.images);
        while !ends.is_empty() && self.may_go_on(0, monitor) {
            let least = best.as_ref().map_or(WORTH * map.mean_log, OwnCones::mean_log);
            let effort = Effort { search: self.own.untwisted(), relaxation: multilevel.coarse };
            let next = self.with_pairs(&ends, effort, monitor)?;
            if let Some(next) = next.filter(|next| next.mean_log() < least) {
                next.show(monitor);
                best = Some(next);
            }
            ends.truncate(ends.len() / 2);
        }
        Ok(best)
    }

    /// The best of the maps of rounds with points far from all others; `None` where none is better than the start, or where the first rounds
    /// give little hope of that ([`HOPEFUL`]).
    fn far_points(&mut self, monitor: &mut dyn Monitor) -> Result<Option<OwnCones<'a>>, Cancelled> {
        if !self.may_go_on(self.own.rounds_of_poses(), monitor) {
            return Ok(None);
        }
        let begun = self.first_rounds(monitor)?;
        if self.start.input.is_one_body && self.least(&begun.better) >= HOPEFUL * self.start.mean_log() {
            return Ok(None);
        }
        self.further_rounds(begun, monitor)
    }

    /// The mean log density of the best of these maps, or of the start.
    fn least(&self, better: &[OwnCones<'a>]) -> f64 {
        better.last().map_or(self.start.mean_log(), OwnCones::mean_log)
    }

    /// The rounds whose points have images under the coarse map, or images guessed from distances.
    fn first_rounds(&mut self, monitor: &mut dyn Monitor) -> Result<SoFar<'a>, Cancelled> {
        let Start { input, images, .. } = self.start;
        let mut seen = SeenMaps::new(input.full[0].refined.mesh.vertex_count());
        seen.add(images.clone());
        let mut better = Vec::new();
        if let Some(first) = self.round(images, &self.own.search, monitor)? {
            seen.extend(first.map.images());
            better.extend(Some(first).filter(|first| first.mean_log() < self.start.mean_log()));
        }
        // The class of a map with ends may be another one, and wrong: so the first round begins without it.
        if !better.last().is_some_and(|first| first.map.is_of_poses()) {
            let ends = self.at_limb_ends(monitor)?;
            better.extend(ends.filter(|ends| ends.mean_log() < self.least(&better)));
        }
        self.leave_all_but(self.own.all_rounds().saturating_sub(1));
        let Beginning { strained, placed } = self.by_distances(self.least(&better), monitor)?;
        seen.extend(strained);
        if let Some(placed) = placed {
            seen.extend(placed.map.images());
            better.extend(Some(placed).filter(|placed| placed.mean_log() < self.start.mean_log()));
            sort(&mut better);
        }
        if let Some(best) = better.last() {
            // The next round takes the levels of the last map.
            seen.extend(best.map.images());
            best.show(monitor);
        }
        Ok(SoFar { seen, better })
    }

    /// The best map after further rounds, whose points have their images under the best of all maps around them; between poses of one body, the
    /// last one after rounds on finer levels.
    fn further_rounds(
        &mut self,
        so_far: SoFar<'a>,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let SoFar { mut seen, mut better } = so_far;
        let mut without_gain = usize::from(better.is_empty());
        loop {
            if let Some(finer) = self.of_one_body(better.last(), monitor)? {
                better.pop();
                return Ok(Some(self.by_finer_levels(better, finer, monitor)?));
            }
            if without_gain >= self.own.patience || !self.may_go_on(self.own.rounds_of_poses(), monitor) {
                return Ok(better.pop());
            }
            without_gain += 1;
            let Some(images) = seen.best_images() else { return Ok(better.pop()) };
            let Some(next) = self.round(&images, &self.search(), monitor)? else { continue };
            seen.extend(next.map.images());
            let (reached, least) = (next.mean_log(), self.least(&better));
            if reached >= least {
                continue;
            }
            if reached < (1.0 - self.own.least_gain) * least {
                without_gain = 0;
            }
            next.show(monitor);
            better.push(next);
        }
    }

    /// The search of the next round. Between poses of one body twists are judged in every round, or legs stay turned.
    fn search(&self) -> SearchOptions {
        if self.is_one_body == Some(true) { self.own.search } else { self.own.drawn_once() }
    }

    /// A map that begins with own points at images guessed from distances. Those are not exact, so the first map is distorted too much; it
    /// only finds the class, and a second round places the points anew by it.
    fn by_distances(&mut self, least: f64, monitor: &mut dyn Monitor) -> Result<Beginning<'a>, Cancelled> {
        let kept = self.own.rounds_of_poses();
        if !self.may_go_on(kept, monitor) {
            return Ok(Beginning::default());
        }
        let quiet = &mut Portion::new(monitor, 0.0, 0.0);
        let present = &self.start.images;
        let guesses = guesses(present, self.start.input.full, quiet)?;
        let target = &present.levels[1].mesh;
        let image = |guess: &Guess| SurfacePoint::at_vertex(target, guess.vertex);
        let images = present.with_images(guesses.iter().map(image).collect());
        self.before.clear();
        let drawn_once = self.own.drawn_once();
        let strained = self.round_among(|v| guesses[v].is_trusted, &images, &drawn_once, monitor)?;
        let Some((strained, images)) = strained.and_then(|map| Some((map.mean_log(), map.map.images()?)))
        else {
            return Ok(Beginning::default());
        };
        if strained >= PROMISING * least || !self.may_go_on(kept, monitor) {
            return Ok(Beginning { strained: Some(images), placed: None });
        }
        let placed = self.round(&images, &self.search(), monitor)?;
        Ok(Beginning { strained: Some(images), placed })
    }

    /// A map with fresh own points at the given images; `None` where there are none, or no map.
    fn round(
        &mut self,
        images: &LevelImages,
        search: &SearchOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        self.round_among(|_| true, images, search, monitor)
    }

    /// The same with points of the vertices that `may` be taken.
    pub(super) fn round_among(
        &mut self,
        may: impl Fn(VertexId) -> bool,
        images: &LevelImages,
        search: &SearchOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let points = self.own_points(images, may, monitor)?;
        self.with_pairs(&points, self.settled(*search), monitor)
    }

    /// Fresh own points, of the vertices that `may` be taken, at the given images.
    fn own_points(
        &self,
        images: &LevelImages,
        may: impl Fn(VertexId) -> bool,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<OwnPair>, Cancelled> {
        let placing = &mut Portion::new(monitor, 0.0, 0.0);
        let OwnConeOptions { count, gap, most, .. } = *self.own;
        let choice = PointChoice { count, most, gap, may: &may };
        pairs(self.start.input.full, images, &self.before, choice, placing)
    }

    /// The effort of a round whose points the next round places anew.
    fn settled(&self, search: SearchOptions) -> Effort {
        let relaxation =
            MapRelaxationOptions { relative_decrease: SETTLED, ..self.start.input.multilevel.coarse };
        Effort { search, relaxation }
    }

    /// Progress, 0 to 1, where this share of the present round is done.
    pub(super) fn done(&self, share: f64) -> f64 {
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
        let OwnConeInput { inputs, full, vertices, multilevel, .. } = self.start.input;
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

/// A map with own points at guessed images is gone on with where its mean log density is below this many times the least. Such images are
/// inexact: on twelve pairs with 8 landmarks it was 0.9 to 1.6 times that of the other map. Of the six pairs above this limit one gained
/// by placing the points anew (12 %).
const PROMISING: f64 = 1.2;

/// Relative decrease of the energy in one step at which the relaxation of a round's map ends. With a tenth of it, as where the map of the user's
/// landmarks is relaxed, maps of twelve pairs of animals are as good, and take longer; with five times as much they are worse by 1 %.
const SETTLED: f64 = 2e-4;

/// The image of each vertex of the source level on the target level, guessed from distances.
fn guesses(
    present: &LevelImages,
    full: &[LandmarkedMesh; 2],
    monitor: &mut dyn Monitor,
) -> Result<TiVec<VertexId, Guess>, Cancelled> {
    let [source, target] = &present.levels;
    let landmarks = MeshSide::BOTH.map(|side| present.landmarks_of(side, &full[side]));
    distance_guess::guess([&source.mesh, &target.mesh], landmarks, monitor)
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

/// Sorts maps, the one with the least mean log density last.
fn sort(maps: &mut [OwnCones<'_>]) {
    maps.sort_by(|a, b| b.mean_log().total_cmp(&a.mean_log()));
}

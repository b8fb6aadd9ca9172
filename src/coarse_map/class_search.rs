//! The choice of the map's isotopy class: layouts of different classes are judged by their coarse maps.

use super::error::CoarseMapError;
use super::mesh_with_coarse::{MeshWithCoarse, coarse_landmarks};
use super::multilevel::{CoarseMap, solve_coarse};
use super::options::MultilevelOptions;
use crate::layout::{self, Candidate, Candidates, LayoutError, SearchOptions, SearchReport};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use crate::surface_map::MapError;
use serde::{Deserialize, Serialize};

/// The class of maps that is taken where several are close.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum ClassChoice {
    /// The class of least mean log density.
    #[default]
    Best,
    /// The next best class, where one is close.
    RunnerUp,
}

/// Options of the choice of the class.
#[derive(Clone, Copy, Debug)]
pub struct ClassSearchOptions<'a> {
    /// Options by which coarse maps are made, judged and relaxed.
    pub multilevel: &'a MultilevelOptions,
    /// Options of the search for layouts.
    pub search: &'a SearchOptions,
    /// The class that is taken where several are close.
    pub choice: ClassChoice,
}

/// The class that was chosen with its coarse map, judged but not yet relaxed to the end.
pub struct Chosen<'a> {
    /// Its layout, drawn on the coarse levels.
    pub candidate: Candidate,
    /// The layouts that were judged.
    pub search: SearchReport,
    /// The coarse map.
    pub map: CoarseMap<'a>,
}

/// Chooses the class whose coarse map has the least mean log density, among layouts drawn on both coarse levels.
///
/// The best maps of the first judgement are relaxed further before one is taken, then its own twists are judged, and where several
/// are still as good they are compared on finer levels, whose smaller triangles distort less.
///
/// # Errors
/// [`CoarseMapError::Layout`] where no layout has a map, [`CoarseMapError::Cancelled`].
pub fn choose_class<'a>(
    levels: &'a [MeshWithCoarse<'a>; 2],
    options: ClassSearchOptions<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Chosen<'a>, CoarseMapError> {
    let landmarks = coarse_landmarks(levels);
    let meshes = [&levels[0].coarse.mesh, &levels[1].coarse.mesh];
    let candidates = Candidates::new(meshes, &landmarks, &mut Portion::new(monitor, 0.0, 0.0))?;
    let mut candidates = candidates.with_descent_patience(options.search.descent_patience);
    let mut finalists = Finalists {
        levels,
        options: options.multilevel,
        maps: Vec::new(),
        judged: 0,
        blame: vec![0.0; landmarks.len()],
    };
    let mut judge = |candidate: &Candidate, monitor: &mut dyn Monitor| finalists.judge(candidate, monitor);
    let looking = &mut Portion::new(monitor, 0.0, SEARCHED);
    let searched = layout::search(&mut candidates, &mut judge, options.search, looking);
    let (_, mut search) = searched.map_err(|error| match error {
        LayoutError::NoMap { layouts, .. } => {
            LayoutError::NoMap { layouts, near: layout::worst(&finalists.blame) }
        }
        other => other,
    })?;
    let mut explored = vec![search.best];
    for round in 0..MOST_WINNERS {
        let share = |done: f64| SEARCHED + (DECIDED - SEARCHED) * (round as f64 + done) / MOST_WINNERS as f64;
        let winner = finalists.decide(&mut Portion::new(monitor, share(0.0), share(0.5)))?;
        if explored.contains(&winner) || monitor.wants_result() {
            break;
        }
        explored.push(winner);
        let around = finalists.maps[0].candidate.clone();
        let mut judge =
            |candidate: &Candidate, monitor: &mut dyn Monitor| finalists.judge(candidate, monitor);
        let near = &mut Portion::new(monitor, share(0.5), share(1.0));
        let more = layout::neighbours(&mut candidates, &around, &mut judge, options.search, near)?;
        search.judged.extend(more);
    }
    search.rival = finalists.compare_finer(&mut Portion::new(monitor, DECIDED, 1.0))?;
    if options.choice == ClassChoice::RunnerUp && finalists.maps.len() > 1 {
        finalists.maps.swap(0, 1);
        search.rival = search.rival.map(|rival| 1.0 / rival);
    }
    for finalist in &finalists.maps {
        search.judged[finalist.number].mean_log = Some(finalist.map.mean_log);
    }
    let best =
        finalists.maps.into_iter().next().ok_or(LayoutError::NoMap { layouts: 0, near: Vec::new() })?;
    search.best = best.number;
    Ok(Chosen { candidate: best.candidate, search, map: best.map })
}

/// Progress of the search, 0 to 1, once all layouts have been judged. Chosen by hand, for display only.
const SEARCHED: f64 = 0.7;
/// Progress of the search once the winner is known but for finer levels.
const DECIDED: f64 = 0.9;

/// Winners whose twists are judged, at most: a bound on the time. Chosen by hand.
const MOST_WINNERS: usize = 4;

/// One of the best maps of a search.
struct Finalist<'a> {
    /// Its number among the judged layouts.
    number: usize,
    candidate: Candidate,
    map: CoarseMap<'a>,
    /// Mean log density of the first judgement.
    first_look: f64,
    is_relaxed: bool,
}

/// The best maps so far, the best first.
struct Finalists<'a, 'o> {
    levels: &'a [MeshWithCoarse<'a>; 2],
    options: &'o MultilevelOptions,
    maps: Vec<Finalist<'a>>,
    judged: usize,
    /// The number of layouts that have no map because of each landmark.
    blame: Vec<f64>,
}

impl Finalists<'_, '_> {
    /// Judges a layout by its coarse map after one round of relaxation; `None` where it has no map.
    fn judge(&mut self, candidate: &Candidate, monitor: &mut dyn Monitor) -> Result<Option<f64>, Cancelled> {
        let number = self.judged;
        self.judged += 1;
        match solve_coarse(self.levels, &candidate.layout, self.options, monitor) {
            // A map without an overlay has no energy to lower.
            Ok(map) if !map.mean_log.is_finite() => Ok(None),
            Ok(map) => {
                let first_look = map.mean_log;
                let candidate = candidate.clone();
                self.maps.push(Finalist { number, candidate, map, first_look, is_relaxed: false });
                self.maps.sort_by(|a, b| a.first_look.total_cmp(&b.first_look));
                self.maps.truncate(self.options.finalists);
                if let Some(best) = self.maps.first().filter(|best| best.number == number) {
                    monitor.preview(&best.map);
                }
                Ok(Some(first_look))
            }
            Err(MapError::Cancelled(stop)) => Err(stop),
            Err(MapError::LayoutPoints { near, .. }) => {
                near.into_iter().for_each(|landmark| self.blame[landmark] += 1.0);
                Ok(None)
            }
            Err(_) => Ok(None),
        }
    }

    /// Relaxes the maps that are close to the best after the first judgement further, and sorts them. Returns the number of the best.
    fn decide(&mut self, monitor: &mut dyn Monitor) -> Result<usize, CoarseMapError> {
        let least = self.maps.iter().map(|map| map.first_look).fold(f64::INFINITY, f64::min);
        self.maps.retain(|map| map.first_look <= self.options.close * least);
        if self.maps.len() > 1 && !monitor.wants_result() {
            for finalist in self.maps.iter_mut().filter(|map| !map.is_relaxed) {
                finalist.map.relax(&self.options.decide, monitor)?;
                finalist.is_relaxed = true;
            }
        }
        self.sort();
        self.maps
            .first()
            .map(|map| map.number)
            .ok_or(LayoutError::NoMap { layouts: 0, near: Vec::new() }.into())
    }

    /// Compares the maps that are nearly as good as the best on finer levels, and sorts them. Returns the mean log density of the
    /// next best relative to the best, on the finest level on which both were judged; `None` where no other is close.
    ///
    /// Only copies are refined: the map that is chosen goes on from its coarse level.
    fn compare_finer(&mut self, monitor: &mut dyn Monitor) -> Result<Option<f64>, CoarseMapError> {
        let is_close = |mean_log: f64, least: f64| mean_log <= self.options.undecided * least;
        let least = self.maps.first().map_or(0.0, |best| best.map.mean_log);
        let close = self.maps.iter().filter(|finalist| is_close(finalist.map.mean_log, least));
        let mut rivals: Vec<(usize, CoarseMap<'_>)> = close.map(|f| (f.number, f.map.clone())).collect();
        let (mut ratio, mut order) = (None, Vec::new());
        for _ in 0..self.options.finer {
            if rivals.len() < 2 || monitor.wants_result() {
                break;
            }
            for (_, map) in &mut rivals {
                match unless_stopped(map.judge_finer(self.options, monitor))? {
                    Some(true) => {}
                    Some(false) => return Ok(None),
                    // A vertex found no place: this map loses to the others.
                    None => map.mean_log = f64::INFINITY,
                }
            }
            rivals.sort_by(|a, b| a.1.mean_log.total_cmp(&b.1.mean_log));
            let least = rivals[0].1.mean_log;
            ratio = Some(rivals[1].1.mean_log / least).filter(|ratio| ratio.is_finite());
            order = rivals.iter().map(|rival| rival.0).collect();
            rivals.retain(|(_, map)| is_close(map.mean_log, least));
        }
        let place = |finalist: &Finalist<'_>| order.iter().position(|number| *number == finalist.number);
        // Stable: those that were not compared keep their order.
        self.maps.sort_by_key(|finalist| place(finalist).unwrap_or(usize::MAX));
        Ok(ratio)
    }

    fn sort(&mut self) {
        self.maps.sort_by(|a, b| a.map.mean_log.total_cmp(&b.map.mean_log));
    }
}

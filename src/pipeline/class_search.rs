//! The class of the map: layouts of different isotopy classes, each judged by the coarse map that it leads to.

use super::PipelineError;
use crate::layout::{self, Candidate, Candidates, LayoutError, SearchOptions, SearchReport};
use crate::monitor::{Cancelled, Monitor};
use crate::surface_map::MapError;
use crate::surface_map::multilevel::{CoarseMap, MultilevelOptions, Side, coarse_landmarks, solve_coarse};

/// The class that was chosen with its coarse map, judged but not yet relaxed to the end.
pub struct Chosen<'a> {
    /// Its layout, drawn on the coarse levels.
    pub candidate: Candidate,
    /// What was judged.
    pub search: SearchReport,
    /// The coarse map.
    pub map: CoarseMap<'a>,
}

/// The class whose coarse map has the least mean log density, among layouts planned on both coarse levels.
///
/// The best after a first look are relaxed further before one is taken, its own twists are judged, and where several are
/// still as good they are compared on finer levels, whose triangles distort less by their size.
///
/// # Errors
/// [`PipelineError::Layout`] where no layout has a map, [`PipelineError::Cancelled`].
pub fn choose_class<'a>(
    sides: &'a [Side<'a>; 2],
    (options, search_options): (&MultilevelOptions, &SearchOptions),
    monitor: &mut dyn Monitor,
) -> Result<Chosen<'a>, PipelineError> {
    let landmarks = coarse_landmarks(sides);
    let meshes = [&sides[0].coarse.mesh, &sides[1].coarse.mesh];
    let mut candidates = Candidates::new(meshes, &landmarks);
    let mut finalists = Finalists { sides, options, maps: Vec::new(), judged: 0 };
    let mut judge = |candidate: &Candidate, monitor: &mut dyn Monitor| finalists.judge(candidate, monitor);
    let (_, mut search) = layout::search(&mut candidates, &mut judge, search_options, monitor)?;
    let mut explored = vec![search.best];
    loop {
        let winner = finalists.decide(monitor)?;
        if explored.contains(&winner) || monitor.wants_result() {
            break;
        }
        explored.push(winner);
        let around = finalists.maps[0].candidate.clone();
        let mut judge =
            |candidate: &Candidate, monitor: &mut dyn Monitor| finalists.judge(candidate, monitor);
        let more = layout::neighbours((&mut candidates, &around), &mut judge, search_options, monitor)?;
        search.judged.extend(more);
    }
    finalists.compare_finer(monitor)?;
    for finalist in &finalists.maps {
        search.judged[finalist.number].mean_log = Some(finalist.map.mean_log);
    }
    let best = finalists.maps.into_iter().next().ok_or(LayoutError::NoMap { layouts: 0 })?;
    search.best = best.number;
    Ok(Chosen { candidate: best.candidate, search, map: best.map })
}

/// One of the best maps of a search.
struct Finalist<'a> {
    /// Among the judged layouts.
    number: usize,
    candidate: Candidate,
    map: CoarseMap<'a>,
    /// Mean log density after the first look.
    first_look: f64,
    is_relaxed: bool,
}

/// The best maps so far, the best first.
struct Finalists<'a, 'o> {
    sides: &'a [Side<'a>; 2],
    options: &'o MultilevelOptions,
    maps: Vec<Finalist<'a>>,
    judged: usize,
}

impl Finalists<'_, '_> {
    /// Judges a layout by a first look at its map.
    fn judge(&mut self, candidate: &Candidate, monitor: &mut dyn Monitor) -> Result<Option<f64>, Cancelled> {
        let number = self.judged;
        self.judged += 1;
        match solve_coarse(self.sides, &candidate.layout, (self.options, monitor)) {
            Ok(map) => {
                let first_look = map.mean_log;
                let candidate = candidate.clone();
                self.maps.push(Finalist { number, candidate, map, first_look, is_relaxed: false });
                self.maps.sort_by(|a, b| a.first_look.total_cmp(&b.first_look));
                self.maps.truncate(self.options.finalists);
                Ok(Some(first_look))
            }
            Err(MapError::Cancelled(stop)) => Err(stop),
            Err(_) => Ok(None),
        }
    }

    /// Relaxes those further that are close after the first look, and puts the best first; its number.
    fn decide(&mut self, monitor: &mut dyn Monitor) -> Result<usize, PipelineError> {
        let least = self.maps.iter().map(|map| map.first_look).fold(f64::INFINITY, f64::min);
        self.maps.retain(|map| map.first_look <= self.options.close * least);
        if self.maps.len() > 1 && !monitor.wants_result() {
            for finalist in self.maps.iter_mut().filter(|map| !map.is_relaxed) {
                finalist.map.relax((&self.options.decide, &mut *monitor))?;
                finalist.is_relaxed = true;
            }
        }
        self.sort();
        self.maps.first().map(|map| map.number).ok_or(LayoutError::NoMap { layouts: 0 }.into())
    }

    /// Compares those that are as good as the best on finer levels and puts the best first. Only copies are refined: the map
    /// that is chosen goes on from its coarse level.
    fn compare_finer(&mut self, monitor: &mut dyn Monitor) -> Result<(), PipelineError> {
        let is_close = |mean_log: f64, least: f64| mean_log <= self.options.undecided * least;
        let least = self.maps.first().map_or(0.0, |best| best.map.mean_log);
        let close = self.maps.iter().filter(|finalist| is_close(finalist.map.mean_log, least));
        let mut rivals: Vec<(usize, CoarseMap<'_>)> = close.map(|f| (f.number, f.map.clone())).collect();
        for _ in 0..self.options.finer {
            if rivals.len() < 2 || monitor.wants_result() {
                break;
            }
            for (_, map) in &mut rivals {
                match map.judge_finer((self.options, &mut *monitor)) {
                    Ok(true) => {}
                    Ok(false) => return Ok(()),
                    Err(MapError::Cancelled(stop)) => return Err(stop.into()),
                    // A vertex without a place: the others do better.
                    Err(_) => map.mean_log = f64::INFINITY,
                }
            }
            rivals.sort_by(|a, b| a.1.mean_log.total_cmp(&b.1.mean_log));
            let least = rivals[0].1.mean_log;
            rivals.retain(|(_, map)| is_close(map.mean_log, least));
        }
        if let Some(best) = rivals.first().and_then(|best| self.maps.iter().position(|f| f.number == best.0))
        {
            self.maps[..=best].rotate_right(1);
        }
        Ok(())
    }

    fn sort(&mut self) {
        self.maps.sort_by(|a, b| a.map.mean_log.total_cmp(&b.map.mean_log));
    }
}

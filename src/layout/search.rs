//! The search for the isotopy class: candidates are judged by the distortion of their maps, then twists of the best.
//!
//! The judge is the mean logarithm of the distortion density, not the energy: that is 4 for every conformal map, and tells
//! little about which of several ways round a limb is the right one.

use super::candidates::{Candidate, Candidates};
use super::descent::MOST_DRAWINGS;
use super::error::LayoutError;
use crate::monitor::{Cancelled, Monitor, Portion, Step};

/// Limits of the search for the class of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchOptions {
    /// Layouts from different orders of drawing that are judged, at most.
    pub candidates: usize,
    /// Such layouts that are judged until one has a map, where that is more than `candidates`.
    pub until_mapped: usize,
    /// Twists of one drawing that a descent to straighter ones tries, at most, the most promising first.
    pub descent_patience: usize,
    /// A layout with at most this detour ([`super::LayoutReport::detour`]) and at most `clear_mean_log` is clear: no other order
    /// is judged, and of its twists only the ambiguous ones.
    pub clear_detour: f64,
    /// The largest mean log density of a clear layout; see `clear_detour`.
    pub clear_mean_log: f64,
    /// Stops either part of the search after this many layouts without a gain.
    pub patience: usize,
    /// Twisted layouts that are judged, at most.
    pub twists: usize,
    /// A twist is considered when the path that goes round is at most this many times the one that it replaces.
    pub twist_ratio: f64,
    /// The same bound for clear layouts: with a ratio near 1 both ways round are plausible.
    pub ambiguous_ratio: f64,
    /// The least relative decrease of the mean log density for which a layout is changed.
    pub least_gain: f64,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self {
            // The counts bound the time of a run, since each layout costs a coarse map. All of them were chosen by hand;
            // `cargo xtask survey classes` compares the class that is found with all its twists.
            candidates: 8,
            until_mapped: 1,
            descent_patience: MOST_DRAWINGS,
            clear_detour: 0.1,
            clear_mean_log: 0.14,
            patience: 4,
            twists: 12,
            twist_ratio: 2.5,
            ambiguous_ratio: 1.2,
            least_gain: 0.01,
        }
    }
}

/// The origin of a judged layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Another order of drawing.
    Order,
    /// A twist of the best layout so far.
    Twist,
}

/// A layout that was judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Whether it is another order of drawing or a twist.
    pub origin: Origin,
    /// Its detour ([`super::LayoutReport::detour`]).
    pub detour: f64,
    /// The largest length / shortest length of its paths.
    pub worst_stretch: f64,
    /// The mean log density of its map, 0 for an isometry; `None` where no map was found.
    pub mean_log: Option<f64>,
}

/// The layouts that a search judged, and the one that it chose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SearchReport {
    /// All judged layouts in their order; each is of another isotopy class.
    pub judged: Vec<Judged>,
    /// The number of the layout that is returned, in `judged`.
    pub best: usize,
    /// Twists that were made one after the other.
    pub twists_made: usize,
    /// Mean log density of the best other class divided by that of the class that is returned, on the finest level on which both were
    /// judged; may be below 1 where the caller asked for the runner-up. `None` where no other class is close.
    pub rival: Option<f64>,
}

impl SearchReport {
    /// The mean log density of the layout returned.
    pub fn mean_log(&self) -> Option<f64> {
        self.judged.get(self.best)?.mean_log
    }

    /// The least mean log density of the other classes.
    pub fn runner_up(&self) -> Option<f64> {
        let others = self.judged.iter().enumerate().filter(|(k, _)| *k != self.best);
        others.filter_map(|(_, judged)| judged.mean_log).min_by(f64::total_cmp)
    }
}

/// Finds the layout whose map has the least mean log density.
///
/// `judge` answers with that of a (coarse) map of a layout, 0 for an isometry, or `None` where it finds no map. The
/// candidates are judged in their order until the answer is clear or nothing is gained; then twists of the best, as long as
/// they lower it. A monitor that wants a result gets the best map so far, or the first.
///
/// # Errors
/// [`LayoutError::Cancelled`]; the last error of drawing when nothing could be drawn; [`LayoutError::NoMap`] when no layout
/// has a map.
pub fn search(
    candidates: &mut Candidates<'_>,
    judge: &mut Judge<'_>,
    options: &SearchOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Candidate, SearchReport), LayoutError> {
    let mut search = Search { judge, options, monitor, best: None, report: SearchReport::default() };
    search.orders(candidates)?;
    search.twists(candidates)?;
    let Search { best, report, .. } = search;
    match best {
        Some((_, candidate)) => Ok((candidate, report)),
        None if report.judged.is_empty() => Err(candidates.failure().cloned().unwrap_or(NOTHING)),
        None => Err(LayoutError::NoMap { layouts: report.judged.len(), near: Vec::new() }),
    }
}

/// Lowers the mean log density of a given layout's map by twists alone; the layout itself need not have a map.
///
/// `candidates` must be of the meshes and landmarks of `start`.
///
/// # Errors
/// As [`search()`].
pub fn untwist(
    candidates: &mut Candidates<'_>,
    start: Candidate,
    judge: &mut Judge<'_>,
    options: &SearchOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Candidate, SearchReport), LayoutError> {
    let mut search = Search { judge, options, monitor, best: None, report: SearchReport::default() };
    // A start without a map has neighbours all the same.
    search.best = Some((f64::INFINITY, start.clone()));
    search.judge(start, Origin::Order)?;
    search.twists(candidates)?;
    let Search { best, report, .. } = search;
    match best {
        Some((mean_log, candidate)) if mean_log.is_finite() => Ok((candidate, report)),
        _ => Err(LayoutError::NoMap { layouts: report.judged.len(), near: Vec::new() }),
    }
}

/// Judges the twists of a layout, the straightest first, until nothing is gained over the best of them.
///
/// # Errors
/// [`LayoutError::Cancelled`].
pub fn neighbours(
    candidates: &mut Candidates<'_>,
    of: &Candidate,
    judge: &mut Judge<'_>,
    options: &SearchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Judged>, LayoutError> {
    let mut search = Search { judge, options, monitor, best: None, report: SearchReport::default() };
    let mut without_gain = 0;
    let limit = of.layout.report.detour + HOPELESS;
    for candidate in candidates.twists(of, options.twists, options.twist_ratio, &mut search.between())? {
        if candidate.layout.report.detour > limit {
            break;
        }
        let better = search.judge(candidate, Origin::Twist)?;
        without_gain = if better { 0 } else { without_gain + 1 };
        if without_gain >= options.patience || search.monitor.wants_result() {
            break;
        }
    }
    Ok(search.report.judged)
}

/// The mean log density of a layout's map; `None` where there is no map.
pub type Judge<'a> = dyn FnMut(&Candidate, &mut dyn Monitor) -> Result<Option<f64>, Cancelled> + 'a;

/// A layout whose detour ([`super::LayoutReport::detour`]) exceeds the best one's by more than this is not judged: its paths wind. In 50
/// searches on ten pairs no layout that was better had 0.6 more than the best before it, where that was straight; with a limit of 4 the
/// paths of half of the judged layouts wound.
const HOPELESS: f64 = 1.0;

/// Vertices of the refined meshes of layouts that were judged, for each vertex of the meshes, after which a search without any map
/// ends. Eight usual layouts have 20 to 30; those that wind have more, and take more time each.
const MOST_UNMAPPED: usize = 40;

/// The error where no layout could be drawn and none failed.
const NOTHING: LayoutError = LayoutError::NoMap { layouts: 0, near: Vec::new() };

struct Search<'a, 'j> {
    judge: &'a mut Judge<'j>,
    options: &'a SearchOptions,
    monitor: &'a mut dyn Monitor,
    best: Option<(f64, Candidate)>,
    report: SearchReport,
}

impl Search<'_, '_> {
    fn orders(&mut self, candidates: &mut Candidates<'_>) -> Result<(), LayoutError> {
        let (mut without_gain, mut unmapped) = (0, 0);
        while self.report.judged.len() < self.most_orders() && without_gain < self.options.patience {
            if self.best.is_some() && !candidates.is_promising() {
                break;
            }
            let Some(candidate) = candidates.next(&mut self.between())? else { break };
            if self.is_hopeless(&candidate) {
                break;
            }
            let found_before = self.best.is_some();
            let size = candidate.size();
            let better = self.judge(candidate.clone(), Origin::Order)?;
            if self.report.judged.last().is_some_and(|judged| judged.mean_log.is_none()) {
                candidates.without_map(&candidate);
            }
            without_gain = if better || !found_before { 0 } else { without_gain + 1 };
            unmapped += size;
            let is_vain = self.best.is_none() && unmapped > MOST_UNMAPPED * candidates.size();
            if self.is_clear() || self.must_end() || is_vain {
                break;
            }
        }
        Ok(())
    }

    /// The number of layouts from different orders of drawing that are judged, at most.
    fn most_orders(&self) -> usize {
        let most = self.options.candidates;
        if self.best.is_none() { most.max(self.options.until_mapped) } else { most }
    }

    fn twists(&mut self, candidates: &mut Candidates<'_>) -> Result<(), LayoutError> {
        let mut left = self.options.twists;
        let mut without_gain = 0;
        while left > 0 && !self.must_end() {
            let Some((_, best)) = &self.best else { return Ok(()) };
            let SearchOptions { twist_ratio, ambiguous_ratio, .. } = *self.options;
            let ratio = if self.is_clear() { ambiguous_ratio } else { twist_ratio };
            let best = best.clone();
            let around = candidates.twists(&best, left, ratio, &mut self.between())?;
            let mut better = false;
            for candidate in around {
                if self.is_hopeless(&candidate) {
                    break;
                }
                left -= 1;
                if self.judge(candidate, Origin::Twist)? {
                    self.report.twists_made += 1;
                    better = true;
                    without_gain = 0;
                    break;
                }
                without_gain += 1;
                if without_gain >= self.options.patience || self.must_end() {
                    break;
                }
            }
            if !better {
                return Ok(());
            }
        }
        Ok(())
    }

    /// Judges a candidate and keeps it where it is the best; returns whether it gains at least `least_gain` over the best before.
    fn judge(&mut self, candidate: Candidate, origin: Origin) -> Result<bool, LayoutError> {
        let residual = self.best.as_ref().map(|best| best.0);
        let (from, to) = (self.share(0), self.share(1));
        let mut portion = Portion::new(self.monitor, from, to);
        portion.step(Step { fraction: 0.0, residual })?;
        let mean_log = (self.judge)(&candidate, &mut portion)?;
        let super::LayoutReport { detour, worst_stretch, .. } = candidate.layout.report;
        self.report.judged.push(Judged { origin, detour, worst_stretch, mean_log });
        let least = self.best.as_ref().map_or(f64::INFINITY, |best| best.0);
        let needed = match origin {
            Origin::Order => least,
            Origin::Twist => least * (1.0 - self.options.least_gain),
        };
        let Some(mean_log) = mean_log.filter(|mean_log| *mean_log < needed) else { return Ok(false) };
        let gain = mean_log <= least * (1.0 - self.options.least_gain);
        self.report.best = self.report.judged.len() - 1;
        self.best = Some((mean_log, candidate));
        Ok(gain)
    }

    /// The share of all layouts, 0 to 1, that is judged once `more` further ones are.
    fn share(&self, more: usize) -> f64 {
        let SearchOptions { candidates, until_mapped, twists, .. } = *self.options;
        let most = candidates.max(until_mapped) + twists;
        (self.report.judged.len() + more) as f64 / most.max(1) as f64
    }

    /// A portion of the progress without length, for the work between two layouts.
    fn between(&mut self) -> Portion<'_> {
        let share = self.share(0);
        Portion::new(self.monitor, share, share)
    }

    /// Whether a result is wanted now, and there is one.
    fn must_end(&self) -> bool {
        self.monitor.wants_result() && self.best.as_ref().is_some_and(|best| best.0.is_finite())
    }

    /// Whether a layout's detours are too long, compared with the best layout's, for it to be judged.
    fn is_hopeless(&self, candidate: &Candidate) -> bool {
        let detour = candidate.layout.report.detour;
        self.best.as_ref().is_some_and(|(mean_log, best)| {
            mean_log.is_finite() && detour > best.layout.report.detour + HOPELESS
        })
    }

    fn is_clear(&self) -> bool {
        self.best.as_ref().is_some_and(|(mean_log, candidate)| {
            *mean_log <= self.options.clear_mean_log
                && candidate.layout.report.detour <= self.options.clear_detour
        })
    }
}

//! Rounds of own cones between two poses of one body, whose points are placed by maps of finer levels.
//!
//! On the coarse level a point's image is off by about a per cent of the root of the area, and a limb may be turned. On finer levels patches of
//! both bodies are registered, which turns it back; but there the own points are held, so that fresh ones are needed.

use super::best_images::{SeenMaps, mean_log_around};
use super::rounds::Adding;
use super::{OwnConeOptions, OwnCones};
use crate::coarse_map::multilevel::LevelImages;
use crate::monitor::{Cancelled, Monitor, Portion};

/// Rounds whose points are placed by maps of one finer level.
struct FinerRounds {
    /// Least number of vertices of that level.
    vertices: usize,
    /// The cells that later rounds need.
    kept: usize,
}

impl<'a> Adding<'_, 'a> {
    /// The best map on the first level on which patches are registered, where they tell that it is between two poses of one body; `None` where
    /// there are no rounds on finer levels.
    pub(super) fn of_one_body(
        &mut self,
        best: Option<&OwnCones<'a>>,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let Some(best) = best.filter(|best| best.map.is_of_poses()) else { return Ok(None) };
        if self.is_one_body.is_some() || !self.may_go_on(0, monitor) {
            return Ok(None);
        }
        let finer = self.finer(best.clone(), ONE_LEVEL, monitor)?;
        let is_one_body = finer.as_ref().is_none_or(|finer| finer.map.is_of_one_body());
        self.is_one_body = Some(is_one_body);
        Ok(finer.filter(|_| is_one_body))
    }

    /// The best of the maps on finer levels: first on the level of `best` and of the `others`, coarse maps that began in other ways, then on one with
    /// more vertices.
    pub(super) fn by_finer_levels(
        &mut self,
        others: Vec<OwnCones<'a>>,
        best: OwnCones<'a>,
        monitor: &mut dyn Monitor,
    ) -> Result<OwnCones<'a>, Cancelled> {
        let OwnConeOptions { finer_rounds, finer_vertices, .. } = *self.own;
        self.leave_all_but(self.own.rounds_of_poses());
        let (mut best, mut beside) = (best, Vec::new());
        for other in others.into_iter().filter(|other| other.map.is_of_poses()) {
            let Some(mut other) = self.finer(other, ONE_LEVEL, monitor)? else { continue };
            if other.mean_log() < best.mean_log() {
                std::mem::swap(&mut other, &mut best);
            }
            beside.push(other);
        }
        let first = FinerRounds { vertices: ONE_LEVEL, kept: finer_rounds };
        let placed = self.rounds_on(&first, best, &beside, monitor)?;
        self.leave_all_but(finer_rounds);
        if !self.may_go_on(0, monitor) {
            return Ok(placed);
        }
        let Some(finer) = self.finer(placed.clone(), finer_vertices, monitor)? else { return Ok(placed) };
        let last = FinerRounds { vertices: finer_vertices, kept: 0 };
        self.rounds_on(&last, finer, &[], monitor)
    }

    /// The last of maps on one finer level whose points are placed by those before them, at each vertex by the one that distorts least around it; an
    /// earlier one where that distorts less than it where they differ: a round may turn a leg again.
    fn rounds_on(
        &mut self,
        rounds: &FinerRounds,
        best: OwnCones<'a>,
        beside: &[OwnCones<'a>],
        monitor: &mut dyn Monitor,
    ) -> Result<OwnCones<'a>, Cancelled> {
        let mut seen = SeenMaps::new(self.start.input.full[0].refined.mesh.vertex_count());
        beside.iter().for_each(|map| seen.extend(map.map.images()));
        let begun = seen.count();
        let (mut last, mut before) = (best, Vec::new());
        while let Some(images) = last.map.images() {
            last.show(monitor);
            seen.add(images);
            let Some(images) = seen.best_images() else { break };
            let Some(next) = self.round_on(rounds, &last, &images, monitor)? else { break };
            before.push(std::mem::replace(&mut last, next));
        }
        Ok(match seen.last_good(begun).map(|k| k - begun) {
            Some(k) if k < before.len() => before.swap_remove(k),
            _ => last,
        })
    }

    /// The next map on a finer level, with points at these images but where they distort much ([`TRUSTED`]); `None` where there is none, or where
    /// it is not credible ([`CREDIBLE`]).
    fn round_on(
        &mut self,
        rounds: &FinerRounds,
        last: &OwnCones<'a>,
        images: &LevelImages,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        // Patches may tell that there are two bodies; their limbs are placed well enough.
        if !last.map.is_of_poses() || !self.may_go_on(rounds.kept, monitor) {
            return Ok(None);
        }
        let around = mean_log_around(images);
        let search = self.own.drawn_once();
        let next = self.round_among(|v| around[v] < TRUSTED, images, &search, monitor)?;
        let Some(next) = next else { return Ok(None) };
        let next = self.finer(next, rounds.vertices, monitor)?;
        let is_credible =
            |next: &OwnCones<'_>| next.map.is_of_poses() && next.mean_log() < CREDIBLE * last.mean_log();
        Ok(next.filter(is_credible))
    }

    /// The same on a level with at least this many vertices ([`OwnCones::finer`]).
    fn finer(
        &self,
        found: OwnCones<'a>,
        vertices: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<OwnCones<'a>>, Cancelled> {
        let quiet = &mut Portion::new(monitor, self.done(0.0), self.done(0.0));
        found.finer(vertices, self.start.input.multilevel, quiet)
    }
}

/// A map whose points were placed by a finer level is taken where its mean log density there is below this many times that of the last one:
/// registered patches raise it by up to 22 % on two pairs of horses and bring the map nearer to the truth. Chosen by hand.
const CREDIBLE: f64 = 1.3;

/// Own points are placed on a finer level where the mean log density around them is below this. Where a limb is turned or has slid along it is
/// .5 and more, at bent joints as well; elsewhere between poses .05 to .3. A point that is held there holds a limb where it is. With .35 one of
/// fourteen maps had a leg turned that others had not, without a limit the maps of a cat were farther from the truth by a third.
const TRUSTED: f64 = 0.45;

/// Vertices of the level on which patches tell whether both meshes are one body: the first on which they are registered.
const ONE_LEVEL: usize = 1000;

//! Layouts of one pair of meshes, one of each isotopy class, the most promising first.

use super::base_layout::{BaseLayout, LayoutReport};
use super::bounds::{Bounds, MOST_DISTANCES};
use super::descent;
use super::drawing::{Drawing, Planner};
use super::error::LayoutError;
use super::isotopy::Class;
use super::joint::{self, Ground};
use super::landmark_distances::LandmarkDistances;
use super::patches;
use super::twists::{self, Twist};
use super::variants::{STARTS, Variant};
use crate::landmarks::Landmarks;
use crate::mesh::SurfaceMesh;
use crate::monitor::{Monitor, Step};

/// With a detour above this, all starts are drawn: of 50 searches on ten pairs the layouts of the best classes had less, and those
/// that missed theirs more.
const STRAIGHT: f64 = 0.4;
/// Starts after which drawing ends where all of them have wound.
const TANGLED: usize = 4;

/// A layout that can be judged, and turned into its neighbours.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The layout.
    pub layout: BaseLayout,
    drawing: Drawing,
}

impl Candidate {
    /// Vertices of both refined meshes.
    pub(super) fn size(&self) -> usize {
        self.layout.source.mesh.vertex_count() + self.layout.target.mesh.vertex_count()
    }

    #[cfg(test)]
    pub(super) fn drawing(&self) -> &Drawing {
        &self.drawing
    }
}

/// Draws layouts of one pair of meshes in many ways and leaves out those of a class already given.
///
/// What does not depend on the way of drawing, such as all landmark distances, is computed once. Meant for coarse meshes:
/// about 10 ms a drawing for 33 landmarks on 1500 vertices.
#[derive(Debug)]
pub struct Candidates<'a> {
    meshes: [&'a SurfaceMesh; 2],
    landmarks: &'a Landmarks,
    empty: Drawing,
    distances: LandmarkDistances,
    /// How many starts were drawn, and how many of them wound.
    drawn: usize,
    tangled: usize,
    /// The class of the straightest layout, its number among those given, and the detour.
    straightest: Option<(usize, f64)>,
    /// Whether two descents have ended in the straightest class.
    is_settled: bool,
    /// The straightest last.
    ready: Vec<Candidate>,
    given: Vec<Class>,
    failure: Option<LayoutError>,
}

impl<'a> Candidates<'a> {
    /// Measures the distances between the landmarks. Nothing is drawn yet.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`]; [`LayoutError::TooMany`] where the distances would take too much memory.
    pub fn new(
        meshes: [&'a SurfaceMesh; 2],
        landmarks: &'a Landmarks,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, LayoutError> {
        let vertices = meshes[0].vertex_count().max(meshes[1].vertex_count());
        let most = MOST_DISTANCES / vertices.max(1);
        if landmarks.len() > most {
            return Err(LayoutError::TooMany { landmarks: landmarks.len(), most });
        }
        let empty = Drawing::new(meshes[0], meshes[1], landmarks);
        let distances = empty.distances(monitor)?;
        Ok(Self {
            meshes,
            landmarks,
            empty,
            distances,
            drawn: 0,
            tangled: 0,
            straightest: None,
            is_settled: false,
            ready: Vec::new(),
            given: Vec::new(),
            failure: None,
        })
    }

    /// The straightest layout of a new class that was drawn and not given yet; `None` when all starts were drawn. Once a result is
    /// wanted, no more starts are drawn than one that succeeds.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`] only: a start that fails is passed over (see [`Self::failure`]).
    pub fn next(&mut self, monitor: &mut dyn Monitor) -> Result<Option<Candidate>, LayoutError> {
        while self.may_draw() && (self.ready.is_empty() || !(self.is_settled || monitor.wants_result())) {
            self.draw_start(&STARTS[self.drawn], monitor)?;
        }
        self.ready.sort_by(|a, b| b.layout.report.detour.total_cmp(&a.layout.report.detour));
        Ok(self.ready.pop())
    }

    /// Whether [`Self::next`] has one at hand, or thinks that there are straighter ones.
    pub(super) fn is_promising(&self) -> bool {
        !self.ready.is_empty() || (self.may_draw() && !self.is_settled)
    }

    /// Whether there are starts left. Where no start but winds, others do, too.
    fn may_draw(&self) -> bool {
        let only_tangles = self.tangled == self.drawn && self.drawn >= TANGLED;
        self.drawn < STARTS.len() && !only_tangles
    }

    /// Draws a start and what its descent leads to. The start is kept, too: where no straight layout has a map, a bent one may.
    fn draw_start(&mut self, variant: &Variant, monitor: &mut dyn Monitor) -> Result<(), LayoutError> {
        self.drawn += 1;
        let ground = Ground { empty: &self.empty, distances: &self.distances };
        let start = match joint::draw(&ground, variant, monitor) {
            Ok(start) => start,
            Err(LayoutError::Cancelled(stop)) => return Err(stop.into()),
            Err(error) => {
                self.tangled += usize::from(matches!(error, LayoutError::Tangled { .. }));
                self.failure = Some(error);
                return Ok(());
            }
        };
        let mut planner = Planner::new(&self.distances, variant.midpoint_penalty, monitor);
        let ended = descent::straightest(start.clone(), &mut planner)?;
        monitor.step(Step::default())?;
        match self.candidate(ended) {
            Ok(candidate) => self.is_settled |= self.keep(candidate) == Kept::OfStraightestClass,
            Err(error) => {
                self.tangled += usize::from(matches!(error, LayoutError::Tangled { .. }));
                self.failure = Some(error);
            }
        }
        monitor.step(Step::default())?;
        if let Ok(candidate) = self.candidate(start) {
            self.keep(candidate);
        }
        Ok(())
    }

    /// Vertices of both meshes.
    pub(super) fn size(&self) -> usize {
        self.meshes[0].vertex_count() + self.meshes[1].vertex_count()
    }

    /// The distances between the landmarks.
    pub fn distances(&self) -> &LandmarkDistances {
        &self.distances
    }

    /// Why the last order of drawing that failed did.
    pub fn failure(&self) -> Option<&LayoutError> {
        self.failure.as_ref()
    }

    /// The layouts of new classes one Dehn twist away, the straightest first, at most `count`.
    ///
    /// A twist is considered where the path that goes round is at most `largest_ratio` times the one it replaces on one of
    /// the meshes.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`] only.
    pub fn twists(
        &mut self,
        of: &Candidate,
        count: usize,
        largest_ratio: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<Candidate>, LayoutError> {
        let mut found: Vec<Candidate> = Vec::new();
        let mut planner = Planner::new(&self.distances, 1.0, monitor);
        let plausible: Vec<Twist> = twists::plausible(&of.drawing, &mut planner, largest_ratio)?;
        let mut drawings = Vec::new();
        // Twice as many as are wanted: some cannot be drawn, some are of a class that is known.
        for twist in plausible.iter().take(2 * count) {
            if planner.wants_result() {
                break;
            }
            match twists::twisted(&of.drawing, &mut planner, twist) {
                Ok(drawing) => drawings.extend(drawing),
                Err(LayoutError::Cancelled(stop)) => return Err(stop.into()),
                Err(_) => {}
            }
        }
        for drawing in drawings {
            monitor.step(Step::default())?;
            // A drawing that does not close is no neighbour.
            if let Ok(candidate) = self.candidate(drawing) {
                let known = found.iter().any(|other| super::same_class(&other.layout, &candidate.layout));
                if !known && !self.given.iter().any(|class| class.contains(&candidate.layout)) {
                    found.push(candidate);
                }
            }
        }
        found.sort_by(|a, b| a.layout.report.detour.total_cmp(&b.layout.report.detour));
        found.truncate(count);
        self.given.extend(found.iter().map(|candidate| Class::new(candidate.layout.clone())));
        Ok(found)
    }

    pub(super) fn candidate(&self, drawing: Drawing) -> Result<Candidate, LayoutError> {
        let report = LayoutReport::of(&drawing, &self.distances);
        let distances = &self.distances;
        let bounds = Bounds::new(distances.landmark_count(), distances.vertex_counts());
        if report.detour > bounds.detour {
            return Err(drawing.tangled(distances).into());
        }
        let base = patches::base_of(&drawing, self.meshes[1], self.landmarks)?;
        let layout = patches::finish(drawing.clone(), base, self.meshes, report)?;
        Ok(Candidate { layout, drawing })
    }

    /// Keeps a candidate of a new class.
    fn keep(&mut self, candidate: Candidate) -> Kept {
        let detour = candidate.layout.report.detour;
        if let Some(known) = self.given.iter().position(|class| class.contains(&candidate.layout)) {
            let is_straightest =
                self.straightest.is_some_and(|(class, least)| class == known && least <= STRAIGHT);
            return if is_straightest { Kept::OfStraightestClass } else { Kept::OfKnownClass };
        }
        if self.straightest.is_none_or(|(_, least)| detour < least) {
            self.straightest = Some((self.given.len(), detour));
        }
        self.given.push(Class::new(candidate.layout.clone()));
        self.ready.push(candidate);
        Kept::OfNewClass
    }
}

/// What became of a candidate that was drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kept {
    /// It can be given.
    OfNewClass,
    /// Its class was drawn before.
    OfKnownClass,
    /// Its class was drawn before, and is the straightest by far.
    OfStraightestClass,
}

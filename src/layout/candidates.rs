//! Layouts of one pair of meshes, one of each isotopy class, the straightest first.

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
use crate::math::scalar::min;
use crate::mesh::SurfaceMesh;
use crate::monitor::{Monitor, Step, unless_stopped};

/// While the least detour is above this, another batch of starts is drawn: in 50 searches on ten pairs the layouts of the best
/// classes had less, and those of searches that missed the best class more.
const STRAIGHT: f64 = 0.4;

/// A twist whose detour exceeds that of the twisted layout by more than this is not completed: its paths wind, and take long. Chosen
/// by hand.
const WINDING: f64 = 2.0;

/// A layout with its drawing, from which its twists are drawn.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The layout.
    pub layout: BaseLayout,
    drawing: Drawing,
}

impl Candidate {
    /// Number of vertices of both refined meshes together.
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
/// All that does not depend on the order of drawing, such as the landmarks' distances, is computed once. Meant for coarse meshes:
/// about 10 ms a drawing for 33 landmarks on 1500 vertices.
#[derive(Debug)]
pub struct Candidates<'a> {
    meshes: [&'a SurfaceMesh; 2],
    landmarks: &'a Landmarks,
    empty: Drawing,
    distances: LandmarkDistances,
    /// Twists of one drawing that a descent tries, at most.
    descent_patience: usize,
    /// Number of batches of starts that were drawn.
    batches: usize,
    /// The least detour of the drawings, without layouts that turned out to have no map.
    least: f64,
    /// Candidates that were drawn and not given yet, the straightest last.
    ready: Vec<Candidate>,
    /// The classes of all candidates given so far.
    given: Vec<Class>,
    /// The error of the last start that could not be drawn.
    failure: Option<LayoutError>,
}

impl<'a> Candidates<'a> {
    /// Measures the distances between the landmarks. Nothing is drawn yet.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`]; [`LayoutError::TooFew`]; [`LayoutError::TooMany`] where the distances would take too much memory.
    pub fn new(
        meshes: [&'a SurfaceMesh; 2],
        landmarks: &'a Landmarks,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, LayoutError> {
        LayoutError::unless_enough(landmarks)?;
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
            descent_patience: descent::MOST_DRAWINGS,
            batches: 0,
            least: f64::INFINITY,
            ready: Vec::new(),
            given: Vec::new(),
            failure: None,
        })
    }

    /// The same with descents that try at most this many twists of one drawing.
    #[must_use]
    pub fn with_descent_patience(self, descent_patience: usize) -> Self {
        Self { descent_patience, ..self }
    }

    /// The straightest layout of a new class that was drawn and not given yet; `None` when all starts were drawn. Once a result is
    /// wanted, no more starts are drawn than one that succeeds.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`] only: a start that fails is passed over (see [`Self::failure`]).
    pub fn next(&mut self, monitor: &mut dyn Monitor) -> Result<Option<Candidate>, LayoutError> {
        while self.ready.is_empty() || (self.least > STRAIGHT && !monitor.wants_result()) {
            let Some(batch) = STARTS.get(self.batches) else { break };
            self.draw_batch(batch, monitor)?;
        }
        self.ready.sort_by(|a, b| b.layout.report.detour.total_cmp(&a.layout.report.detour));
        let next = self.ready.pop();
        self.given.extend(next.iter().map(|candidate| Class::new(candidate.layout.clone())));
        Ok(next)
    }

    /// Whether [`Self::next`] has a candidate at hand, or may draw a straighter one.
    pub(super) fn is_promising(&self) -> bool {
        !self.ready.is_empty() || (self.least > STRAIGHT && self.batches < STARTS.len())
    }

    /// Notes that a candidate that was given has no map: another drawing of its class may be given, and the straightest layout is
    /// missing again.
    pub(super) fn without_map(&mut self, candidate: &Candidate) {
        self.given.retain(|class| !class.contains(&candidate.layout));
        let left = self.ready.iter().map(|ready| ready.layout.report.detour);
        self.least = left.fold(f64::INFINITY, min);
    }

    /// Draws a batch of starts, and the drawing that a descent leads to from the straightest of them. The starts are kept, too: where
    /// no straight layout has a map, a bent one may.
    fn draw_batch(&mut self, batch: &[Variant], monitor: &mut dyn Monitor) -> Result<(), LayoutError> {
        self.batches += 1;
        let starts = self.starts(batch, monitor)?;
        let detour = |drawing: &Drawing| drawing.detour(&self.distances);
        let straightest = starts.iter().min_by(|a, b| detour(a).total_cmp(&detour(b)));
        let ended = match straightest {
            Some(start) => {
                let mut planner = Planner::new(&self.distances, 1.0, monitor);
                Some(descent::straightest(start.clone(), self.descent_patience, &mut planner)?)
            }
            None => None,
        };
        for drawing in ended.into_iter().chain(starts) {
            monitor.step(Step::default())?;
            match self.candidate(drawing) {
                Ok(candidate) => self.keep(candidate),
                Err(error) => self.failure = Some(error),
            }
        }
        Ok(())
    }

    /// The starts of a batch that can be drawn and are not much more bent than those before.
    fn starts(&mut self, batch: &[Variant], monitor: &mut dyn Monitor) -> Result<Vec<Drawing>, LayoutError> {
        let (mut starts, mut tangled, mut most_detour) = (Vec::new(), 0, f64::INFINITY);
        for variant in batch {
            if monitor.wants_result() && !starts.is_empty() {
                break;
            }
            let ground = Ground { most_detour, ..Ground::new(&self.empty, &self.distances) };
            match joint::draw(&ground, variant, monitor) {
                Ok(start) => {
                    most_detour = min(most_detour, descent::worth_completing(start.detour(&self.distances)));
                    starts.push(start);
                }
                Err(LayoutError::Cancelled(stop)) => return Err(stop.into()),
                Err(error) => {
                    tangled += usize::from(matches!(error, LayoutError::Tangled { .. }));
                    self.failure = Some(error);
                }
            }
        }
        // Where the paths of all starts wind, those of other starts do, too.
        if starts.is_empty() && tangled == batch.len() {
            self.batches = STARTS.len();
        }
        Ok(starts)
    }

    /// Number of vertices of both meshes together.
    pub(super) fn size(&self) -> usize {
        self.meshes[0].vertex_count() + self.meshes[1].vertex_count()
    }

    /// The distances between the landmarks.
    pub fn distances(&self) -> &LandmarkDistances {
        &self.distances
    }

    /// The error of the last start that could not be drawn.
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
        if largest_ratio.is_finite() {
            planner.most_detour = of.layout.report.detour + WINDING;
        }
        let plausible: Vec<Twist> = twists::plausible(&of.drawing, &mut planner, largest_ratio)?;
        let mut drawings = Vec::new();
        // Twice as many as are wanted: some cannot be drawn, some are of a class that is known.
        for twist in plausible.iter().take(2 * count) {
            if planner.wants_result() {
                break;
            }
            drawings.extend(unless_stopped(twists::twisted(&of.drawing, &mut planner, twist))?.flatten());
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

    /// Keeps a candidate to be given, unless there is one of its class. The class is noted only when the candidate is given: otherwise
    /// it may still come as a twist.
    fn keep(&mut self, candidate: Candidate) {
        let is_same = |other: &Candidate| super::same_class(&other.layout, &candidate.layout);
        if self.given.iter().any(|class| class.contains(&candidate.layout)) || self.ready.iter().any(is_same)
        {
            return;
        }
        self.least = min(self.least, candidate.layout.report.detour);
        self.ready.push(candidate);
    }
}

//! Layouts of one pair of meshes, one of each isotopy class, the most promising first.

use super::base_layout::{BaseLayout, LayoutReport};
use super::bounds::{Bounds, MOST_DISTANCES};
use super::drawing::{Drawing, Planner};
use super::error::LayoutError;
use super::isotopy::Class;
use super::joint::{self, Ground};
use super::landmark_distances::LandmarkDistances;
use super::patches;
use super::twists::{self, Twist};
use super::variants::VARIANTS;
use crate::landmarks::Landmarks;
use crate::mesh::SurfaceMesh;
use crate::monitor::{Monitor, Step};

/// Orders of drawing tried together; the straightest of them comes first.
/// Chosen by hand; a drawing takes 5 to 10 ms.
const BATCH: usize = 4;
/// With a detour above this, more orders are tried before the straightest is given: judging costs more than drawing.
const STRAIGHT: f64 = 0.1;

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
    next_variant: usize,
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
            next_variant: 0,
            ready: Vec::new(),
            given: Vec::new(),
            failure: None,
        })
    }

    /// The next layout of a new class from another order of drawing; `None` when all orders were tried. Once a result is wanted, no more
    /// orders are drawn than one that succeeds.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`] only: an order that fails is passed over (see [`Self::failure`]).
    pub fn next(&mut self, monitor: &mut dyn Monitor) -> Result<Option<Candidate>, LayoutError> {
        while self.next_variant < VARIANTS.len()
            && self.ready.last().is_none_or(|best| best.layout.report.detour > STRAIGHT)
        {
            self.draw_batch(monitor)?;
        }
        Ok(self.ready.pop())
    }

    fn draw_batch(&mut self, monitor: &mut dyn Monitor) -> Result<(), LayoutError> {
        let end = (self.next_variant + BATCH).min(VARIANTS.len());
        let (mut drawings, mut tangled) = (0, 0);
        for variant in &VARIANTS[self.next_variant..end] {
            if monitor.wants_result() && !self.ready.is_empty() {
                break;
            }
            let ground = Ground { empty: &self.empty, distances: &self.distances };
            let drawn = joint::draw(&ground, variant, monitor).and_then(|drawing| self.candidate(drawing));
            drawings += 1;
            tangled += usize::from(matches!(drawn, Err(LayoutError::Tangled { .. })));
            match drawn {
                Ok(candidate) => {
                    let fresh = self.if_new(candidate);
                    self.ready.extend(fresh);
                }
                Err(LayoutError::Cancelled(stop)) => return Err(stop.into()),
                Err(error) => self.failure = Some(error),
            }
        }
        // Where no order but winds, others do, too.
        self.next_variant = if drawings > 0 && tangled == drawings { VARIANTS.len() } else { end };
        self.ready.sort_by(|a, b| b.layout.report.detour.total_cmp(&a.layout.report.detour));
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

    /// The candidate, noted as given, unless its class was given before.
    fn if_new(&mut self, candidate: Candidate) -> Option<Candidate> {
        if self.given.iter().any(|class| class.contains(&candidate.layout)) {
            return None;
        }
        self.given.push(Class::new(candidate.layout.clone()));
        Some(candidate)
    }
}

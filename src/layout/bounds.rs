//! How much a drawing may take: vertices of its refined meshes, steps of its searches, detours of its paths.
//!
//! Landmarks in a senseless order make paths wind around each other, and each path that winds makes the next ones longer: refined
//! meshes and searches would grow exponentially with the number of landmarks. So a drawing ends where it has become larger than
//! any that leads to a map. All bounds are counted, so that the same input ends at the same place everywhere.

use super::drawing::Drawing;
use super::error::LayoutError;
use super::landmark_distances::LandmarkDistances;
use crate::monitor::{Cancelled, Monitor, Portion, Step};

/// The largest sizes of a drawing.
///
/// On the 34 test pairs all drawings that lead to maps have at most 5 times the vertices of their level, take at most 25 steps of a
/// search for each landmark and vertex, and have a mean detour of at most 0.09; with landmarks in random order the least are 8
/// times, 30 steps and 0.5.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Vertices of the refined source and target.
    vertices: [usize; 2],
    /// Nodes that the searches of one drawing settle.
    steps: usize,
    /// Sum of the detours of its paths ([`super::LayoutReport::detour`]).
    detour: f64,
}

/// Vertices of a refined mesh for each vertex of its level, and for each unit of the mean length of all paths in edges, which grows
/// with the root of landmarks times vertices: on fine levels a drawing needs less for each vertex.
const VERTEX_GROWTH: usize = 16;
const PATH_GROWTH: f64 = 200.0;
/// Steps of the searches of one drawing for each landmark and each vertex of the level.
const STEPS: usize = 250;
/// The detour that any layout may have, and what each path may add to it: a tangle has no map that is worth its time.
const FREE_DETOUR: f64 = 12.0;
const DETOUR_OF_PATH: f64 = 0.25;
/// Landmarks times vertices of a level, at most: so many distances are kept of each mesh (8 bytes each).
pub const MOST_DISTANCES: usize = 40_000_000;

impl Bounds {
    /// For drawings between the landmarks of some distances.
    pub fn new(distances: &LandmarkDistances) -> Self {
        let landmarks = distances.landmark_count();
        let vertices = distances.vertex_counts();
        let of_mesh = |vertices: usize| {
            let of_paths = (PATH_GROWTH * ((landmarks * vertices) as f64).sqrt()) as usize;
            (VERTEX_GROWTH * vertices).min(vertices + of_paths)
        };
        Self {
            vertices: vertices.map(of_mesh),
            steps: STEPS * landmarks * vertices[0].max(vertices[1]),
            detour: FREE_DETOUR + DETOUR_OF_PATH * (3 * landmarks) as f64,
        }
    }

    /// Whether a drawing is within them.
    ///
    /// # Errors
    /// [`LayoutError::Tangled`].
    pub fn check(&self, drawing: &Drawing, distances: &LandmarkDistances) -> Result<(), LayoutError> {
        let fits = |side: usize| drawing.sides[side].mesh.positions.len() <= self.vertices[side];
        if fits(0) && fits(1) { Ok(()) } else { Err(tangled(drawing, distances)) }
    }

    /// Whether the paths are straight enough: those of a layout that is judged, and those of its spanning tree, which only become
    /// longer.
    ///
    /// # Errors
    /// [`LayoutError::Tangled`].
    pub fn check_detour(&self, drawing: &Drawing, distances: &LandmarkDistances) -> Result<(), LayoutError> {
        let detour: f64 = (0..drawing.ends.len()).map(|path| detour(drawing, distances, path)).sum();
        if detour <= self.detour { Ok(()) } else { Err(tangled(drawing, distances)) }
    }
}

/// By how much a path is longer than the shortest one, on both meshes, in units of the shortest.
fn detour(drawing: &Drawing, distances: &LandmarkDistances, path: usize) -> f64 {
    let shortest = distances.between(drawing.ends[path]);
    // 10 % is left to paths over vertices and midpoints, as in the report of a layout.
    (0..2).map(|s| (drawing.sides[s].lengths[path] / shortest[s] - 1.1).max(0.0)).sum()
}

/// The error of a drawing that has become too large, with the landmarks whose paths wind most.
fn tangled(drawing: &Drawing, distances: &LandmarkDistances) -> LayoutError {
    let mut blame = vec![0.0; drawing.rotation.len()];
    for (path, ends) in drawing.ends.iter().enumerate() {
        ends.iter().for_each(|&landmark| blame[landmark] += detour(drawing, distances, path));
    }
    LayoutError::Tangled { near: worst(&blame) }
}

/// Landmarks named at most.
const NAMED: usize = 4;

/// The landmarks with at least half as much blame as the worst, the worst first, at most four; none without blame.
pub fn worst(blame: &[f64]) -> Vec<usize> {
    let most = blame.iter().copied().fold(0.0, f64::max);
    let mut near: Vec<usize> = (0..blame.len()).filter(|&k| 2.0 * blame[k] > most).collect();
    near.sort_by(|&a, &b| blame[b].total_cmp(&blame[a]));
    near.truncate(NAMED);
    near
}

/// What the searches of a drawing may still take, and whom they ask.
pub(super) struct Allowance<'m> {
    monitor: &'m mut dyn Monitor,
    steps: usize,
    cancelled: Option<Cancelled>,
}

/// Steps of a search between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 1 << 13;

impl<'m> Allowance<'m> {
    /// Nothing is allowed yet.
    pub fn new(monitor: &'m mut dyn Monitor) -> Self {
        Self { monitor, steps: 0, cancelled: None }
    }

    /// Allows the searches of one more drawing.
    pub fn renew(&mut self, bounds: &Bounds) {
        self.steps = bounds.steps;
    }

    /// One more step of a search; `false` where it must end.
    #[inline]
    pub fn step(&mut self) -> bool {
        if self.steps.is_multiple_of(ASKED_EVERY) && !self.ask() {
            return false;
        }
        self.steps = self.steps.saturating_sub(1);
        self.steps > 0
    }

    /// Whether to finish with what is there.
    pub fn wants_result(&self) -> bool {
        self.monitor.wants_result()
    }

    /// Whether another search may find something.
    pub fn is_left(&self) -> bool {
        self.steps > 0 && self.cancelled.is_none()
    }

    fn ask(&mut self) -> bool {
        if let Err(stop) = Portion::new(self.monitor, 0.0, 0.0).step(Step::default()) {
            self.cancelled = Some(stop);
        }
        self.cancelled.is_none()
    }

    /// Tells the monitor how far the drawing is.
    ///
    /// # Errors
    /// [`LayoutError::Cancelled`], also where a search was stopped since.
    pub fn tell(&mut self, fraction: f64) -> Result<(), LayoutError> {
        if let Some(stop) = self.cancelled {
            return Err(stop.into());
        }
        Ok(self.monitor.step(Step { fraction, residual: None })?)
    }

    /// Why a search found nothing between two landmarks of a drawing.
    pub fn fault(
        &self,
        drawing: &Drawing,
        distances: &LandmarkDistances,
        otherwise: LayoutError,
    ) -> LayoutError {
        match self.cancelled {
            Some(stop) => stop.into(),
            None if self.steps == 0 => tangled(drawing, distances),
            None => otherwise,
        }
    }
}

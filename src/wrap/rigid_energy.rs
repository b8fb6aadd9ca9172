//! The energy of a surface that is to be as rigid as possible: its part around each vertex turned and scaled, but not bent
//! (Sorkine & Alexa 2007).
//!
//! Some vertices move, the others hold. Turns and places are found in turn; the places by one linear system whose matrix is a graph's
//! Laplacian, the graph having a vertex of its own that stands for all that holds.

use super::images::Frame;
use crate::math::rigid3::{nearest_rotation, outer};
use crate::math::scalar::{exp, max};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::numerics::approximate_cholesky::ApproximateCholesky;
use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace};
use crate::numerics::graph::Graph;
use glam::{DMat3, DQuat, DVec3};
use typed_index_collections::{TiVec, ti_vec};

/// Each iteration lowers the error, so that the last iterate is of use even where these are not enough.
const SOLVE: CgOptions = CgOptions { tolerance: 1e-5, max_iterations: 300 };

/// The largest number of rounds of turns and places. Chosen by hand.
const ROUNDS: usize = 40;

/// The share of the mean edge below which no vertex may move when the rounds end. Chosen by hand.
const STILL: f64 = 1e-3;

/// The weight of each edge: (cot a + cot b) / 2 of the angles across, each times how much its face counts; not less than a little,
/// so that the system is a graph's.
pub(super) fn edge_weights(
    base: &SurfaceMesh,
    face_weight: impl Fn(FaceId) -> f64,
) -> TiVec<HalfedgeId, f64> {
    let half = |h: HalfedgeId| {
        let cotangent = base.cotangent(h);
        // That of an edge without length is not a number.
        let bounded = if cotangent.is_nan() { 0.0 } else { cotangent.clamp(-20.0, 20.0) };
        0.5 * face_weight(h.face()) * bounded
    };
    let floor = |h: HalfedgeId| 0.05 * face_weight(h.face());
    base.halfedges()
        .map(|h| [h, base.twin(h)])
        .map(|[h, t]| max(half(h) + half(t), floor(h) + floor(t)))
        .collect()
}

/// A vertex that is drawn to a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anchor {
    /// The weight of the place, beside edges that count about 1.
    pub weight: f64,
    /// The place to which the vertex is drawn.
    pub place: DVec3,
}

/// The vertices that move, with the system of their places.
pub(super) struct RigidEnergy<'a> {
    base: &'a SurfaceMesh,
    weights: &'a TiVec<HalfedgeId, f64>,
    /// The vertices that move.
    moving: Vec<VertexId>,
    /// The number in `moving` of each vertex that moves.
    number: TiVec<VertexId, Option<u32>>,
    anchors: Vec<Option<Anchor>>,
    graph: Graph,
    factor: ApproximateCholesky,
}

impl<'a> RigidEnergy<'a> {
    /// The energy of the base with these vertices moving, each drawn to its anchor. Something must hold every part that moves: a
    /// vertex that does not move, or an anchor.
    pub fn new(
        base: &'a SurfaceMesh,
        weights: &'a TiVec<HalfedgeId, f64>,
        moving: Vec<VertexId>,
        anchor: impl Fn(VertexId) -> Option<Anchor>,
    ) -> Self {
        let mut number = ti_vec![None; base.vertex_count()];
        moving.iter().zip(0..).for_each(|(&v, k)| number[v] = Some(k));
        let anchors: Vec<Option<Anchor>> = moving.iter().map(|&v| anchor(v)).collect();
        let ground = moving.len() as u32;
        let mut edges = Vec::with_capacity(moving.len() * 4);
        for ((&v, k), anchor) in moving.iter().zip(0..).zip(&anchors) {
            let mut held = anchor.map_or(0.0, |anchor| anchor.weight);
            for h in base.star(v) {
                match number[base.head(h)] {
                    Some(n) if k < n => edges.push((k, n, weights[h])),
                    Some(_) => {}
                    None => held += weights[h],
                }
            }
            if held > 0.0 {
                edges.push((k, ground, held));
            }
        }
        let graph = Graph { vertices: moving.len() + 1, edges };
        let factor = ApproximateCholesky::new(&graph);
        Self { base, weights, moving, number, anchors, graph, factor }
    }

    /// The vertices around those that move, each once.
    fn around(&self) -> Vec<VertexId> {
        let heads = self.moving.iter().flat_map(|&v| self.base.star(v).map(|h| self.base.head(h)));
        let mut around: Vec<VertexId> = heads.filter(|&v| self.number[v].is_none()).collect();
        around.sort_unstable();
        around.dedup();
        around
    }

    /// Frames of the vertices that move, harmonic between those of the vertices around; `spread` are the frames of all others.
    pub fn spread_frames(&self, frames: &mut TiVec<VertexId, Frame>) {
        let around = self.around();
        let Some(&first) = around.first() else { return };
        let reference = DQuat::from_mat3(&frames[first].rotation);
        let numbers = |frame: &Frame| {
            let turn = DQuat::from_mat3(&frame.rotation);
            let turn = if turn.dot(reference) < 0.0 { -turn } else { turn };
            let [x, y, z, w] = turn.to_array();
            [x, y, z, w, frame.log_stretch]
        };
        let mut held: TiVec<VertexId, [f64; 5]> = ti_vec![[0.0; 5]; self.base.vertex_count()];
        around.iter().for_each(|&v| held[v] = numbers(&frames[v]));
        let mut workspace = CgWorkspace::default();
        let mut found = vec![[0.0; 5]; self.moving.len()];
        for axis in 0..5 {
            let right = self.moving.iter().map(|&v| {
                let outside = self.base.star(v).filter(|&h| self.number[self.base.head(h)].is_none());
                outside.map(|h| self.weights[h] * held[self.base.head(h)][axis]).sum::<f64>()
            });
            let x = self.solve(&mut workspace, right.collect());
            found.iter_mut().zip(x).for_each(|(found, x)| found[axis] = x);
        }
        for (&v, [x, y, z, w, log_stretch]) in self.moving.iter().zip(found) {
            let turn = DQuat::from_xyzw(x, y, z, w);
            let turn = if turn.length_squared() > 1e-12 { turn.normalize() } else { reference };
            frames[v] = Frame { rotation: DMat3::from_quat(turn), log_stretch };
        }
    }

    /// Solves the system, what holds being at 0.
    fn solve(&self, workspace: &mut CgWorkspace<f64>, mut right: Vec<f64>) -> Vec<f64> {
        right.push(-right.iter().sum::<f64>());
        let mut x = vec![0.0; right.len()];
        // A solve that has not converged is no fault here, see above.
        let _ = workspace.solve(&self.graph, &self.factor, &right, &mut x, &SOLVE);
        let ground = x.pop().unwrap_or(0.0);
        x.iter_mut().for_each(|x| *x -= ground);
        x
    }

    /// Moves the vertices to where their frames want them.
    pub fn place(&self, frames: &TiVec<VertexId, Frame>, positions: &mut TiVec<VertexId, DVec3>) -> f64 {
        let at = self.base.positions();
        let scaled = |v: VertexId| frames[v].rotation * exp(frames[v].log_stretch);
        let residual = |(&v, anchor): (&VertexId, &Option<Anchor>)| {
            let edge = |h: HalfedgeId| {
                let w = self.base.head(h);
                let wanted = (scaled(v) + scaled(w)) * (0.5 * (at[v] - at[w]));
                (wanted - (positions[v] - positions[w])) * self.weights[h]
            };
            let pull = anchor.map_or(DVec3::ZERO, |anchor| (anchor.place - positions[v]) * anchor.weight);
            self.base.star(v).map(edge).sum::<DVec3>() + pull
        };
        let residuals: Vec<DVec3> = self.moving.iter().zip(&self.anchors).map(residual).collect();
        let mut workspace = CgWorkspace::default();
        let mut steps = vec![DVec3::ZERO; self.moving.len()];
        for axis in 0..3 {
            let x = self.solve(&mut workspace, residuals.iter().map(|r| r[axis]).collect());
            steps.iter_mut().zip(x).for_each(|(step, x)| step[axis] = x);
        }
        let mut farthest = 0.0;
        for (&v, step) in self.moving.iter().zip(steps).filter(|(_, step)| step.is_finite()) {
            positions[v] += step;
            farthest = max(farthest, step.length());
        }
        farthest
    }

    /// Turns the frames of the vertices that move to where these are.
    fn turn(&self, frames: &mut TiVec<VertexId, Frame>, positions: &TiVec<VertexId, DVec3>) {
        let at = self.base.positions();
        for &v in &self.moving {
            let matrix = self.base.star(v).fold(DMat3::ZERO, |sum, h| {
                let w = self.base.head(h);
                sum + outer((positions[w] - positions[v]) * self.weights[h], at[w] - at[v])
            });
            frames[v].rotation = nearest_rotation(&matrix, frames[v].rotation);
        }
    }

    /// Lowers the energy from where the vertices are: turns and places, until these are still.
    pub fn relax(
        &self,
        frames: &mut TiVec<VertexId, Frame>,
        positions: &mut TiVec<VertexId, DVec3>,
        monitor: &mut dyn Monitor,
    ) -> Result<(), Cancelled> {
        let lengths = self.moving.iter().flat_map(|&v| self.base.star(v).map(move |h| (v, h)));
        let mean = |(v, h): (VertexId, HalfedgeId)| self.base.length(h) * exp(frames[v].log_stretch);
        let (mut sum, mut count) = (0.0, 0.0);
        lengths.for_each(|edge| (sum, count) = (sum + mean(edge), count + 1.0));
        for round in 0..ROUNDS {
            monitor.step(Step { fraction: round as f64 / ROUNDS as f64, residual: None })?;
            self.turn(frames, positions);
            if self.place(frames, positions) <= STILL * sum / count {
                break;
            }
        }
        Ok(())
    }
}

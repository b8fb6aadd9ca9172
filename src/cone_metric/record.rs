//! The steps of a flow, recorded for display where the caller asks for them.

use crate::math::scalar::exp;
use crate::mesh::{FaceId, VertexId};
use std::f64::consts::PI;
use typed_index_collections::{TiSlice, TiVec};

/// Moments that are kept, at most: a bound on memory. Of a longer flow every second, fourth, ... step is kept, and the last. Chosen by
/// hand.
const MOST_MOMENTS: usize = 24;

/// The states of a flow before its first Newton step and after later steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlowRecord {
    /// The states in their order; the first is that before the first step.
    pub moments: Vec<FlowMoment>,
    /// Whether the last state has the target curvatures, to the tolerance.
    pub converged: bool,
    /// The faces that a flow without flips stopped at, because they degenerate beyond the last moment.
    pub degenerate_faces: Vec<FaceId>,
    /// Logarithms of the radii before the first step, in the mesh's unit of length; 0 where the structure has no circles.
    pub log_radii: TiVec<VertexId, f64>,
    /// The curvature at each vertex, in radians, before the first step and at the last moment.
    pub curvature: [TiVec<VertexId, f64>; 2],
}

/// A flow after a Newton step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlowMoment {
    /// Steps so far.
    pub step: usize,
    /// max |target - curvature|, in radians.
    pub residual: f64,
    /// Conjugate gradient iterations so far.
    pub cg_iterations: usize,
    /// Edge flips so far, those of rejected trial steps included.
    pub edge_flips: usize,
    /// Logarithm of the factor that lengths at each vertex have grown by.
    pub log_factors: TiVec<VertexId, f64>,
}

impl FlowRecord {
    /// The record with log factors shifted so that their weighted mean is 0 at every moment: the scale of a flat metric is arbitrary.
    #[must_use]
    pub fn centred(mut self, weights: &TiSlice<VertexId, f64>) -> Self {
        let whole: f64 = weights.iter().sum();
        for moment in &mut self.moments {
            let mean = moment.log_factors.iter().zip(weights).map(|(u, w)| u * w).sum::<f64>() / whole;
            moment.log_factors.iter_mut().for_each(|u| *u -= mean);
        }
        self
    }

    /// Gaussian curvatures by vertex before the first step and at the last moment, in units of the curvature of a sphere of the same area;
    /// `areas` are the vertices' shares of the mesh's, which grow with the squares of their conformal factors.
    pub fn curvature_by_area(&self, areas: &TiSlice<VertexId, f64>) -> [TiVec<VertexId, f64>; 2] {
        let by_area = |moment: Option<&FlowMoment>, curvature: &TiSlice<VertexId, f64>| {
            let factors = moment.map_or(&[][..], |moment| &moment.log_factors.raw);
            let areas: Vec<f64> = areas.iter().zip(factors).map(|(a, u)| a * exp(2.0 * u)).collect();
            let of_sphere = 4.0 * PI / areas.iter().sum::<f64>();
            curvature.iter().zip(&areas).map(|(k, a)| k / a / of_sphere).collect()
        };
        let [first, last] = &self.curvature;
        [by_area(self.moments.first(), first), by_area(self.moments.last(), last)]
    }

    /// The radius of each vertex's circle before the first step, in units of the root of the mesh's area; `areas` are the vertices' shares of
    /// that area.
    pub fn radii(&self, areas: &TiSlice<VertexId, f64>) -> Vec<f64> {
        let unit = areas.iter().sum::<f64>().sqrt();
        self.log_radii.iter().map(|&u| exp(u) / unit).collect()
    }
}

/// Records moments of a flow; memory stays bounded however long the flow is.
#[derive(Debug)]
pub(super) struct Recorder {
    /// Log radii before the first step.
    start: TiVec<VertexId, f64>,
    moments: Vec<FlowMoment>,
    curvature: [TiVec<VertexId, f64>; 2],
    /// One of this many steps is kept.
    every: usize,
}

impl Recorder {
    pub fn new(start: TiVec<VertexId, f64>) -> Self {
        Self { start, moments: Vec::new(), curvature: Default::default(), every: 1 }
    }

    /// Takes a moment with these log radii and curvatures.
    pub fn take(
        &mut self,
        moment: FlowMoment,
        log_radii: &TiSlice<VertexId, f64>,
        curvature: &TiSlice<VertexId, f64>,
    ) {
        let kept = if self.moments.is_empty() { 0..2 } else { 1..2 };
        self.curvature[kept].fill(curvature.to_owned());
        // The last moment was the present one; it stays only where its step is one of those that are kept.
        if self.moments.last().is_some_and(|last| last.step % self.every != 0) {
            self.moments.pop();
        }
        if self.moments.len() == MOST_MOMENTS {
            self.every *= 2;
            let every = self.every;
            self.moments.retain(|kept| kept.step % every == 0);
        }
        let log_factors = log_radii.iter().zip(&self.start).map(|(u, start)| u - start).collect();
        self.moments.push(FlowMoment { log_factors, ..moment });
    }

    /// The record of a flow that converged (`None`), or that did not and stopped at these faces, which may be none.
    pub fn record(self, stopped_at: Option<Vec<FaceId>>) -> FlowRecord {
        let converged = stopped_at.is_none();
        let degenerate_faces = stopped_at.unwrap_or_default();
        FlowRecord {
            moments: self.moments,
            converged,
            degenerate_faces,
            log_radii: self.start,
            curvature: self.curvature,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use typed_index_collections::ti_vec;

    #[test]
    fn a_long_flow_is_sampled_evenly_with_its_first_and_last_moment() {
        for steps in [0, 5, 23, 24, 60, 1000] {
            let mut recorder = Recorder::new(ti_vec![1.0; 3]);
            for step in 0..=steps {
                let (moment, radii) = (FlowMoment { step, ..FlowMoment::default() }, 1.0 + step as f64);
                recorder.take(moment, &ti_vec![radii; 3], &ti_vec![step as f64; 3]);
            }
            let FlowRecord { moments, curvature, .. } = recorder.record(None);
            assert_eq!(curvature.map(|of_vertices| of_vertices.raw), [vec![0.0; 3], vec![steps as f64; 3]]);
            let kept: Vec<usize> = moments.iter().map(|moment| moment.step).collect();
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, steps), "{kept:?}");
            assert!(kept.len() <= MOST_MOMENTS && kept.len() > steps.min(MOST_MOMENTS) / 2, "{kept:?}");
            let apart: Vec<usize> = kept.windows(2).map(|w| w[1] - w[0]).collect();
            assert!(apart.iter().rev().skip(1).all(|&gap| gap == apart[0]), "{kept:?}");
            assert!(moments.iter().all(|moment| moment.log_factors[VertexId(2)] == moment.step as f64));
        }
    }

    #[test]
    fn centred_factors_have_mean_0_by_weight() {
        let moment = FlowMoment { log_factors: ti_vec![1.0, 2.0, 4.0], ..FlowMoment::default() };
        let record = FlowRecord { moments: vec![moment], converged: true, ..FlowRecord::default() };
        let centred = record.centred(&ti_vec![1.0, 1.0, 2.0]);
        assert_eq!(centred.moments[0].log_factors.raw, [-1.75, -0.75, 1.25]);
    }
}

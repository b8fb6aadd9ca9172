//! The flows of both meshes from step to step, in a worker of their own.

use super::compute::{Messenger, RunListener};
use super::failure;
use super::page_job::read_job;
use crate::job::JobError;
use crate::monitor::{PlannedStage, Stage};
use crate::pipeline::{FlowRecord, PipelineOptions};
use serde_json::json;
use wasm_bindgen::prelude::*;

/// Both flows.
#[wasm_bindgen]
pub struct RecordedFlows {
    records: [FlowRecord; 2],
    /// Vertices of the checked meshes.
    vertices: [usize; 2],
}

/// Runs the flows of both meshes with these curvatures of the landmarks' cones, in radians, as a finished map tells them.
///
/// # Errors
/// `{"code", "message"}` with the stage's code.
#[wasm_bindgen(js_name = recordFlows)]
pub fn record_flows(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    cones: &[f64],
    listener: &RunListener,
) -> Result<RecordedFlows, JsValue> {
    let mut messenger = Messenger::new(listener);
    let planned = |stage| PlannedStage { stage, time: 1.0 };
    messenger.plan(vec![planned(Stage::SourceConeMetric), planned(Stage::TargetConeMetric)]);
    let job = read_job([source, target], landmarks, &mut messenger)?;
    let failed = |error: JobError| failure(error.code(), error);
    let records = job
        .recorded_flows(cones, &PipelineOptions::default(), &mut messenger)
        .map_err(|error| failed(error.into()))?;
    Ok(RecordedFlows { records, vertices: job.vertex_counts() })
}

#[wasm_bindgen]
impl RecordedFlows {
    /// The steps of the source's flow (0) or of the target's (1): JSON `{"converged", "moments"}`, the moments a list of `{"step",
    /// "residual", "cgIterations", "edgeFlips"}` from before the first step on.
    pub fn steps(&self, side: usize) -> String {
        let FlowRecord { moments, converged } = &self.records[side.min(1)];
        let told = moments.iter().map(|moment| {
            json!({
                "step": moment.step,
                "residual": moment.residual,
                "cgIterations": moment.cg_iterations,
                "edgeFlips": moment.edge_flips,
            })
        });
        json!({ "converged": converged, "moments": told.collect::<Vec<_>>() }).to_string()
    }

    /// Logarithms of the conformal factor, moment after moment, by vertex of the checked mesh.
    #[wasm_bindgen(js_name = logFactors)]
    pub fn log_factors(&self, side: usize) -> Vec<f32> {
        let side = side.min(1);
        let moments = self.records[side].moments.iter();
        moments.flat_map(|m| m.log_factors.raw[..self.vertices[side]].iter().map(|&u| u as f32)).collect()
    }
}

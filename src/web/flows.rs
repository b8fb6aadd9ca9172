//! The flows of both meshes from step to step, in a worker of their own.

use super::compute::{Messenger, RunListener};
use super::page_job::read_job;
use super::{failure, mesh_side};
use crate::job::{Job, JobError};
use crate::landmarks::MeshSide;
use crate::mesh::packing::Packer;
use crate::mesh::repair::Defects;
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::monitor::{PlannedStage, Stage};
use crate::pipeline::{FlowOptions, FlowRecord, PipelineOptions, Scheme};
use serde_json::json;
use typed_index_collections::TiVec;
use wasm_bindgen::prelude::*;

/// Both flows.
#[wasm_bindgen]
pub struct RecordedFlows {
    records: [FlowRecord; 2],
    /// Numbers of vertices of the checked meshes.
    vertices: [usize; 2],
    /// Gaussian curvatures of each mesh by vertex, before the first step and at the last moment, in units of that of a sphere of
    /// the same area.
    curvatures: [[TiVec<VertexId, f64>; 2]; 2],
    /// Radii of the circles of each mesh by vertex before the first step, in units of the root of the mesh's area; empty where
    /// there are no circles.
    radii: [Vec<f64>; 2],
    stops: [Stops; 2],
}

/// The faces that stopped a flow.
struct Stops {
    /// The numbers of the faces in the triangulated file.
    faces: Vec<u32>,
    /// The faces as a view draws them.
    shown: Defects,
}

impl Stops {
    fn new(job: &Job, side: MeshSide, record: &FlowRecord) -> Self {
        let (mesh, positions) = (job.mapped_meshes()[side], &job.positions()[side]);
        let corners = |&f: &FaceId| mesh.triangles()[f].map(|v| positions[v.index()]);
        let corners: Vec<_> = record.degenerate_faces.iter().map(corners).collect();
        let numbers = record.degenerate_faces.iter().map(|&f| job.file_face(side, f).0);
        Self { faces: numbers.collect(), shown: Defects::of_stopped_flow(&corners) }
    }
}

/// Runs the flows of both meshes with these curvatures of the landmarks' cones, in radians, as a finished map tells them, by a discrete
/// conformal structure, a `Scheme`.
///
/// # Errors
/// `{"code", "message"}` with the stage's code.
#[wasm_bindgen(js_name = recordFlows)]
pub fn record_flows(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    cones: &[f64],
    scheme: &str,
    listener: &RunListener,
) -> Result<RecordedFlows, JsValue> {
    let scheme: Scheme = serde_json::from_value(json!(scheme)).map_err(|e| failure("options", e))?;
    let mut messenger = Messenger::new(listener);
    let planned = |stage| PlannedStage { stage, time: 1.0 };
    messenger.plan(vec![planned(Stage::SourceConeMetric), planned(Stage::TargetConeMetric)]);
    let job = read_job([source, target], landmarks, &mut messenger)?;
    let failed = |error: JobError| failure(error.code(), error);
    let flow = FlowOptions { scheme, ..FlowOptions::default() };
    let options = PipelineOptions { flow, ..PipelineOptions::default() };
    let records =
        job.recorded_flows(cones, &options, &mut messenger).map_err(|error| failed(error.into()))?;
    let stops = MeshSide::BOTH.map(|side| Stops::new(&job, side, &records[side]));
    let areas = job.mapped_meshes().map(SurfaceMesh::vertex_areas);
    let curvatures = MeshSide::BOTH.map(|side| records[side].curvature_by_area(&areas[side]));
    let radii = MeshSide::BOTH
        .map(|side| if scheme.has_circles() { records[side].radii(&areas[side]) } else { Vec::new() });
    Ok(RecordedFlows { records, vertices: job.vertex_counts(), curvatures, radii, stops })
}

#[wasm_bindgen]
impl RecordedFlows {
    /// The steps of the source's flow (0) or of the target's (1): JSON `{"converged", "moments", "stops"}`, the moments a list of `{"step",
    /// "residual", "cgIterations", "edgeFlips"}` from before the first step on, the stops the numbers of the faces that the flow stopped
    /// at, in the triangulated file.
    pub fn steps(&self, side: usize) -> Result<String, JsValue> {
        let side = mesh_side(side)?;
        let FlowRecord { moments, converged, .. } = &self.records[side];
        let stops = &self.stops[side].faces;
        let told = moments.iter().map(|moment| {
            json!({
                "step": moment.step,
                "residual": moment.residual,
                "cgIterations": moment.cg_iterations,
                "edgeFlips": moment.edge_flips,
            })
        });
        let told = json!({ "converged": converged, "moments": told.collect::<Vec<_>>(), "stops": stops });
        Ok(told.to_string())
    }

    /// The radius of the circle at each vertex of the checked mesh before the first step, in units of the root of the mesh's area; it grows
    /// with the conformal factor. Empty where the structure has no circles.
    pub fn radii(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let side = mesh_side(side)?;
        Ok(self.radii[side].iter().take(self.vertices[side]).map(|&r| r as f32).collect())
    }

    /// The faces that the flow stopped at, in the order of their numbers, as bytes of which `unpackDefects` makes what a view shows.
    #[wasm_bindgen(js_name = packedStops)]
    pub fn packed_stops(&self, side: usize) -> Result<Vec<u8>, JsValue> {
        let mut packer = Packer::default();
        self.stops[mesh_side(side)?].shown.pack(&mut packer);
        Ok(packer.into_bytes())
    }

    /// Logarithms of the conformal factor, moment after moment, by vertex of the checked mesh.
    #[wasm_bindgen(js_name = logFactors)]
    pub fn log_factors(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let side = mesh_side(side)?;
        let moments = self.records[side].moments.iter().map(|moment| &moment.log_factors.raw);
        Ok(moments.flat_map(|factors| factors[..self.vertices[side]].iter().map(|&u| u as f32)).collect())
    }

    /// Gaussian curvatures by vertex of the checked mesh, in units of that of a sphere of the same area: before the first step (0) or at the
    /// last moment (1).
    pub fn curvatures(&self, side: usize, moment: usize) -> Result<Vec<f32>, JsValue> {
        let side = mesh_side(side)?;
        let curvatures = &self.curvatures[side][moment.min(1)];
        Ok(curvatures.iter().take(self.vertices[side]).map(|&k| k as f32).collect())
    }
}

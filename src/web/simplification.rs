//! Both meshes on their way to their landmarks, in a worker of their own.

use super::compute::{Messenger, RunListener, flat3};
use super::page_job::read_job;
use super::{failure, mesh_side};
use crate::job::{CarriedSimplification, JobError, MapFiles, OpenMap};
use crate::landmarks::MeshSide;
use crate::monitor::{PlannedStage, Stage};
use crate::pipeline::{Lead, SimplificationStage};
use glam::DVec3;
use wasm_bindgen::prelude::*;

/// The stages of both meshes.
#[wasm_bindgen]
pub struct Simplifications {
    stages: [Vec<SimplificationStage>; 2],
    positions: [Vec<DVec3>; 2],
}

/// Collapses both meshes to their landmarks.
///
/// # Errors
/// `{"code", "message"}` with the stage's code.
#[wasm_bindgen(js_name = recordSimplifications)]
pub fn record_simplifications(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    listener: &RunListener,
) -> Result<Simplifications, JsValue> {
    let mut messenger = Messenger::new(listener);
    messenger.plan(vec![PlannedStage { stage: Stage::BaseDomain, time: 1.0 }]);
    let job = read_job([source, target], landmarks, &mut messenger)?;
    let failed = |error: JobError| failure(error.code(), error);
    let stages = job.simplifications(&mut messenger).map_err(|error| failed(error.into()))?;
    Ok(Simplifications { stages, positions: job.positions() })
}

/// The collapses of both meshes, to be drawn on both.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug)]
pub enum CollapsedMesh {
    /// The source, which decides alone.
    Source = "source",
    /// The target, likewise.
    Target = "target",
    /// The source, where both decide.
    Both = "both",
}

/// Collapses one of both meshes to its landmarks, drawn on both by a map file that was made with them.
///
/// # Errors
/// `{"code", "message"}` with the stage's code, or that of the map file.
#[wasm_bindgen(js_name = recordCarriedSimplification)]
pub fn record_carried_simplification(
    map: &[u8],
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    from: CollapsedMesh,
    listener: &RunListener,
) -> Result<Simplifications, JsValue> {
    let (side, lead) = match from {
        CollapsedMesh::Source => (MeshSide::Source, Lead::Own),
        CollapsedMesh::Target => (MeshSide::Target, Lead::Own),
        CollapsedMesh::Both => (MeshSide::Source, Lead::Both),
        _ => return Err(failure("options", "there is no such mesh to simplify from")),
    };
    let mut messenger = Messenger::new(listener);
    messenger.plan(vec![PlannedStage { stage: Stage::BaseDomain, time: 1.0 }]);
    let open = OpenMap::read(MapFiles { map, source, target }).map_err(|e| failure(e.code(), &e))?;
    let job = read_job([source, target], landmarks, &mut messenger)?;
    let failed = |error: JobError| failure(error.code(), error);
    let CarriedSimplification { stages, positions } = job
        .carried_simplification(side, &open.taken(), lead, &mut messenger)
        .map_err(|error| failed(error.into()))?;
    Ok(Simplifications { stages: [stages.clone(), stages], positions })
}

#[wasm_bindgen]
impl Simplifications {
    /// The positions of the vertices of the source (0) or the target (1), three numbers each.
    pub fn positions(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        Ok(flat3(&self.positions[mesh_side(side)?]))
    }

    /// All collapses in their order, two vertices each: the one that went, and the one that it went onto.
    pub fn collapses(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let stages = self.stages[mesh_side(side)?].iter();
        Ok(stages.flat_map(|stage| stage.collapses.iter().flatten().map(|v| v.0)).collect())
    }

    /// The triangles of all stages, one stage after the other, the whole mesh first.
    pub fn triangles(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let stages = self.stages[mesh_side(side)?].iter();
        Ok(stages.flat_map(|stage| stage.triangles.iter().flatten().map(|v| v.0)).collect())
    }

    /// The number of triangles of each stage.
    pub fn counts(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        Ok(self.stages[mesh_side(side)?].iter().map(|stage| stage.triangles.len() as u32).collect())
    }
}

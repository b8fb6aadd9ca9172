//! Landmarks that the program finds, in a worker.

use super::compute::{Messenger, RunListener};
use super::failure;
use crate::io::landmark_file;
use crate::job::{MatchReport, MeshFaults, ReadMesh, match_meshes, read_mesh};
use crate::landmark_matching::MatchOptions;
use crate::mesh::repair::RepairOptions;
use crate::monitor::{PlannedStage, Stage};
use wasm_bindgen::prelude::*;

/// Finds landmarks of two mesh files beside given ones, which are held and may be none. The answer is a [`MatchReport`] as JSON.
///
/// # Errors
/// `{"code", "message"}`.
#[wasm_bindgen(js_name = matchLandmarks)]
pub fn match_landmarks(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    listener: &RunListener,
) -> Result<String, JsValue> {
    let mut messenger = Messenger::new(listener);
    messenger.plan(vec![PlannedStage { stage: Stage::Matching, time: 1.0 }]);
    // Meshes that are on the page were allowed what they needed.
    let faults = MeshFaults::Repaired(RepairOptions::everything());
    let mut read = |bytes: &[u8]| {
        let ReadMesh { mesh, .. } =
            read_mesh(bytes, faults, &mut messenger).map_err(|e| failure("mesh", e))?;
        Ok::<_, JsValue>(mesh.into_checked())
    };
    let meshes = [read(source)?, read(target)?];
    let given = landmark_file::read(landmarks.as_bytes()).map_err(|e| failure("landmarks", e))?;
    let found = match_meshes([&meshes[0], &meshes[1]], &given, &MatchOptions::default(), &mut messenger);
    let report: MatchReport = found.map_err(|error| failure(error.code(), error))?.report;
    serde_json::to_string(&report).map_err(|e| failure("landmarks", e))
}

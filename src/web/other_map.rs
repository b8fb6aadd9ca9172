//! Another map of the same meshes and landmarks, to be compared with a finished one.

use super::compute::{MapOutput, Messenger, RunListener, Shown};
use super::failure;
use super::page_job::read_job;
use crate::demo::true_map;
use crate::job::JobError;
use crate::pipeline::{Choices, OtherMap, PipelineOptions};
use serde_json::json;
use wasm_bindgen::prelude::*;

/// Makes another map, an `OtherMap`, of what a map was made from with these options. Where the meshes are a demo's, its id tells the true
/// map where that is known. No files can be made of it.
///
/// # Errors
/// `{"code", "message"}` with the stage's code.
#[wasm_bindgen(js_name = runOtherMap)]
pub fn run_other_map(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    options: &str,
    other: &str,
    listener: &RunListener,
    demo: Option<String>,
) -> Result<MapOutput, JsValue> {
    let mut messenger = Messenger::new(listener);
    let choices: Choices = serde_json::from_str(options).map_err(|e| failure("options", e))?;
    let other: OtherMap = serde_json::from_value(json!(other)).map_err(|e| failure("options", e))?;
    let options = PipelineOptions::from(choices).of_other(other);
    let mut job = read_job([source, target], landmarks, &mut messenger)?;
    let true_map = demo.and_then(|id| true_map(&id));
    if let Some(image) = true_map {
        job.know_true_map(image);
    }
    messenger.plan(options.stages(job.landmark_count()));
    let failed = |error: JobError| failure(error.code(), error);
    let mut result = job.run(&options, &mut messenger).map_err(|error| failed(error.into()))?;
    Ok(MapOutput::for_views(Shown::of_run(&job, &mut result, true_map)))
}

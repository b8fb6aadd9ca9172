//! The job of the meshes and landmarks on the page.

use super::failure;
use crate::job::{Job, JobFiles, MeshFaults, ReadOptions};
use crate::landmark_exchange::GivenFile;
use crate::mesh::repair::RepairOptions;
use crate::monitor::Monitor;
use wasm_bindgen::prelude::*;

/// Reads the source, the target and the landmark file, as the page holds them.
pub(super) fn read_job(
    [source, target]: [&[u8]; 2],
    landmarks: &str,
    monitor: &mut dyn Monitor,
) -> Result<Job, JsValue> {
    let landmarks = [GivenFile { name: "landmarks.json", bytes: landmarks.as_bytes() }];
    let files = JobFiles { source, target, landmarks: &landmarks };
    // Meshes that are on the page were allowed what they needed.
    let mesh_faults = MeshFaults::Repaired(RepairOptions::everything());
    let options = ReadOptions { mesh_faults, ..ReadOptions::default() };
    Job::read(files, options, monitor).map_err(|error| failure(error.code(), error))
}

//! Landmarks that the program finds, in a worker.

use super::compute::{Messenger, RunListener};
use super::{failure, mesh_side};
use crate::io::landmark_file;
use crate::job::{Matched, MeshFaults, ReadMesh, match_meshes, read_mesh};
use crate::landmark_matching::{CoarsePicture, MatchOptions};
use crate::landmarks::MeshSide;
use crate::mesh::repair::RepairOptions;
use crate::monitor::{PlannedStage, Stage};
use glam::DVec3;
use wasm_bindgen::prelude::*;

/// Landmarks that were found, with the coarse map of each candidate.
#[wasm_bindgen]
pub struct FoundLandmarks {
    report: String,
    pictures: Vec<CoarsePicture>,
}

#[wasm_bindgen]
impl FoundLandmarks {
    /// A [`MatchReport`](crate::job::MatchReport) as JSON.
    pub fn report(&self) -> String {
        self.report.clone()
    }

    /// The coarse source of a candidate's map: its triangles' vertices, three numbers each; empty for a candidate that there is not.
    pub fn triangles(&self, candidate: usize) -> Vec<u32> {
        let triangles = self.pictures.get(candidate).map(|picture| picture.source.triangles());
        triangles.into_iter().flatten().flatten().map(|v| v.0).collect()
    }

    /// The places of the vertices of the coarse source on the source (0) or on the target (1), three coordinates each: the middle of their
    /// bounding box is 0 and half its diagonal 1. Empty for a candidate that there is not.
    pub fn places(&self, candidate: usize, side: usize) -> Result<Vec<f32>, JsValue> {
        let side = mesh_side(side)?;
        let places = self.pictures.get(candidate).map(|picture| match side {
            MeshSide::Source => picture.source.positions().iter().copied().collect(),
            MeshSide::Target => picture.images(),
        });
        let places = places.unwrap_or_default();
        let corner = |of: fn(DVec3, DVec3) -> DVec3| places.iter().copied().reduce(of).unwrap_or_default();
        let [low, high] = [corner(DVec3::min), corner(DVec3::max)];
        let (middle, half) = (0.5 * (low + high), 0.5 * low.distance(high));
        Ok(places.iter().flat_map(|&p| ((p - middle) / half).as_vec3().to_array()).collect())
    }
}

/// Finds landmarks of two mesh files beside given ones, which are held and may be none.
///
/// # Errors
/// `{"code", "message"}`.
#[wasm_bindgen(js_name = matchLandmarks)]
pub fn match_landmarks(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    listener: &RunListener,
) -> Result<FoundLandmarks, JsValue> {
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
    messenger.name_vertices([&meshes[0], &meshes[1]]);
    let given = landmark_file::read(landmarks.as_bytes()).map_err(|e| failure("landmarks", e))?;
    let found = match_meshes([&meshes[0], &meshes[1]], &given, &MatchOptions::default(), &mut messenger);
    let Matched { report, pictures } = found.map_err(|error| failure(error.code(), error))?;
    let report = serde_json::to_string(&report).map_err(|e| failure("landmarks", e))?;
    Ok(FoundLandmarks { report, pictures })
}

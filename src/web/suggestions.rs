//! Places that are worth a landmark.

use super::failure;
use super::loaded_mesh::LoadedMesh;
use crate::io::landmark_file::LandmarkPoint;
use crate::landmark_suggestion::{Suggestion, USUAL_COUNT, kept, suggest};
use crate::mesh::check::CheckedMesh;
use crate::mesh::{FaceId, SurfacePoint, VertexId};
use crate::monitor::Silent;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// Vertices of one mesh that are worth a landmark beside those that there are, as many as are usual: JSON
/// `[{"point", "reason": Reason, "partner": number | null}]`, the best first; `point` is a vertex of the file, `partner`
/// the number of the suggestion that looks alike. `landmarks` is a JSON array of landmark points.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = suggestLandmarks)]
pub fn suggest_landmarks(loaded: &LoadedMesh, landmarks: &str) -> Result<String, JsValue> {
    let points: Vec<LandmarkPoint> = serde_json::from_str(landmarks).map_err(|e| failure("landmarks", e))?;
    let checked: &CheckedMesh = &loaded.checked;
    let mesh = &checked.mesh;
    let nearest = |point: LandmarkPoint| match point {
        LandmarkPoint::Vertex(v) => checked.numbered_vertex(v as usize).ok(),
        LandmarkPoint::OnFace { face, barycentric } => {
            let face = checked.face_from_file(FaceId(face))?;
            Some(checked.with_file_corners(SurfacePoint { face, barycentric }).heaviest_corner(mesh))
        }
    };
    let mut marked: Vec<VertexId> = points.into_iter().filter_map(nearest).collect();
    marked.sort_unstable();
    marked.dedup();
    let numbers = checked.file_from_vertex();
    let entry = |s: &Suggestion| json!({ "point": numbers[s.vertex.index()], "reason": s.reason, "partner": s.partner });
    // Nothing asks this search to stop: the page ends its worker.
    let suggestions =
        suggest(mesh, &marked, USUAL_COUNT, &mut Silent).map_err(|e| failure("cancelled", e))?;
    // What a repair made up has no number in the file, and takes no landmark.
    let suggestions = kept(&suggestions, |v| numbers[v.index()] < checked.vertex_from_file.len());
    let found: Vec<_> = suggestions.iter().map(entry).collect();
    Ok(serde_json::Value::from(found).to_string())
}

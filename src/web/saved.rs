//! Maps that were saved: opened with their meshes, shown, asked and exported, without computing.

use super::compute::{MapOutput, Shown};
use super::output_file::file;
use crate::export::vertex_image::Direction;
use crate::job::{MapFiles, OpenMap, OpenMapError, OutputKind};
use crate::landmarks::MeshSide;
use crate::mesh::{FaceId, SurfacePoint};
use serde_json::json;
use wasm_bindgen::prelude::*;

/// A saved map that is open.
#[wasm_bindgen]
pub struct SavedMap {
    open: OpenMap,
}

/// An error as the page takes it, with the mesh at fault: `{"code", "message", "side": "source" | "target" | null}`.
fn opening_failure(error: &OpenMapError) -> JsValue {
    let side: Option<MeshSide> = error.side();
    let value = json!({ "code": error.code(), "message": error.to_string(), "side": side });
    JsValue::from_str(&value.to_string())
}

/// Opens a map file with the meshes that it was made with.
///
/// # Errors
/// `{"code": "map-file" | "map-version" | "other-meshes" | "file" | "mesh", "message", "side": "source" | "target" | null}`.
#[wasm_bindgen(js_name = openMap)]
pub fn open_map(map: &[u8], source: &[u8], target: &[u8]) -> Result<SavedMap, JsValue> {
    let open = OpenMap::read(MapFiles { map, source, target }).map_err(|e| opening_failure(&e))?;
    Ok(SavedMap { open })
}

/// One file of a saved map, by its name in [`output_names`].
///
/// # Errors
/// As [`open_map`], and `{"code": "export", "message"}`.
#[wasm_bindgen(js_name = exportFromMap)]
pub fn export_from_map(map: &[u8], source: &[u8], target: &[u8], name: &str) -> Result<Vec<u8>, JsValue> {
    open_map(map, source, target)?.file(name)
}

/// The names of all files that a map gives, as JSON.
#[wasm_bindgen(js_name = outputNames)]
pub fn output_names() -> String {
    json!(OutputKind::ALL.map(OutputKind::file_name)).to_string()
}

#[wasm_bindgen]
impl SavedMap {
    /// The map as a run gives it, for the views; its report is that of the run.
    pub fn output(&self) -> MapOutput {
        let map = self.open.taken();
        let common = map.common();
        MapOutput::of_saved(Shown {
            distortion: map.common_distortion(&common),
            common,
            patch_lines: map.patch_lines(),
            cones: map.map().cones.clone(),
            report: serde_json::to_string_pretty(&map.map().report).unwrap_or_default(),
        })
    }

    /// The landmark file of the run.
    pub fn landmarks(&self) -> Vec<u8> {
        crate::io::landmark_file::write(&self.open.taken().map().landmarks)
    }

    /// What was chosen of the run, as JSON.
    pub fn options(&self) -> String {
        self.open.taken().map().options.to_string()
    }

    /// The measures of the map, made anew from its pieces, as JSON like the report's `distortion`.
    pub fn distortion(&self) -> String {
        serde_json::to_string(&self.open.taken().distortion()).unwrap_or_default()
    }

    /// One of its files by name.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    pub fn file(&self, name: &str) -> Result<Vec<u8>, JsValue> {
        file(self.open.taken(), name)
    }

    /// The image of a point of the source (side 0), or the source point of one of the target (side 1), in the files' numbers:
    /// face, three weights, three coordinates. `undefined` where the face does not exist or the weights are no weights.
    pub fn image(&self, side: usize, face: u32, weights: &[f64]) -> Option<Vec<f64>> {
        let direction = if side == 0 { Direction::SourceToTarget } else { Direction::TargetToSource };
        let barycentric: [f64; 3] = weights.try_into().ok()?;
        let sum: f64 = barycentric.iter().sum();
        let is_sound = barycentric.iter().all(|w| *w >= -1e-6) && (sum - 1.0).abs() < 1e-4;
        let exists = (face as usize) < self.open.taken().surfaces()[direction.side()].face_count();
        if !is_sound || !exists {
            return None;
        }
        let point = SurfacePoint::clamped(FaceId(face), barycentric);
        let image = self.open.taken().images(direction, &[point]).pop()?;
        let mut numbers = vec![f64::from(image.point.face.0)];
        numbers.extend(image.point.barycentric);
        numbers.extend(image.position.to_array());
        Some(numbers)
    }
}

//! Maps that were saved: opened with their meshes, shown, asked and exported, without computing.

use super::compute::{MapOutput, Shown, look_files};
use super::failure;
use super::output_file::file;
use crate::demo::true_map;
use crate::job::{MapFiles, MapLook, Normals, OpenMap, OpenMapError, ProofReport, TargetImage, prove};
use crate::landmarks::MeshSide;
use crate::monitor::Silent;
use crate::pipeline::Choices;
use serde_json::json;
use std::ops::ControlFlow;
use wasm_bindgen::prelude::*;

/// A saved map that is open.
#[wasm_bindgen]
pub struct SavedMap {
    open: OpenMap,
    look: MapLook,
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
    Ok(SavedMap { open, look: MapLook::default() })
}

/// Proves a map file with its meshes by a program that shares nothing with what made it. The answer is a [`ProofReport`] as JSON.
///
/// # Errors
/// `{"code": "map-file", "message"}` where the answer cannot be written.
#[wasm_bindgen(js_name = proveMap)]
pub fn prove_map(map: &[u8], source: &[u8], target: &[u8]) -> Result<String, JsValue> {
    let outcome = prove(MapFiles { map, source, target }, &mut |_| ControlFlow::Continue(()));
    serde_json::to_string(&ProofReport::of(&outcome)).map_err(|e| failure("map-file", e))
}

impl SavedMap {
    pub(super) fn open(&self) -> &OpenMap {
        &self.open
    }
}

/// A base file that was laid onto a scan.
#[wasm_bindgen]
pub struct WrappedBase {
    bytes: Vec<u8>,
    sentence: String,
}

#[wasm_bindgen]
impl WrappedBase {
    /// The file: the base's own, but for the places of its vertices.
    pub fn bytes(&self) -> Vec<u8> {
        self.bytes.clone()
    }

    /// The outcome of wrapping, in sentences.
    pub fn sentence(&self) -> String {
        self.sentence.clone()
    }
}

#[wasm_bindgen]
impl SavedMap {
    /// The map as a run gives it, for the views. Its report is that of the run, as the file tells it, with the distortion measured
    /// anew from the pieces. Where the meshes are a demo's, its id tells the true map, unless the map goes to the target's mirror image.
    ///
    /// # Errors
    /// `{"code": "map-file", "message"}` where the report is none.
    pub fn output(&self, demo: Option<String>) -> Result<MapOutput, JsValue> {
        let map = self.open.taken();
        let common = map.common();
        let true_map = demo.filter(|_| !self.is_mirrored()).and_then(|id| true_map(&id));
        let mut report = map.map().report.clone();
        let fields = report
            .as_object_mut()
            .ok_or_else(|| failure("map-file", "the map file, section \"report\": it is no report"))?;
        fields.insert("distortion".to_owned(), json!(map.distortion()));
        Ok(MapOutput::for_views(Shown {
            distortion: map.common_distortion(&common),
            truth: true_map.map_or_else(Vec::new, |image| common.distances_to(image)),
            common,
            patch_lines: map.patch_lines(),
            cones: map.map().cones.clone(),
            base: map.base_picture(),
            report: serde_json::to_string_pretty(&report).unwrap_or_default(),
        }))
    }

    /// The landmark file of the run.
    pub fn landmarks(&self) -> Vec<u8> {
        crate::io::landmark_file::write(&self.open.taken().map().landmarks)
    }

    /// All choices of the run, as JSON; `undefined` where this version does not know one of them.
    pub fn options(&self) -> Option<String> {
        let choices: Choices = serde_json::from_value(self.open.taken().map().options.clone()).ok()?;
        serde_json::to_string(&choices).ok()
    }

    /// Whether the map goes to the mirror image of the target.
    #[wasm_bindgen(js_name = isMirrored)]
    pub fn is_mirrored(&self) -> bool {
        self.open.meshes()[1].image() == TargetImage::Mirrored
    }

    /// The source's file with its vertices laid onto the target, every other line kept.
    ///
    /// # Errors
    /// `{"code": "wrap", "message"}`.
    pub fn wrapped(&self, source: &[u8]) -> Result<WrappedBase, JsValue> {
        let wrapped = self.open.taken().wrapped(source, Normals::Kept, &mut Silent);
        let wrapped = wrapped.map_err(|e| failure("wrap", e))?;
        Ok(WrappedBase { sentence: wrapped.report.sentence(), bytes: wrapped.bytes })
    }

    /// Takes the look that the map carries, by the files of its meshes and what comes with them; its files that have one have it from then on.
    #[wasm_bindgen(js_name = takeLook)]
    pub fn take_look(
        &mut self,
        source: &[u8],
        target: &[u8],
        source_companion: Option<Vec<u8>>,
        target_companion: Option<Vec<u8>>,
    ) {
        self.look = self.open.look(look_files([source, target], [&source_companion, &target_companion]));
    }

    /// One of its files by name.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    pub fn file(&self, name: &str) -> Result<Vec<u8>, JsValue> {
        file(self.open.taken().wearing(&self.look), name)
    }
}

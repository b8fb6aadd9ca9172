//! The wasm boundary: typed arrays in and out, errors as JSON with a stable code and a sentence.

mod base_output;
mod compute;
mod defects;
mod files;
mod flows;
mod landmark_files;
mod loaded_mesh;
mod matching;
mod output_file;
mod planes;
mod repair;
mod saved;
mod simplification;
mod view_side;
mod viewer;

use serde_json::json;
use wasm_bindgen::prelude::*;

/// Runs once when the module is loaded.
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}

/// An error as the page takes it: a string of JSON `{"code", "message"}`.
fn failure(code: &str, message: impl std::fmt::Display) -> JsValue {
    JsValue::from_str(&json!({ "code": code, "message": message.to_string() }).to_string())
}

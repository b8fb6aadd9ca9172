//! What the page gives, read.

use super::super::failure;
use glam::{DVec3, Vec3};
use serde::de::DeserializeOwned;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// A point of a typed array.
pub(super) fn point(p: [f32; 3]) -> DVec3 {
    Vec3::from_array(p).as_dvec3()
}

/// A value from its JSON.
pub(super) fn parsed<T: DeserializeOwned>(code: &str, json: &str) -> Result<T, JsValue> {
    serde_json::from_str(json).map_err(|e| failure(code, e))
}

/// The variant of an enumeration by its name.
pub(super) fn named<T: DeserializeOwned>(code: &str, name: &str) -> Result<T, JsValue> {
    serde_json::from_value(json!(name)).map_err(|e| failure(code, e))
}

//! Reads what the page gives: points, lines and values as JSON.

use super::super::failure;
use glam::{DVec3, Vec3};
use serde::de::DeserializeOwned;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// A point of a typed array.
pub(super) fn point(p: [f32; 3]) -> DVec3 {
    Vec3::from_array(p).as_dvec3()
}

/// Lines from their points, one after the other, and where each starts among them, with one past the end.
pub(super) fn strips(points: &[f32], starts: &[u32]) -> Vec<Vec<DVec3>> {
    let points: Vec<DVec3> = points.chunks_exact(3).map(|p| point([p[0], p[1], p[2]])).collect();
    let strip = |w: &[u32]| points.get(w[0] as usize..w[1] as usize).map(<[DVec3]>::to_vec);
    starts.windows(2).map(|w| strip(w).unwrap_or_default()).collect()
}

/// A value from its JSON.
pub(super) fn parsed<T: DeserializeOwned>(code: &str, json: &str) -> Result<T, JsValue> {
    serde_json::from_str(json).map_err(|e| failure(code, e))
}

/// The variant of an enumeration by its name.
pub(super) fn named<T: DeserializeOwned>(code: &str, name: &str) -> Result<T, JsValue> {
    serde_json::from_value(json!(name)).map_err(|e| failure(code, e))
}

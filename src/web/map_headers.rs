//! The header of a map file, read before the file is opened.

use super::failure;
use crate::map_file;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// Whether a file says of itself that it is a map file, whole or not.
#[wasm_bindgen(js_name = isMapFile)]
pub fn is_map_file(bytes: &[u8]) -> bool {
    map_file::is_one(bytes)
}

/// The source and the target that a map file was made with, by its header alone: JSON, two of `{"name", "checked"}`. `name` is what
/// the landmarks call the mesh, or `null`; `checked` is the [`LoadedMesh::checked_hash`](super::loaded_mesh::LoadedMesh::checked_hash) of the right one.
///
/// # Errors
/// `{"code": "map-file" | "map-version", "message"}`.
#[wasm_bindgen(js_name = wantedMeshes)]
pub fn wanted_meshes(map: &[u8]) -> Result<String, JsValue> {
    let wanted = map_file::wanted_meshes(map).map_err(|e| failure(e.code(), &e))?;
    let told = wanted.map(|mesh| json!({ "name": mesh.name, "checked": mesh.checked_hash }));
    Ok(json!(told).to_string())
}

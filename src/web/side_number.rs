//! The two meshes as the page numbers them.

use super::failure;
use crate::landmarks::MeshSide;
use wasm_bindgen::prelude::*;

/// The mesh that the page means by a number: 0 the source, 1 the target.
///
/// # Errors
/// `{"code": "side", "message"}` for another number.
pub(super) fn mesh_side(number: usize) -> Result<MeshSide, JsValue> {
    let no_mesh = || failure("side", format!("there is no mesh {number}: 0 is the source, 1 the target"));
    MeshSide::BOTH.get(number).copied().ok_or_else(no_mesh)
}

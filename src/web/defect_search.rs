//! The search for the defects of a mesh file, which the page shows.

use super::failure;
use super::loaded_mesh::LoadedMesh;
use crate::io;
use crate::mesh::packing::Packer;
use crate::mesh::repair::{Defects, RepairOptions, defects};
use crate::monitor::Silent;
use wasm_bindgen::prelude::*;

fn found(bytes: &[u8], options: &RepairOptions) -> Result<Defects, JsValue> {
    let soup = io::read_mesh(bytes).map_err(|e| failure("file", e))?;
    defects(&soup, options, &mut Silent).map_err(|e| failure("mesh", e))
}

/// All of it as bytes, of which `unpackDefects` of the same build makes what the page shows.
fn packed(defects: &Defects) -> Vec<u8> {
    let mut packer = Packer::default();
    defects.pack(&mut packer);
    packer.into_bytes()
}

/// The defects of a mesh file, packed. `allowed` is as for `repairMesh`; parts that may be dropped and handles that may be cut are listed
/// all the same.
///
/// # Errors
/// `{"code": "file" | "mesh" | "options", "message"}` where there is nothing to look at.
#[wasm_bindgen(js_name = meshDefects)]
pub fn mesh_defects(bytes: &[u8], allowed: &str) -> Result<Vec<u8>, JsValue> {
    let options: RepairOptions = serde_json::from_str(allowed).map_err(|e| failure("options", e))?;
    Ok(packed(&found(bytes, &options)?))
}

/// The defects of the file of a mesh that was repaired, with the caps that the repair made, packed.
///
/// # Errors
/// As `meshDefects`.
#[wasm_bindgen(js_name = repairedDefects)]
pub fn repaired_defects(bytes: &[u8], mesh: &LoadedMesh) -> Result<Vec<u8>, JsValue> {
    Ok(packed(&found(bytes, &RepairOptions::default())?.with_caps(&mesh.checked)))
}

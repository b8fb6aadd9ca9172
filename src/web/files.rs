//! The contents of files and the further files that they need, before a mesh is read; and whether landmarks fit a mesh.

use super::loaded_mesh::LoadedMesh;
use super::{failure, mesh_side};
use crate::io;
use crate::io::gltf_parts::{self, GltfParts};
use crate::io::landmark_file;
use crate::io::material_set::{self, PackedMaterials};
use crate::landmarks;
use wasm_bindgen::prelude::*;

/// The files that a mesh file names and needs beside it: buffers, and pictures of textures.
#[wasm_bindgen]
pub struct MeshParts {
    parts: GltfParts,
}

#[wasm_bindgen]
impl MeshParts {
    /// Without these it cannot be read.
    pub fn buffers(&self) -> Vec<String> {
        self.parts.buffers.clone()
    }

    /// Pictures; without them it has no texture.
    pub fn images(&self) -> Vec<String> {
        self.parts.images.clone()
    }
}

/// Checks a picture that the browser is to decode, by its head alone.
///
/// # Errors
/// `{"code": "file", "message"}`: it is no PNG, JPEG or WebP file, is damaged or has too many pixels.
#[wasm_bindgen(js_name = checkPicture)]
pub fn check_picture(bytes: &[u8]) -> Result<(), JsValue> {
    io::picture::check(bytes).map_err(|e| failure("file", e))
}

/// The files that a mesh file names, by what it calls them.
#[wasm_bindgen(js_name = meshParts)]
pub fn mesh_parts(bytes: &[u8]) -> MeshParts {
    MeshParts { parts: gltf_parts::parts_of(bytes) }
}

/// A mesh file with the files that it names as one file that needs no other. `names` are what the mesh file calls them.
///
/// # Errors
/// `{"code": "file", "message"}` that names the parts that are missing.
#[wasm_bindgen(js_name = packMesh)]
pub fn pack_mesh(
    bytes: &[u8],
    names: Vec<String>,
    contents: Vec<js_sys::Uint8Array>,
) -> Result<Vec<u8>, JsValue> {
    let contents: Vec<Vec<u8>> = contents.iter().map(js_sys::Uint8Array::to_vec).collect();
    let find = |wanted: &str| {
        names.iter().zip(&contents).find(|(name, _)| *name == wanted).map(|(_, content)| content.as_slice())
    };
    Ok(gltf_parts::packed(bytes, find).map_err(|e| failure("file", e))?.bytes)
}

/// The materials of an OBJ file with their pictures, packed to go along with it.
#[wasm_bindgen]
pub struct PackedSet {
    set: PackedMaterials,
}

#[wasm_bindgen]
impl PackedSet {
    /// All of them as one file.
    pub fn bytes(&self) -> Vec<u8> {
        self.set.bytes.clone()
    }

    /// The number of pictures that the materials name and that were found.
    pub fn found(&self) -> usize {
        self.set.found
    }
}

/// The materials of an OBJ file with the pictures that they name; `undefined` where they name none. `find` gives a file by its name as an
/// array of bytes, and anything else where it is not there.
#[wasm_bindgen(js_name = packMaterials)]
pub fn pack_materials(mesh: &[u8], find: &js_sys::Function) -> Option<PackedSet> {
    let find = |name: &str| {
        let found = find.call1(&JsValue::UNDEFINED, &JsValue::from_str(name)).ok()?;
        Some(found.dyn_into::<js_sys::Uint8Array>().ok()?.to_vec())
    };
    material_set::packed(mesh, find).map(|set| PackedSet { set })
}

/// The mesh formats in words.
#[wasm_bindgen(js_name = meshFormats)]
pub fn mesh_formats() -> String {
    io::Format::NAMES.to_owned()
}

/// The endings of mesh files' names, with their dots, apart by commas: as a file chooser takes them.
#[wasm_bindgen(js_name = meshEndings)]
pub fn mesh_endings() -> String {
    let endings = io::Format::ALL.into_iter().flat_map(io::Format::endings);
    endings.map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(",")
}

/// Checks that the points of a landmark file on one side, 0 the source and 1 the target, are different points of its mesh.
///
/// # Errors
/// `{"code": "landmarks" | "other-meshes", "message"}`; the second where the file seems to be made for other meshes.
#[wasm_bindgen(js_name = checkLandmarks)]
pub fn check_landmarks(mesh: &LoadedMesh, side: usize, bytes: &[u8]) -> Result<(), JsValue> {
    use landmarks::LandmarkError::{MissingFace, MissingVertex, UnusedVertex};
    let file = landmark_file::read(bytes).map_err(|e| failure("landmarks", e))?;
    landmarks::check_side(&mesh.checked, mesh_side(side)?, &file.pairs).map_err(|e| match e {
        MissingFace { .. } | MissingVertex { .. } | UnusedVertex { .. } => failure("other-meshes", e),
        _ => failure("landmarks", e),
    })
}

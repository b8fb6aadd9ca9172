//! Mesh files, landmark files and demos.

use super::failure;
use super::loaded_mesh::LoadedMesh;
use crate::io::gltf_parts::{self, GltfParts};
use crate::io::landmark_file::{self, LandmarkPoint};
use crate::io::material_set::{self, PackedMaterials};
use crate::landmark_suggestion::{Suggestion, kept, suggest};
use crate::landmarks::{self, MeshSide};
use crate::mesh::check::CheckedMesh;
use crate::mesh::mirror::mirrored;
use crate::mesh::{FaceId, SurfacePoint, VertexId};
use crate::monitor::Silent;
use crate::{export, io};
use serde_json::json;
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

    /// How many of the pictures that the materials name were found.
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

/// Reads a landmark file and gives it back as normalised JSON.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = readLandmarks)]
pub fn read_landmarks(bytes: &[u8]) -> Result<String, JsValue> {
    let file = landmark_file::read(bytes).map_err(|e| failure("landmarks", e))?;
    serde_json::to_string(&file).map_err(|e| failure("landmarks", e))
}

/// Checks that the points of a landmark file on one side, 0 the source and 1 the target, are different points of its mesh.
///
/// # Errors
/// `{"code": "landmarks" | "other-meshes", "message"}`; the second where the file seems to be made for other meshes.
#[wasm_bindgen(js_name = checkLandmarks)]
pub fn check_landmarks(mesh: &LoadedMesh, side: usize, bytes: &[u8]) -> Result<(), JsValue> {
    use landmarks::LandmarkError::{MissingFace, MissingVertex, UnusedVertex};
    let file = landmark_file::read(bytes).map_err(|e| failure("landmarks", e))?;
    let side = if side == 0 { MeshSide::Source } else { MeshSide::Target };
    landmarks::check_side(&mesh.checked, side, &file.pairs).map_err(|e| match e {
        MissingFace { .. } | MissingVertex { .. } | UnusedVertex { .. } => failure("other-meshes", e),
        _ => failure("landmarks", e),
    })
}

/// Vertices of one mesh that are worth a landmark beside those that there are: JSON
/// `[{"point", "reason": "tip" | "far", "partner": number | null}]`, the best first; `point` is a vertex of the file, `partner`
/// the number of the suggestion that looks alike. `landmarks` is a JSON array of landmark points.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = suggestLandmarks)]
pub fn suggest_landmarks(loaded: &LoadedMesh, landmarks: &str, count: usize) -> Result<String, JsValue> {
    let points: Vec<LandmarkPoint> = serde_json::from_str(landmarks).map_err(|e| failure("landmarks", e))?;
    let checked: &CheckedMesh = &loaded.checked;
    let CheckedMesh { mesh, vertex_from_file, .. } = checked;
    let nearest = |point: LandmarkPoint| match point {
        LandmarkPoint::Vertex(v) => vertex_from_file.get(v as usize).copied().flatten(),
        LandmarkPoint::OnFace { face, barycentric } => {
            let face = checked.face_from_file(FaceId(face))?;
            let w = checked.with_file_corners(SurfacePoint { face, barycentric }).barycentric;
            (0..3).max_by(|&a: &usize, &b| w[a].total_cmp(&w[b])).map(|k| mesh.triangles()[face][k])
        }
    };
    let mut marked: Vec<VertexId> = points.into_iter().filter_map(nearest).collect();
    marked.sort_unstable();
    marked.dedup();
    let numbers = checked.file_from_vertex();
    let entry = |s: &Suggestion| json!({ "point": numbers[s.vertex.index()], "reason": s.reason, "partner": s.partner });
    // Who has enough of it ends the worker.
    let suggestions = suggest(mesh, &marked, count, &mut Silent).map_err(|e| failure("cancelled", e))?;
    // What a repair made up has no number in the file, and takes no landmark.
    let suggestions = kept(&suggestions, |v| numbers[v.index()] < vertex_from_file.len());
    let found: Vec<_> = suggestions.iter().map(entry).collect();
    Ok(serde_json::Value::from(found).to_string())
}

/// The mirror image of a target with the landmarks carried along.
#[wasm_bindgen]
pub struct MirroredTarget {
    mesh: Vec<u8>,
    landmarks: Vec<u8>,
}

#[wasm_bindgen]
impl MirroredTarget {
    /// The mirror image as OBJ.
    pub fn mesh(&self) -> Vec<u8> {
        self.mesh.clone()
    }

    /// The landmark file; nothing is said of a true map.
    pub fn landmarks(&self) -> Vec<u8> {
        self.landmarks.clone()
    }
}

/// Mirrors a target, for landmarks whose left and right are exchanged.
///
/// # Errors
/// `{"code": "landmarks" | "mesh", "message"}`.
#[wasm_bindgen(js_name = mirrorTarget)]
pub fn mirror_target(target: &LoadedMesh, landmarks: &[u8]) -> Result<MirroredTarget, JsValue> {
    let mut file = landmark_file::read(landmarks).map_err(|e| failure("landmarks", e))?;
    let mesh = mirrored(&target.checked.mesh).map_err(|e| failure("mesh", e))?;
    // The image's file has the checked mesh's vertices only, and its faces as they were turned.
    for [_, point] in &mut file.pairs {
        let on_mesh = match *point {
            LandmarkPoint::Vertex(v) => {
                let known = target.checked.vertex_from_file.get(v as usize).copied().flatten();
                LandmarkPoint::Vertex(known.map_or(v, |v| v.0))
            }
            LandmarkPoint::OnFace { face, barycentric } => {
                let known = target.checked.face_from_file(FaceId(face));
                known.map_or(*point, |face| {
                    let on_mesh = target.checked.with_file_corners(SurfacePoint { face, barycentric });
                    LandmarkPoint::OnFace { face: face.0, barycentric: on_mesh.barycentric }
                })
            }
        };
        *point = on_mesh.mirrored();
    }
    file.ground_truth = None;
    Ok(MirroredTarget { mesh: export::obj::mesh(&mesh), landmarks: landmark_file::write(&file) })
}

//! Landmark files of many programs, onto the meshes of the page and back.

use super::loaded_mesh::LoadedMesh;
use super::{failure, mesh_side};
use crate::io;
use crate::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use crate::io::landmark_formats::{self, Content, Holds, LandmarkFormat, detect};
use crate::landmark_exchange::{
    ExchangeError, GivenFile, PairLandmarks, PlacedMark, Remark, Surface, read_pairs, read_side, remarks_on,
    write_pairs, write_side,
};
use crate::landmarks::check_side;
use serde::Serialize;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// A format of landmark files.
#[derive(Serialize, tsify::Tsify)]
pub struct LandmarkFormatInfo {
    /// The word by which the core knows the format.
    id: LandmarkFormat,
    /// The format's name.
    title: String,
    /// The usual ending of its files' names, without the first dot.
    ending: &'static str,
    /// The meshes whose landmarks a written file holds.
    holds: Holds,
}

/// The contents of a landmark file.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug)]
pub enum LandmarkContent {
    /// Landmarks of one mesh.
    One = "one",
    /// Landmarks of both meshes, in space.
    Both = "both",
    /// Pairs in the meshes' own numbers, which need no mesh to be read.
    Pairs = "pairs",
}

/// A landmark of one mesh that was read.
#[derive(Serialize)]
pub struct ReadMark {
    /// Its name, empty for none.
    label: String,
    /// A vertex or a point of a face; `null` where the file says that it was not placed.
    point: Option<LandmarkPoint>,
    /// The distance of the given point from the surface, in the units of the mesh.
    distance: f64,
}

/// The landmarks of one mesh that were read.
#[derive(Serialize)]
pub struct ReadSide {
    /// In the order of the file.
    marks: Vec<ReadMark>,
    /// Remarks on the landmarks, as sentences.
    remarks: Vec<String>,
}

/// Pairs in the meshes' own numbers that were read.
#[derive(Serialize)]
pub struct OwnFileRead {
    /// The pairs.
    file: LandmarkFile,
    /// Remarks on the file of the landmarks, as sentences.
    remarks: Vec<String>,
}

/// The landmarks of both meshes that were read.
#[derive(Serialize)]
pub struct ReadPairs {
    /// As a file of the program's own.
    file: LandmarkFile,
    /// The distance of each given point of a pair from the surface, in the units of its mesh.
    distances: Vec<[f64; 2]>,
    /// Remarks on the landmarks, as sentences.
    remarks: Vec<String>,
}

fn sentences(remarks: &[Remark]) -> Vec<String> {
    remarks.iter().map(Remark::to_string).collect()
}

fn as_json(value: &impl Serialize) -> Result<String, JsValue> {
    serde_json::to_string(value).map_err(|e| failure("landmarks", e))
}

/// `{"code", "message", "file"}`: `file` is the number of the file at fault among those given.
fn exchange_failure(error: &ExchangeError) -> JsValue {
    let message = json!({ "code": "landmarks", "message": error.to_string(), "file": error.file() });
    JsValue::from_str(&message.to_string())
}

/// The formats of landmark files: JSON, `LandmarkFormatInfo[]`.
///
/// # Errors
/// None that can be helped.
#[wasm_bindgen(js_name = landmarkFormats)]
pub fn landmark_format_list() -> Result<String, JsValue> {
    let info = |id: LandmarkFormat| LandmarkFormatInfo {
        id,
        title: id.to_string(),
        ending: id.ending(),
        holds: id.holds(),
    };
    as_json(&LandmarkFormat::ALL.map(info))
}

/// The endings of landmark files' names, with their dots, apart by commas: as a file chooser takes them.
#[wasm_bindgen(js_name = landmarkEndings)]
pub fn landmark_endings() -> String {
    // A file chooser knows only what follows the last dot.
    let last = |format: LandmarkFormat| format.ending().rsplit('.').next().unwrap_or_default();
    let mut endings: Vec<_> = LandmarkFormat::ALL.into_iter().map(last).chain(["dta"]).collect();
    endings.sort_unstable();
    endings.dedup();
    endings.into_iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(",")
}

/// The contents of a landmark file; `undefined` for other files.
///
/// # Errors
/// `{"code": "landmarks", "message"}` for a landmark file that cannot be read.
#[wasm_bindgen(js_name = landmarkContent)]
pub fn landmark_content(name: &str, bytes: &[u8]) -> Result<Option<LandmarkContent>, JsValue> {
    let is_named_so = LandmarkFormat::of_name(name).is_some();
    if detect(name, bytes).is_none() && (!is_named_so || io::detect(bytes).is_some()) {
        return Ok(None);
    }
    let (_, content) = landmark_formats::read(name, bytes).map_err(|e| failure("landmarks", e))?;
    Ok(Some(match content {
        Content::Side(_) => LandmarkContent::One,
        Content::Sides(_) => LandmarkContent::Both,
        Content::Pairs(_) => LandmarkContent::Pairs,
    }))
}

/// Reads the landmarks of one mesh from a file that holds no more, and puts them on it: JSON, `ReadSide`. `side` is 0 for the
/// source and 1 for the target.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = readLandmarkSide)]
pub fn read_landmark_side(
    name: &str,
    bytes: &[u8],
    mesh: &LoadedMesh,
    side: usize,
) -> Result<String, JsValue> {
    let side = mesh_side(side)?;
    let read =
        read_side(GivenFile { name, bytes }, mesh.surface(), side).map_err(|e| exchange_failure(&e))?;
    let points = read.marks.iter().filter_map(|mark| mark.point);
    let pairs: Vec<_> = points.map(|point| [point; 2]).collect();
    check_side(&mesh.checked, side, &pairs).map_err(|e| failure("landmarks", e))?;
    let marks = read.marks.into_iter();
    let marks =
        marks.map(|PlacedMark { label, point, distance }| ReadMark { label, point, distance }).collect();
    as_json(&ReadSide { marks, remarks: sentences(&read.remarks) })
}

/// Reads a file of the program's own format, which needs no mesh to be read: JSON, `OwnFileRead`.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = readLandmarks)]
pub fn read_landmarks(bytes: &[u8]) -> Result<String, JsValue> {
    let file = landmark_file::read(bytes).map_err(|e| failure("landmarks", e))?;
    let remarks = sentences(&remarks_on(&file, bytes));
    as_json(&OwnFileRead { file, remarks })
}

/// Reads the landmarks of both meshes, from one file that holds both or from the source's and the target's: JSON, `ReadPairs`.
///
/// # Errors
/// `{"code": "landmarks", "message", "file"}`, `file` being the number of the file at fault, or `null`.
#[wasm_bindgen(js_name = readLandmarkPairs)]
pub fn read_landmark_pairs(
    names: Vec<String>,
    contents: Vec<js_sys::Uint8Array>,
    source: &LoadedMesh,
    target: &LoadedMesh,
) -> Result<String, JsValue> {
    let contents: Vec<Vec<u8>> = contents.iter().map(js_sys::Uint8Array::to_vec).collect();
    let files: Vec<_> = names.iter().zip(&contents).map(|(name, bytes)| GivenFile { name, bytes }).collect();
    let read = read_pairs(&files, [source.surface(), target.surface()]).map_err(|e| exchange_failure(&e))?;
    let PairLandmarks { file, distances, remarks, .. } = read;
    as_json(&ReadPairs { file, distances, remarks: sentences(&remarks) })
}

fn format_and_file(format: &str, landmarks: &[u8]) -> Result<(LandmarkFormat, LandmarkFile), JsValue> {
    let format =
        LandmarkFormat::of_id(format).ok_or_else(|| failure("landmarks", "there is no such format"))?;
    Ok((format, landmark_file::read(landmarks).map_err(|e| failure("landmarks", e))?))
}

/// Writes the landmarks of both meshes, given as a file of the program's own, as one file of a format.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = writeLandmarkPairs)]
pub fn write_landmark_pairs(
    format: &str,
    landmarks: &[u8],
    source: &LoadedMesh,
    target: &LoadedMesh,
) -> Result<Vec<u8>, JsValue> {
    let (format, file) = format_and_file(format, landmarks)?;
    let surfaces: [Surface<'_>; 2] = [source.surface(), target.surface()];
    write_pairs(format, &file, surfaces).map_err(|e| failure("landmarks", e))
}

/// Writes the landmarks of one mesh, given as a file of the program's own, as a file of a format. `side` is 0 for the source and
/// 1 for the target.
///
/// # Errors
/// `{"code": "landmarks", "message"}`.
#[wasm_bindgen(js_name = writeLandmarkSide)]
pub fn write_landmark_side(
    format: &str,
    landmarks: &[u8],
    mesh: &LoadedMesh,
    side: usize,
) -> Result<Vec<u8>, JsValue> {
    let (format, file) = format_and_file(format, landmarks)?;
    write_side(format, &file, mesh.surface(), mesh_side(side)?).map_err(|e| failure("landmarks", e))
}

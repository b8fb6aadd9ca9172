//! Saved maps: opened with their meshes, measured, and written as files (`conemap report`, `conemap export`).

use crate::arguments::{ExportArguments, ReportArguments, SavedMapArguments};
use crate::input::{self, Failure};
use crate::outputs;
use crate::told::print;
use conemap::job::{MapFiles, OpenMap};
use conemap::landmarks::MeshSide;
use serde_json::json;
use std::path::Path;

/// Opens a map file with its meshes; a fault is told with the file's name.
pub fn open(arguments: &SavedMapArguments) -> Result<OpenMap, Failure> {
    let [map, source, target] = [&arguments.map, &arguments.source, &arguments.target];
    let bytes = [input::bytes(map)?, input::mesh_bytes(source)?, input::mesh_bytes(target)?];
    OpenMap::read(MapFiles { map: &bytes[0], source: &bytes[1], target: &bytes[2] }).map_err(|error| {
        let file = match error.side() {
            Some(MeshSide::Source) => source,
            Some(MeshSide::Target) => target,
            None => map,
        };
        format!("{}: {error}", file.display()).into()
    })
}

/// Measures the map from its pieces and tells it as JSON.
pub fn report(arguments: &ReportArguments) -> Result<(), Failure> {
    outputs::check(arguments.saved.files(), arguments.out.clone())?;
    let open = open(&arguments.saved)?;
    let map = open.taken();
    let [source, target] = map.surfaces().map(|mesh| mesh.face_count());
    let value = json!({
        "distortion": map.distortion(),
        "faces": { "source": source, "target": target },
        "pieces": map.map().correspondence.pieces.len(),
        "landmarks": map.map().landmarks.pairs.len(),
        "options": map.map().options,
    });
    write_or_print(arguments.out.as_deref(), &serde_json::to_vec_pretty(&value)?)
}

/// Writes all files of the map.
pub fn export(arguments: &ExportArguments) -> Result<(), Failure> {
    outputs::check(arguments.saved.files(), outputs::of_folder(&arguments.out))?;
    let open = open(&arguments.saved)?;
    let map = open.taken();
    let files = map.kinds().into_iter().map(|kind| Ok((kind.file_name(), map.output(kind)?)));
    outputs::write_all(&arguments.out, files)
}

/// To a file, or to standard output where there is none.
pub fn write_or_print(file: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    match file {
        Some(path) => outputs::write(path, bytes),
        None => print(String::from_utf8_lossy(bytes).trim_end()),
    }
}

//! Saved maps: opened with their meshes, measured, and written as files (`conemap report`, `conemap export`).

use crate::arguments::{ExportArguments, ReportArguments, SavedMapArguments};
use crate::input::{self, Failure, MeshSets};
use crate::outputs;
use conemap::job::{MapFiles, MapLook, OpenMap};
use conemap::landmarks::MeshSide;
use serde_json::json;
use std::fmt::Display;
use std::path::Path;

/// A saved map's file and those of its meshes, as they were read.
pub struct SavedFiles<'a> {
    paths: &'a SavedMapArguments,
    map: Vec<u8>,
    meshes: [Vec<u8>; 2],
}

impl<'a> SavedFiles<'a> {
    /// Reads the files.
    pub fn read(paths: &'a SavedMapArguments) -> Result<Self, Failure> {
        let meshes = [input::mesh_bytes(&paths.source)?, input::mesh_bytes(&paths.target)?];
        Ok(Self { paths, map: input::bytes(&paths.map)?, meshes })
    }

    /// The bytes of all three.
    pub fn bytes(&self) -> MapFiles<'_> {
        MapFiles { map: &self.map, source: &self.meshes[0], target: &self.meshes[1] }
    }

    /// Opens the map; an error names the file.
    pub fn open(&self) -> Result<OpenMap, Failure> {
        OpenMap::read(self.bytes()).map_err(|error| self.told(error.side(), &error))
    }

    /// The look that the map carries; prints remarks on the parts that cannot be used.
    pub fn look(&self, open: &OpenMap) -> MapLook {
        let paths = [&*self.paths.source, &*self.paths.target];
        let sets = MeshSets::of(paths, self.meshes.each_ref().map(Vec::as_slice));
        sets.look(|files| open.look(files))
    }

    /// A sentence on a mesh's file, or on the map's where it is about neither.
    pub fn told(&self, side: Option<MeshSide>, error: &dyn Display) -> Failure {
        let file = match side {
            Some(MeshSide::Source) => &self.paths.source,
            Some(MeshSide::Target) => &self.paths.target,
            None => &self.paths.map,
        };
        format!("{}: {error}", file.display()).into()
    }
}

/// Measures the map from its pieces and tells it as JSON.
pub fn report(arguments: &ReportArguments) -> Result<(), Failure> {
    outputs::check(arguments.saved.files(), arguments.out.clone())?;
    let open = SavedFiles::read(&arguments.saved)?.open()?;
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
    let saved = SavedFiles::read(&arguments.saved)?;
    let open = saved.open()?;
    let look = saved.look(&open);
    let map = open.taken().wearing(&look);
    let files = map.kinds().into_iter().map(|kind| Ok((kind.file_name(), map.output(kind)?)));
    outputs::write_all(&arguments.out, files)
}

/// To a file, or to standard output where there is none.
pub fn write_or_print(file: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    outputs::write(file.unwrap_or(Path::new("-")), bytes)
}

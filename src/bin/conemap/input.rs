//! Meshes and landmarks from files, with errors that name the file.

use crate::arguments::FaultArguments;
use conemap::export::MeshFormat;
use conemap::io::{self, gltf_parts};
use conemap::job::{ReadMesh, read_mesh};
use conemap::landmark_exchange::GivenFile;
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::soup::PolygonSoup;
use conemap::monitor::Silent;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Component, Path};

/// What the command line fails with: a sentence.
pub type Failure = Box<dyn Error>;

/// Reads a file.
pub fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// Reads a mesh, with what it keeps in files beside it, unchecked.
pub fn soup(path: &Path) -> Result<PolygonSoup, Failure> {
    io::read_mesh(&mesh_bytes(path)?).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// The format of a mesh to be written, by its name.
pub fn format(out: &Path) -> Result<MeshFormat, Failure> {
    MeshFormat::of(out).ok_or_else(|| {
        let known = MeshFormat::ALL.map(|format| format!(".{}", format.ending())).join(", ");
        format!("{}: the name must end in one of {known}", out.display()).into()
    })
}

/// Reads the file of a mesh, with what it keeps in files beside it.
pub fn mesh_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let own = bytes(path)?;
    let parts = gltf_parts::parts_of(&own);
    if parts.buffers.is_empty() {
        return Ok(own);
    }
    // What a file names is read from its own folder and those below, and from nowhere else.
    let folder = path.parent().unwrap_or(Path::new(""));
    let is_below = |name: &str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
    let names = parts.buffers.into_iter().chain(parts.images).filter(|name| is_below(name));
    let contents: BTreeMap<String, Vec<u8>> = names
        .filter_map(|name| std::fs::read(folder.join(&name)).ok().map(|content| (name, content)))
        .collect();
    let find = |name: &str| contents.get(name).map(Vec::as_slice);
    let packed = gltf_parts::packed(&own, find).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(packed.bytes)
}

/// Reads a mesh, and checks or repairs it.
pub fn mesh(path: &Path, faults: FaultArguments) -> Result<CheckedMesh, Failure> {
    checked(path, &mesh_bytes(path)?, faults)
}

/// Checks or repairs a mesh that was read from a file; what was repaired is told.
pub fn checked(path: &Path, bytes: &[u8], faults: FaultArguments) -> Result<CheckedMesh, Failure> {
    let name = path.display();
    let ReadMesh { mesh, report } =
        read_mesh(bytes, faults.into(), &mut Silent).map_err(|e| format!("{name}: {e}"))?;
    if report.fault.is_some() {
        eprintln!(
            "warning: {name} could not be used as it is and was repaired: {}. `conemap check` tells more and writes the repaired \
             mesh.",
            report.sentence()
        );
    }
    Ok(mesh.into_checked())
}

/// Files with their names.
pub struct NamedFiles(Vec<(String, Vec<u8>)>);

impl NamedFiles {
    /// Reads files.
    pub fn read<P: AsRef<Path>>(paths: &[P]) -> Result<Self, Failure> {
        let file = |path: &P| Ok((path.as_ref().display().to_string(), bytes(path.as_ref())?));
        Ok(Self(paths.iter().map(file).collect::<Result<_, Failure>>()?))
    }

    /// As landmark files.
    pub fn given(&self) -> Vec<GivenFile<'_>> {
        self.0.iter().map(|(name, bytes)| GivenFile { name, bytes }).collect()
    }
}

/// Writes a file, with the folder above it.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    std::fs::write(path, bytes).map_err(|e| format!("{}: {e}", path.display()).into())
}

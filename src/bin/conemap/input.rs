//! Meshes and landmarks from files, with errors that name the file.

use conemap::export::MeshFormat;
use conemap::io;
use conemap::mesh::check::{CheckedMesh, closed_genus_zero};
use conemap::mesh::soup::PolygonSoup;
use std::error::Error;
use std::path::Path;

/// What the command line fails with: a sentence.
pub type Failure = Box<dyn Error>;

/// Reads a file.
pub fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// Reads a mesh, unchecked.
pub fn soup(path: &Path) -> Result<PolygonSoup, Failure> {
    io::read_mesh(&bytes(path)?).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// The format of a mesh to be written, by its name.
pub fn format(out: &Path) -> Result<MeshFormat, Failure> {
    MeshFormat::of(out).ok_or_else(|| {
        let known = MeshFormat::ALL.map(|format| format!(".{}", format.ending())).join(", ");
        format!("{}: the name must end in one of {known}", out.display()).into()
    })
}

/// Reads and checks a mesh.
pub fn mesh(path: &Path) -> Result<CheckedMesh, Failure> {
    let soup = soup(path)?;
    closed_genus_zero(&soup).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// Writes a file, with the folder above it.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    std::fs::write(path, bytes).map_err(|e| format!("{}: {e}", path.display()).into())
}

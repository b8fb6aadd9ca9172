//! Everything that reads bytes which a user gives, and what it says to them.

use conemap::io::landmark_formats::{self, LandmarkFormat};
use conemap::io::{Format, detect, gltf_parts, read_mesh};
use conemap::map_file::{self, FileMesh};
use conemap::mesh::check::closed_genus_zero;
use std::sync::LazyLock;

/// A reader of bytes; each is a target of the fuzzer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// A mesh of one format.
    Mesh(Format),
    /// A landmark file of one format.
    Landmarks(LandmarkFormat),
    /// A map file.
    Map,
}

/// The mesh that map files are read with.
static TETRAHEDRON: LazyLock<FileMesh> = LazyLock::new(|| {
    FileMesh::read(b"OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n").unwrap()
});

impl Reader {
    /// All of them.
    pub fn all() -> Vec<Self> {
        let meshes = Format::ALL.into_iter().map(Self::Mesh);
        meshes.chain(LandmarkFormat::ALL.into_iter().map(Self::Landmarks)).chain([Self::Map]).collect()
    }

    /// Its name.
    pub fn name(self) -> String {
        match self {
            Self::Mesh(format) => format.to_string(),
            Self::Landmarks(format) => format!("landmarks {}", format.id()),
            Self::Map => "map file".to_owned(),
        }
    }

    /// Whether a file is of its kind.
    pub fn reads(self, name: &str, bytes: &[u8]) -> bool {
        match self {
            Self::Mesh(format) => detect(bytes) == Some(format),
            Self::Landmarks(format) => landmark_formats::detect(name, bytes) == Some(format),
            Self::Map => bytes.starts_with(b"CONEMAP\0"),
        }
    }

    /// Reads bytes, whatever they are.
    pub fn read(self, bytes: &[u8]) -> String {
        match self {
            Self::Mesh(format) => {
                if format == Format::Gltf && !gltf_parts::parts_of(bytes).is_empty() {
                    drop(gltf_parts::packed(bytes, |_| Some(bytes)));
                }
                mesh(bytes)
            }
            Self::Landmarks(format) => landmarks(&format!("a.{}", format.ending()), bytes),
            Self::Map => match map_file::read(bytes, [&TETRAHEDRON; 2]) {
                Ok(map) => format!("{} pieces", map.correspondence.pieces.len()),
                Err(error) => error.to_string(),
            },
        }
    }
}

/// Reads and checks a mesh.
pub fn mesh(bytes: &[u8]) -> String {
    let soup = match read_mesh(bytes) {
        Ok(soup) => soup,
        Err(error) => return error.to_string(),
    };
    match closed_genus_zero(&soup) {
        Ok(checked) => {
            format!("{} vertices, {} faces", checked.mesh.vertex_count(), checked.mesh.face_count())
        }
        Err(fault) => fault.to_string(),
    }
}

/// Reads a landmark file.
pub fn landmarks(name: &str, bytes: &[u8]) -> String {
    match landmark_formats::read(name, bytes) {
        Ok((format, _)) => format!("landmarks, {}", format.id()),
        Err(error) => error.to_string(),
    }
}

//! The readers of all bytes that a user may give, and their answers.

use conemap::io::landmark_formats::{self, LandmarkFormat};
use conemap::io::moved::{self, MoveError, Normals};
use conemap::io::{
    Format, curve_file, detect, gltf_parts, point_table, read_mesh, texture_coordinates, vertex_table,
};
use conemap::map_file::{self, FileMesh};
use conemap::mesh::check::closed_genus_zero;
use conemap::transfer::given_file;
use std::sync::LazyLock;

/// A reader of bytes; each is a target of the fuzzer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// A mesh of one format.
    Mesh(Format),
    /// A landmark file of one format.
    Landmarks(LandmarkFormat),
    /// Values at the vertices of a mesh.
    VertexTable,
    /// Curves on a mesh.
    Curves,
    /// Points of a mesh.
    Points,
    /// Texture coordinates of a mesh file.
    TextureCoordinates,
    /// A mesh file whose vertices are moved.
    Moved,
    /// A map file.
    Map,
}

/// The mesh with which map files, tables and curves are read: an octahedron.
pub static MESH: LazyLock<FileMesh> = LazyLock::new(|| {
    let file =
        b"OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n\
                 3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
    FileMesh::read(file).unwrap()
});

impl Reader {
    /// All readers.
    pub fn all() -> Vec<Self> {
        let meshes = Format::ALL.into_iter().map(Self::Mesh);
        let others =
            [Self::VertexTable, Self::Curves, Self::Points, Self::TextureCoordinates, Self::Moved, Self::Map];
        meshes.chain(LandmarkFormat::ALL.into_iter().map(Self::Landmarks)).chain(others).collect()
    }

    /// The readers for large files. The format of a mesh is recognised by its content, so that one reader stands for all formats.
    pub fn of_large_files() -> Vec<Self> {
        let landmarks = Self::Landmarks(LandmarkFormat::Conemap);
        vec![
            Self::Mesh(Format::Obj),
            landmarks,
            Self::VertexTable,
            Self::Curves,
            Self::Points,
            Self::TextureCoordinates,
            Self::Moved,
            Self::Map,
        ]
    }

    /// The name of the reader.
    pub fn name(self) -> String {
        match self {
            Self::Mesh(format) => format.to_string(),
            Self::Landmarks(format) => format!("landmarks {}", format.id()),
            Self::VertexTable => "vertex table".to_owned(),
            Self::Curves => "curves".to_owned(),
            Self::Points => "points".to_owned(),
            Self::TextureCoordinates => "texture coordinates".to_owned(),
            Self::Moved => "moved".to_owned(),
            Self::Map => "map file".to_owned(),
        }
    }

    /// Whether the reader is meant for a file.
    pub fn reads(self, name: &str, bytes: &[u8]) -> bool {
        match self {
            Self::Mesh(format) => detect(bytes) == Some(format),
            Self::Landmarks(format) => landmark_formats::detect(name, bytes) == Some(format),
            Self::VertexTable => name.starts_with("table"),
            Self::Curves => name.starts_with("curves"),
            Self::Points => name.starts_with("points"),
            Self::TextureCoordinates => name.starts_with("texture"),
            Self::Moved => matches!(detect(bytes), Some(Format::Obj | Format::Off)),
            Self::Map => bytes.starts_with(b"CONEMAP\0"),
        }
    }

    /// Reads any bytes and returns the answer.
    pub fn read(self, bytes: &[u8]) -> String {
        if matches!(self, Self::VertexTable | Self::Curves) {
            // The page asks first what a file may hold that the user wants to bring across a map.
            drop(given_file(bytes));
        }
        match self {
            Self::Mesh(format) => {
                if format == Format::Gltf && !gltf_parts::parts_of(bytes).is_empty() {
                    drop(gltf_parts::packed(bytes, |_| Some(bytes)));
                }
                mesh(bytes)
            }
            Self::Landmarks(format) => landmarks(&format!("a.{}", format.ending()), bytes),
            Self::VertexTable => match vertex_table::read(bytes, MESH.file_vertices()) {
                Ok(table) => format!("{} columns", table.columns.len()),
                Err(error) => error.to_string(),
            },
            Self::Curves => match curve_file::read(bytes, MESH.file_vertices()) {
                Ok(curves) => format!("{} curves", curves.len()),
                Err(error) => error.to_string(),
            },
            Self::Points => match point_table::read(bytes) {
                Ok(points) => format!("{} points", points.len()),
                Err(error) => error.to_string(),
            },
            Self::TextureCoordinates => match texture_coordinates::read(bytes) {
                Ok(corners) => format!("{} polygons with texture coordinates", corners.len()),
                Err(error) => error.to_string(),
            },
            Self::Moved => moved(bytes),
            Self::Map => map(bytes),
        }
    }
}

/// Reads and checks a mesh, and returns the answer.
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

/// Moves the vertices of a mesh file, or says why that is not possible. In every file that can be read the places of the vertices are
/// known, so that nothing else may change; without its normals a file may look like one of another format.
fn moved(bytes: &[u8]) -> String {
    let [kept, dropped] = [Normals::Kept, Normals::Dropped].map(|normals| moved::check(bytes, normals));
    assert!(!matches!(kept, Err(MoveError::ReadsOtherwise(_) | MoveError::Unreadable(_))), "{kept:?}");
    match kept.and(dropped) {
        Ok(()) => "can be moved".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// Reads a map of the octahedron onto itself, and returns the answer.
fn map(bytes: &[u8]) -> String {
    match map_file::read(bytes, [&MESH; 2]) {
        Ok(map) => format!("{} pieces", map.correspondence.pieces.len()),
        Err(error) => error.to_string(),
    }
}

/// Reads a landmark file, and returns the answer.
pub fn landmarks(name: &str, bytes: &[u8]) -> String {
    match landmark_formats::read(name, bytes) {
        Ok((format, _)) => format!("landmarks, {}", format.id()),
        Err(error) => error.to_string(),
    }
}

//! A finished map between the meshes of two files.

use crate::map_file::FileMesh;
use crate::mesh::SurfaceMesh;
use crate::surface_map::correspondence::Correspondence;

/// A map that has passed [`crate::surface_map::correspondence::check`] with its meshes, source first.
#[derive(Clone, Copy, Debug)]
pub struct MappedFiles<'a> {
    /// The meshes with the numbers of their files.
    pub files: [&'a FileMesh; 2],
    /// The map.
    pub map: &'a Correspondence,
}

impl<'a> MappedFiles<'a> {
    /// The meshes that are mapped.
    pub fn meshes(&self) -> [&'a SurfaceMesh; 2] {
        self.files.map(FileMesh::mesh)
    }
}

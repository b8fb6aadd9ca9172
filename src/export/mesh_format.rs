//! The format of a mesh file by the ending of its name.

use super::{obj, off, ply};
use crate::io::Format;
use crate::mesh::SurfaceMesh;
use std::path::Path;

/// A format in which meshes are written: one of those that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ, text.
    Obj,
    /// OFF, text.
    Off,
    /// PLY, binary.
    Ply,
}

impl MeshFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Obj, Self::Off, Self::Ply];

    /// The format as it is read.
    pub fn format(self) -> Format {
        match self {
            Self::Obj => Format::Obj,
            Self::Off => Format::Off,
            Self::Ply => Format::Ply,
        }
    }

    /// The usual ending of its files' names, without the dot.
    pub fn ending(self) -> &'static str {
        self.format().endings()[0]
    }

    /// The format that the ending of a file's name says, in capitals or not; `None` where it is none of these.
    pub fn of(file: &Path) -> Option<Self> {
        let ending = file.extension()?.to_str()?;
        let is_its = |format: &Self| format.format().endings().iter().any(|e| e.eq_ignore_ascii_case(ending));
        Self::ALL.into_iter().find(is_its)
    }

    /// The contents of a file of this format.
    pub fn write(self, mesh: &SurfaceMesh) -> Vec<u8> {
        match self {
            Self::Obj => obj::mesh(mesh),
            Self::Off => off::mesh(mesh),
            Self::Ply => ply::mesh(mesh),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;
    use crate::mesh::check::closed_genus_zero;
    use crate::mesh::generators::icosphere;

    #[test]
    fn the_reader_reads_every_format_back() {
        let sphere = icosphere(2);
        for format in MeshFormat::ALL {
            let soup = read_mesh(&format.write(&sphere)).unwrap();
            let back = closed_genus_zero(&soup).unwrap().mesh;
            assert_eq!(back.positions(), sphere.positions(), "{format:?}");
            assert_eq!(back.triangles(), sphere.triangles(), "{format:?}");
        }
    }

    #[test]
    fn names_say_their_format() {
        for format in MeshFormat::ALL {
            let name = format!("folder.stl/mesh.{}", format.ending());
            assert_eq!(MeshFormat::of(Path::new(&name)), Some(format));
            assert_eq!(MeshFormat::of(Path::new(&name.to_uppercase())), Some(format));
        }
        for name in ["mesh", "mesh.stl", "mesh.obj/", "obj", ".obj", ""] {
            let expected = (name == "mesh.obj/").then_some(MeshFormat::Obj);
            assert_eq!(MeshFormat::of(Path::new(name)), expected, "{name}");
        }
    }
}

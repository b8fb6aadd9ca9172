//! Map files: a finished map as bytes, and back without computing.
//!
//! `docs/map-file.md` describes the format. A file holds the pieces of the map with the places of their corners in the numbers of
//! both mesh files, the target's texture coordinates, both meshes on the flat base domain, the landmarks, the options and the
//! report. It needs both meshes to be read. Everything in it is hostile until checked: sizes first, then every index and number
//! against the meshes, then the whole as a map ([`crate::surface_map::correspondence::check`]).

mod container;
mod content;
mod error;
mod file_mesh;
mod header;
mod numbering;
mod read;
#[cfg(test)]
mod tests;
mod version;
mod write;

pub use content::MapFile;
pub use error::{MapFileError, SectionProblem};
pub use file_mesh::{FileMesh, FileMeshError, Hash};
pub use header::Summary;
pub use read::{WantedMesh, read, target_image, wanted_meshes};
pub use version::{ENDING, is_one};
pub use write::write;

//! Bytes to polygon soups and landmark files. One file per format; formats are recognised by content, not by name.
//!
//! Everything is hostile until checked: sizes are compared with the file before anything is allocated.

pub mod appearance;
pub mod curve_file;
mod data_uri;
mod detection;
mod format;
mod gltf_container;
mod gltf_document;
mod gltf_file;
mod gltf_library;
mod gltf_look;
pub mod gltf_parts;
pub mod landmark_file;
pub mod landmark_formats;
mod look_remark;
pub mod material_set;
mod mesh_reader;
pub mod moved;
mod obj;
mod off;
mod off_colours;
mod other_file;
pub mod picture;
mod ply;
pub mod point_table;
mod problem;
mod reading;
pub(crate) mod separated;
mod stl;
pub mod texture_coordinates;
pub mod vertex_table;
mod written_text;

pub use detection::detect;
pub use format::Format;
pub use look_remark::LookRemark;
pub use mesh_reader::{MAX_BYTES, ReadError, read_mesh, read_mesh_asking};
pub use other_file::OtherFile;
pub use problem::Place;

#[cfg(test)]
mod tests;

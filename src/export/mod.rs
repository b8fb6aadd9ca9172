//! Results to bytes.

pub mod csv;
pub mod curves;
pub mod flat_sheet;
pub mod glb;
mod glb_document;
pub mod layout;
mod mesh_format;
pub mod morph_glb;
pub mod obj;
pub mod off;
pub mod picture;
pub mod ply;
pub mod skin;
pub mod vertex_image;
pub mod vertex_table;

pub use mesh_format::MeshFormat;

//! Results to bytes.

pub mod csv;
pub mod glb;
mod mesh_format;
pub mod obj;
pub mod off;
pub mod ply;

pub use mesh_format::MeshFormat;

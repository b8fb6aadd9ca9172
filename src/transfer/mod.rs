//! What maps are for: values, curves, shapes and motions of one mesh brought to the other, by the pieces of a finished map.
//!
//! Nothing here computes a map. Everything is exact on the overlay: on each of its triangles the map is affine.

pub mod attributes;
mod cells;
pub mod curves;
pub mod deformation;
mod face_turns;
pub mod frames;
mod gradients;
mod mapped_files;
mod mass;
pub mod morph;
mod poisson;
pub mod shape;
#[cfg(test)]
mod tests;
pub mod texture;
mod values;

pub use mapped_files::MappedFiles;
pub use values::{Carrying, ValueCarrier, ValueError, Values};

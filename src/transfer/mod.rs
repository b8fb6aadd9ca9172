//! Transfer of values, curves, shapes and motions of one mesh to the other, by the pieces of a finished map.
//!
//! Nothing here computes a map. Everything is exact on the overlay: on each of its triangles the map is affine.

pub mod attributes;
mod cells;
pub mod curves;
pub mod deformation;
mod face_turns;
mod fault;
mod files;
mod formats;
pub mod frames;
mod given_kind;
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

pub use fault::{ChartFault, FaultyFile, GivenFault, TransferError};
pub use files::{CarriedValues, FileTransfer, Motion, Raster, USUAL_GIVER, ValueOptions, frame_name};
pub use formats::{CurveFormat, ValueFormat};
pub use given_kind::{GivenFile, GivenKind, GivenKindError, given_file};
pub use mapped_files::MappedFiles;
pub use values::{Carrying, ValueCarrier, ValueError, Values};

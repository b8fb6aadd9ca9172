//! Landmark files of many programs brought onto meshes, and landmarks on meshes written as such files.
//!
//! Points in space are put on the nearest point of the surface, and their distances are kept; the lists of two meshes are paired by equal
//! labels, or else by order.

mod mesh_names;
mod pairing;
mod problem;
mod projection;
mod reading;
mod remark;
mod surface;
mod writing;

pub use mesh_names::compare_names;
pub use problem::{Advice, ExchangeError};
pub use projection::{PlacedMark, SideLandmarks};
pub use reading::{GivenFile, PairLandmarks, read_pairs, read_side, remarks_on};
pub use remark::Remark;
pub use surface::Surface;
pub use writing::{ExchangeWriteError, write_pairs, write_side};

#[cfg(test)]
mod tests;

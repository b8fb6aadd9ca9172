//! Landmark files of many programs: bytes to named points and back. One file per format; formats are recognised by content, and the ending
//! of a file's name only decides among what the content allows.
//!
//! Nothing here knows a mesh: points are on a surface where the format says so, and in space elsewhere.
//! [`crate::landmark_exchange`] brings them onto meshes.

mod comma_separated;
mod content;
mod detection;
mod fcsv;
mod format;
mod idav;
mod limits;
mod meshlab;
mod nts;
mod problem;
mod reading;
mod slicer_json;
mod text;
mod tps;
mod wrap;
mod writing;

pub use content::{Content, Mark, MarkList, Space, Spot, SurfaceMark, SurfaceMarks, half_turned};
pub use detection::detect;
pub use format::{Holds, LandmarkFormat};
pub use limits::{MAX_BYTES, MAX_POINTS};
pub use problem::{LandmarkReadError, LandmarkWriteError};
pub use reading::read;
pub use writing::write;

#[cfg(test)]
mod tests;

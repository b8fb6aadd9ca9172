//! Why a landmark file cannot be read or written.

use super::format::LandmarkFormat;
use super::limits::MAX_BYTES;
use crate::io::landmark_file::LandmarkFileError;
use crate::io::problem::Place;

/// Why a landmark file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LandmarkReadError {
    /// The file has no known format.
    #[error("this is no landmark file that can be read: use {}", LandmarkFormat::NAMES)]
    UnknownFormat,
    /// The file is too large.
    #[error("the landmark file has {bytes} bytes; the limit is {MAX_BYTES}")]
    TooLarge {
        /// The file's size in bytes.
        bytes: usize,
    },
    /// Something in a file of the program's own format is wrong.
    #[error(transparent)]
    Own(#[from] LandmarkFileError),
    /// Something in a file of another format is wrong.
    #[error("{format} file, {place}: {problem}")]
    Malformed {
        /// The file's format.
        format: LandmarkFormat,
        /// The place of the fault.
        place: Place,
        /// The problem and its remedy.
        problem: String,
    },
    /// The file holds no landmarks.
    #[error("{format} file: it holds no landmarks")]
    Empty {
        /// The file's format.
        format: LandmarkFormat,
    },
    /// The file holds more lists than there are meshes.
    #[error(
        "{format} file: it holds the landmarks of {count} meshes ({names}): keep one, or two with the source's first"
    )]
    TooManyLists {
        /// The file's format.
        format: LandmarkFormat,
        /// Number of lists.
        count: usize,
        /// The first names of the lists.
        names: String,
    },
}

/// Why landmarks cannot be written in a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LandmarkWriteError {
    /// The landmarks of both meshes do not fit into one file.
    #[error("a {0} file holds the landmarks of one mesh: write two files")]
    OnlyOneMesh(LandmarkFormat),
    /// The landmarks of one mesh are no pairs.
    #[error("a {0} file holds pairs, the landmarks of both meshes: write one file")]
    OnlyBothMeshes(LandmarkFormat),
}

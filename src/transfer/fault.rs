//! Why files cannot be brought over, and which of them is at fault.

use super::attributes::AttributeError;
use super::curves::CurveError;
use super::deformation::DeformationError;
use super::frames::FrameError;
use super::texture::BakeError;
use super::values::ValueError;
use crate::io::curve_file::CurveFileError;
use crate::io::picture::PictureError;
use crate::io::texture_coordinates::TextureCoordinateError;
use crate::io::vertex_table::TableError;
use crate::landmarks::MeshSide;
use crate::monitor::Cancelled;

/// Why nothing was brought over. Its sentence is to stand behind the name of [`Self::file`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransferError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A file that was to be brought over is at fault.
    #[error("{fault}")]
    Given {
        /// The number of the file among them, from 0.
        number: usize,
        /// The fault.
        fault: GivenFault,
    },
    /// A mesh file's texture coordinates cannot be used.
    #[error("{fault}")]
    Mesh {
        /// The mesh at fault.
        side: MeshSide,
        /// The fault.
        fault: ChartFault,
    },
    /// The result could not be written as a file.
    #[error("the file could not be written: {0}")]
    Unwritten(String),
}

/// The file at fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultyFile {
    /// One of those that were to be brought over, by its number.
    Given(usize),
    /// A mesh's file.
    Mesh(MeshSide),
}

impl TransferError {
    /// The file at fault; `None` where none is.
    pub fn file(&self) -> Option<FaultyFile> {
        match self {
            Self::Given { number, .. } => Some(FaultyFile::Given(*number)),
            Self::Mesh { side, .. } => Some(FaultyFile::Mesh(*side)),
            Self::Cancelled(_) | Self::Unwritten(_) => None,
        }
    }

    /// The error about a fault of a file; a user's wish to stop is passed on as such.
    pub(super) fn given(number: usize, fault: impl Into<GivenFault>) -> Self {
        match fault.into() {
            GivenFault::Attribute(AttributeError::Value(ValueError::Cancelled(stop)))
            | GivenFault::Curve(CurveError::Cancelled(stop))
            | GivenFault::Deformation(DeformationError::Cancelled(stop)) => stop.into(),
            fault => Self::Given { number, fault },
        }
    }

    /// The error about a mesh's texture coordinates, likewise.
    pub(super) fn chart(side: MeshSide, fault: impl Into<ChartFault>) -> Self {
        match fault.into() {
            ChartFault::Bake(BakeError::Cancelled(stop)) => stop.into(),
            fault => Self::Mesh { side, fault },
        }
    }
}

/// A fault of a file that was to be brought over.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GivenFault {
    /// It is no table of values.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Its values cannot be brought over.
    #[error(transparent)]
    Attribute(#[from] AttributeError),
    /// It has no curves.
    #[error(transparent)]
    CurveFile(#[from] CurveFileError),
    /// Its curves do not lie on the mesh.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// It is no picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// It is no frame.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// Its motion could not be brought over.
    #[error(transparent)]
    Deformation(#[from] DeformationError),
}

/// A fault of the texture coordinates of a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChartFault {
    /// They cannot be read.
    #[error(transparent)]
    Read(#[from] TextureCoordinateError),
    /// No picture can be baked over them.
    #[error(transparent)]
    Bake(#[from] BakeError),
}

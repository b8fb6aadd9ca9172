//! Why a job has no result, and which of its files is at fault.

use super::memory::mib;
use super::mesh_file::MeshFileError;
use crate::io::ReadError;
use crate::landmark_exchange::ExchangeError;
use crate::landmark_matching::MatchError;
use crate::landmarks::{LandmarkError, MeshSide};
use crate::mesh::MeshError;
use crate::mesh::check::MeshFault;
use crate::mesh::repair::RepairRefusal;
use crate::monitor::Cancelled;
use crate::pipeline::PipelineError;

/// Why a job has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JobError {
    /// A mesh file cannot be read.
    #[error("{error}")]
    Read {
        /// The mesh at fault.
        side: MeshSide,
        /// The reason.
        error: ReadError,
    },
    /// A mesh is not one closed surface of genus 0.
    #[error("{fault}")]
    Mesh {
        /// The mesh at fault.
        side: MeshSide,
        /// The fault of the mesh.
        fault: MeshFault,
    },
    /// A mesh is not one closed surface of genus 0, and cannot be repaired to one.
    #[error("{refusal}")]
    Repair {
        /// The mesh at fault.
        side: MeshSide,
        /// The reason.
        refusal: RepairRefusal,
    },
    /// The landmark files cannot be read or brought onto the meshes.
    #[error(transparent)]
    LandmarkFiles(#[from] ExchangeError),
    /// The landmarks do not belong to the meshes.
    #[error(transparent)]
    Landmarks(#[from] LandmarkError),
    /// Nothing could be matched.
    #[error(transparent)]
    Matching(MatchError),
    /// The program found no landmarks that lead to a map.
    #[error("{sentence}")]
    Unmatched {
        /// The sentence on the error and its remedy, with the numbers of the files.
        sentence: String,
    },
    /// The target has no mirror image.
    #[error("the mirror image of the target: {0}")]
    Mirror(#[from] MeshError),
    /// The meshes are too large for the memory that a map may take.
    #[error(
        "a map of meshes with {} and {} triangles may take {} MiB of memory, more than the {} MiB that it may have: take fewer triangles, \
         as `conemap remesh` makes them",
        faces[0],
        faces[1],
        mib(*expected),
        most >> 20
    )]
    Memory {
        /// Number of triangles of the source and of the target.
        faces: [usize; 2],
        /// The number of bytes that the map is expected to take.
        expected: u64,
        /// The number of bytes that it may take.
        most: u64,
    },
    /// There is no map.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
}

impl From<MatchError> for JobError {
    fn from(error: MatchError) -> Self {
        match error {
            MatchError::Cancelled(stop) => stop.into(),
            error => Self::Matching(error),
        }
    }
}

impl From<Cancelled> for JobError {
    fn from(stop: Cancelled) -> Self {
        Self::Pipeline(stop.into())
    }
}

/// One of the files of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobFile {
    /// The source mesh.
    Source,
    /// The target mesh.
    Target,
    /// A landmark file, by its number among those given.
    Landmarks(usize),
}

impl JobError {
    /// The error of a job that one of its meshes causes.
    pub(super) fn of_mesh(side: MeshSide, error: MeshFileError) -> Self {
        match error {
            MeshFileError::Read(error) => Self::Read { side, error },
            MeshFileError::Fault(fault) => Self::Mesh { side, fault },
            MeshFileError::Refusal(refusal) => Self::Repair { side, refusal },
            MeshFileError::Stopped(stop) => stop.into(),
        }
    }

    /// The file at fault; `None` where it is no file's fault.
    pub fn file(&self) -> Option<JobFile> {
        match self {
            Self::Read { side, .. } | Self::Mesh { side, .. } | Self::Repair { side, .. } => {
                Some(match side {
                    MeshSide::Source => JobFile::Source,
                    MeshSide::Target => JobFile::Target,
                })
            }
            Self::LandmarkFiles(error) => error.file().map(JobFile::Landmarks),
            Self::Landmarks(_) => Some(JobFile::Landmarks(0)),
            Self::Matching(_)
            | Self::Unmatched { .. }
            | Self::Mirror(_)
            | Self::Memory { .. }
            | Self::Pipeline(_) => None,
        }
    }

    /// A stable code for programs and for the page's sentences.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Read { .. } => "file",
            Self::Mesh { .. } | Self::Repair { .. } | Self::Mirror(_) => "mesh",
            Self::LandmarkFiles(_) | Self::Landmarks(_) | Self::Matching(_) | Self::Unmatched { .. } => {
                "landmarks"
            }
            Self::Memory { .. } => "memory",
            Self::Pipeline(error) => error.code(),
        }
    }
}

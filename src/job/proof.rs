//! Saved maps proved by `conemap_verify`, which shares no code with what makes them.
//!
//! Of this crate the proof trusts the readers (`io`) and the triangulation of polygons: they give arrays of coordinates and triangles,
//! whose hash the map file has.

use super::MapFiles;
use crate::io::{self, ReadError};
use crate::landmarks::MeshSide;
use crate::mesh::check::{MeshFault, triangulated};
use conemap_verify::{GivenMesh, Proof, Refusal, Side};
use std::ops::ControlFlow;

/// Why a map is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProofError {
    /// A mesh file cannot be read.
    #[error("{error}")]
    Read {
        /// The mesh at fault.
        side: MeshSide,
        /// The reason.
        error: ReadError,
    },
    /// A mesh file has no triangles.
    #[error("{error}")]
    Mesh {
        /// The mesh at fault.
        side: MeshSide,
        /// The reason.
        error: MeshFault,
    },
    /// The map is refused.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl ProofError {
    /// The mesh at fault; `None` where it is the map file.
    pub fn side(&self) -> Option<MeshSide> {
        match self {
            Self::Read { side, .. } | Self::Mesh { side, .. } => Some(*side),
            Self::Refused(refusal) => refusal.mesh_at_fault().map(|side| match side {
                Side::Source => MeshSide::Source,
                Side::Target => MeshSide::Target,
            }),
        }
    }

    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Read { .. } => "read",
            Self::Mesh { .. } => "mesh",
            Self::Refused(refusal) => refusal.kind(),
        }
    }
}

/// A mesh file's arrays.
struct Arrays {
    positions: Vec<[f64; 3]>,
    joined_with: Vec<u32>,
    triangles: Vec<[u32; 3]>,
}

impl Arrays {
    fn read(side: MeshSide, bytes: &[u8]) -> Result<Self, ProofError> {
        let soup = io::read_mesh(bytes).map_err(|error| ProofError::Read { side, error })?;
        let (triangles, _) = triangulated(&soup).map_err(|error| ProofError::Mesh { side, error })?;
        let positions = soup.positions.iter().map(|p| p.to_array()).collect();
        Ok(Self { positions, joined_with: soup.joined_with, triangles })
    }

    fn given(&self) -> GivenMesh<'_> {
        let Self { positions, joined_with, triangles } = self;
        GivenMesh { positions, joined_with, triangles }
    }
}

/// Proves that a map file holds a one-to-one map between its meshes: see the documentation of `conemap_verify`.
///
/// `ask` gets the share that is done, and stops the proof by `Break`.
///
/// # Errors
/// [`ProofError`] with the file at fault.
pub fn prove(files: MapFiles<'_>, ask: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<Proof, ProofError> {
    let source = Arrays::read(MeshSide::Source, files.source)?;
    let target = Arrays::read(MeshSide::Target, files.target)?;
    Ok(conemap_verify::verify(files.map, [source.given(), target.given()], ask)?)
}

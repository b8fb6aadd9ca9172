//! A mesh file as every command reads it: checked, and repaired as far as that may be.

use crate::io::{self, ReadError};
use crate::map_file::FileMesh;
use crate::mesh::check::{MeshFault, closed_genus_zero};
use crate::mesh::repair::{RepairOptions, RepairRefusal, RepairReport, repaired};
use crate::monitor::{Cancelled, Monitor, Step};

/// The treatment of a mesh that is not one closed surface of genus 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshFaults {
    /// The mesh is repaired, as far as the options let it, and the report says so.
    Repaired(RepairOptions),
    /// The mesh is refused.
    Refused,
}

impl Default for MeshFaults {
    /// By default, what does not change the shape is repaired, and holes are capped.
    fn default() -> Self {
        Self::Repaired(RepairOptions::default())
    }
}

/// A mesh as it is used, and what was repaired of it.
#[derive(Clone, Debug)]
pub struct ReadMesh {
    /// The mesh with its file's own numbers.
    pub mesh: FileMesh,
    /// The repairs that were made; empty where the mesh was good as given.
    pub report: RepairReport,
}

/// Why a mesh file cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFileError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(ReadError),
    /// The mesh is not one closed surface of genus 0, and is not to be repaired.
    #[error(transparent)]
    Fault(#[from] MeshFault),
    /// The mesh cannot be repaired to one closed surface of genus 0.
    #[error(transparent)]
    Refusal(RepairRefusal),
    /// The user asked to stop.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
}

impl From<ReadError> for MeshFileError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Stopped(stop) => Self::Stopped(stop),
            error => Self::Read(error),
        }
    }
}

impl From<RepairRefusal> for MeshFileError {
    fn from(refusal: RepairRefusal) -> Self {
        match refusal {
            RepairRefusal::Stopped(stop) => Self::Stopped(stop),
            refusal => Self::Refusal(refusal),
        }
    }
}

/// Reads a mesh of any known format, and checks or repairs it.
///
/// # Errors
/// [`MeshFileError`].
pub fn read_mesh(
    bytes: &[u8],
    faults: MeshFaults,
    monitor: &mut dyn Monitor,
) -> Result<ReadMesh, MeshFileError> {
    let soup = io::read_mesh_asking(bytes, monitor)?;
    monitor.step(Step::default())?;
    let (checked, report) = match faults {
        MeshFaults::Repaired(options) => {
            let mesh = repaired(&soup, &options, monitor)?;
            (mesh.checked, mesh.report)
        }
        MeshFaults::Refused => (closed_genus_zero(&soup)?, RepairReport::default()),
    };
    monitor.step(Step { fraction: 1.0, residual: None })?;
    Ok(ReadMesh { mesh: FileMesh::new(bytes, soup.polygons, checked), report })
}

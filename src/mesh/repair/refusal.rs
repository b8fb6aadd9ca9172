//! Why a mesh cannot be repaired.

use crate::mesh::check::MeshFault;

/// Why a mesh cannot be repaired to a surface that can be mapped, or not without changes that were not asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RepairRefusal {
    /// A fault that no step takes away; its numbers are the file's, or, from its number of vertices on, those of vertices that the
    /// repair added.
    #[error("{0}")]
    Fault(#[from] MeshFault),
    /// Parts beside the largest one that are more than specks.
    #[error(
        "the mesh has {count} separate parts, and those beside the largest have {:.1} % of the area: keep the largest alone \
         (--largest-component), or choose one in the file",
        100.0 * area_share
    )]
    Parts {
        /// Number of parts.
        count: usize,
        /// Share of the area of all parts but the largest.
        area_share: f64,
    },
    /// The surface is more hole than skin.
    #[error(
        "the surface is an open sheet: caps would be {:.0} % of the area once its holes are closed; only surfaces that nearly \
         enclose a body can be mapped",
        100.0 * cap_share
    )]
    OpenSheet {
        /// Share of the area that caps would have.
        cap_share: f64,
    },
    /// Nothing is left.
    #[error("no face of the mesh has an area")]
    NothingLeft,
}

impl RepairRefusal {
    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Fault(fault) => fault.kind(),
            Self::Parts { .. } => "parts",
            Self::OpenSheet { .. } => "open_sheet",
            Self::NothingLeft => "nothing_left",
        }
    }
}

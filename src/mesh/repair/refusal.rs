//! Why a mesh cannot be repaired.

use super::report::{Handle, percent};
use crate::mesh::check::MeshFault;
use crate::monitor::Cancelled;
use std::fmt;

/// Why a mesh cannot be repaired to a surface that can be mapped, or not without changes that were not asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RepairRefusal {
    /// The mesh has a fault that no step takes away; its numbers are the file's, or, from its number of vertices on, those of
    /// vertices that the repair added.
    #[error("{0}")]
    Fault(#[from] MeshFault),
    /// The parts beside the largest one are more than specks.
    #[error(
        "the mesh has {count} separate parts, and those beside the largest have {:.1} % of the area: keep the largest alone \
         (--largest-component), or choose one in the file",
        100.0 * area_share
    )]
    Parts {
        /// Number of parts.
        count: usize,
        /// The share of the area of all parts but the largest.
        area_share: f64,
    },
    /// The surface has handles, which may not be cut.
    #[error(
        "the surface has {} ({}): only surfaces without handles, like a sphere, can be mapped; have {} cut there and closed \
         (--cut-handles)",
        Counted(.0.len()),
        Loops(.0),
        if .0.len() == 1 { "it" } else { "them" }
    )]
    Handles(
        /// The handles, the one with the shortest loop first, and what to cut them would come to.
        Vec<Handle>,
    ),
    /// The surface has so many handles that they are not looked for.
    #[error(
        "the surface has {genus} handles, and at most {most} are cut: close its small tunnels and bridges in another program first"
    )]
    TooManyHandles {
        /// Number of handles.
        genus: usize,
        /// The largest number of handles that are cut.
        most: usize,
    },
    /// The surface is more hole than skin.
    #[error(
        "the surface is an open sheet: caps would be {:.0} % of the area once its holes are closed; only surfaces that nearly \
         enclose a body can be mapped",
        100.0 * cap_share
    )]
    OpenSheet {
        /// The share of the area that caps would have.
        cap_share: f64,
    },
    /// Nothing is left.
    #[error("no face of the mesh has an area")]
    NothingLeft,
    /// Nothing is left since the vertices of every face were joined.
    #[error(
        "the vertices of every face are within {within} of each other and were joined: give a smaller distance (--join-within, in the \
         file's units)"
    )]
    JoinedAway {
        /// The distance within which vertices were joined, in the file's units.
        within: f64,
    },
    /// The user asked to stop.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
}

/// A number of handles.
struct Counted(usize);

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} handle{}", self.0, if self.0 == 1 { "" } else { "s" })
    }
}

/// The places of handles and the lengths of their loops, as text for a sentence.
struct Loops<'a>(&'a [Handle]);

/// The largest number of handles that a sentence names one by one.
const TOLD: usize = 5;

impl fmt::Display for Loops<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, handle) in self.0.iter().take(TOLD).enumerate() {
            let vertex = handle.vertices.first().copied().unwrap_or_default();
            let [separator, what] = if k == 0 { ["", " of the square root of the area"] } else { ["; ", ""] };
            let length = percent(handle.loop_length);
            write!(
                f,
                "{separator}at vertex {vertex} a loop of {} edges, {length} %{what} long",
                handle.edges
            )?;
        }
        f.write_str(if self.0.len() > TOLD { "; ..." } else { "" })
    }
}

impl RepairRefusal {
    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Fault(fault) => fault.kind(),
            Self::Parts { .. } => "parts",
            Self::Handles(_) => "genus",
            Self::TooManyHandles { .. } => "too_many_handles",
            Self::OpenSheet { .. } => "open_sheet",
            Self::NothingLeft => "nothing_left",
            Self::JoinedAway { .. } => "joined_away",
            Self::Stopped(_) => "stopped",
        }
    }
}

//! Why there is no map.

use crate::monitor::{Cancelled, OrStop};

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Vertices could not be collapsed.
    #[error("{left} vertices could not be simplified away")]
    NotCoarsened {
        /// Number of vertices left.
        left: usize,
    },
    /// Vertices that the layout added could not be removed from the parametrisation of a coarse mesh.
    #[error("{left} points of the layout could not be taken out again")]
    LayoutPoints {
        /// Number of vertices left.
        left: usize,
        /// The landmarks nearest to them, 0-based, each once.
        near: Vec<usize>,
    },
    /// A vertex found no place in which all its triangles are positive.
    #[error(
        "no valid start: at {vertices} vertices one found no place among triangles that are thinner than rounding tells apart; make \
         the triangles of both meshes more even, as `conemap remesh` does, or take landmarks further from each other"
    )]
    NoStart {
        /// Vertices of the level.
        vertices: usize,
    },
}

impl OrStop for MapError {
    fn is_stop(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

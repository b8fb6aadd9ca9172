//! The map: two seamless parametrisations onto one flat cone surface M, relaxed, composed, certified.
//!
//! Source -> M and target -> M are homeomorphisms that keep the landmarks at the cones; the map is one after the
//! inverse of the other.

pub mod base_lines;
pub mod certificate;
pub mod compose;
pub mod composed;
pub mod cone_surface;
pub mod dents;
pub mod distortion;
pub mod embedding;
pub mod energy;
pub mod fan;
pub mod flat_problem;
pub mod ground_truth;
pub mod initial;
pub mod multilevel;
pub mod overlay;
pub mod patch_fit;
mod placement;
mod progressive;
pub mod queries;
pub mod relief;
pub mod seamless;
pub mod thesis;
pub mod transfer;
mod unknowns;

pub use certificate::{Certificate, certify};
pub use cone_surface::ConeSurface;
pub use embedding::{Anchor, Embedding, Parametrised};

use crate::monitor::Cancelled;

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Landmarks so placed that a base triangle is degenerate.
    #[error("landmarks {}, {} and {} lie on one line on both meshes: move one of them", landmarks[0], landmarks[1], landmarks[2])]
    DegenerateBase {
        /// The landmarks, 0-based.
        landmarks: [usize; 3],
    },
    /// Vertices that could not be collapsed.
    #[error("{left} vertices could not be simplified away")]
    NotCoarsened {
        /// How many.
        left: usize,
    },
    /// Vertices of the layout that could not be taken out of the parametrisation of a coarse mesh.
    #[error("{left} points of the layout could not be taken out again")]
    LayoutPoints {
        /// How many.
        left: usize,
        /// The landmarks nearest to them, 0-based, each once.
        near: Vec<usize>,
    },
    /// A vertex that found no place.
    #[error("no valid start: the parametrisation got stuck at {vertices} vertices")]
    NoStart {
        /// Vertices of the level.
        vertices: usize,
    },
}

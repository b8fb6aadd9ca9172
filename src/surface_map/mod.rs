//! The map: two seamless parametrisations onto one flat cone surface M, relaxed, composed, certified.
//!
//! Source -> M and target -> M are homeomorphisms that keep the landmarks at the cones; the map is one after the
//! inverse of the other.

pub mod base_lines;
pub mod certificate;
pub mod compose;
pub mod composed;
pub mod dents;
pub mod distortion;
pub mod energy;
mod error;
pub mod ground_truth;
pub mod multilevel;
pub mod overlay;
pub mod parametrisation;
pub mod patch_fit;
pub mod queries;
pub mod relief;
pub mod thesis;
pub mod transfer;

pub use certificate::{Certificate, certify};
pub use error::MapError;
pub use parametrisation::cone_surface::ConeSurface;
pub use parametrisation::embedding::{Anchor, Embedding, Parametrised};

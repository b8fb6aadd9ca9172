//! The map: two seamless parametrisations onto one flat cone surface M, relaxed, composed, certified.
//!
//! Source -> M and target -> M are homeomorphisms that keep the landmarks at the cones; the map is one after the
//! inverse of the other.

pub mod cone_surface;
pub mod embedding;

pub use cone_surface::ConeSurface;
pub use embedding::Embedding;

//! The map: two seamless parametrisations onto one flat cone surface M, relaxed, composed, certified.
//!
//! Source -> M and target -> M are homeomorphisms that take the landmarks to the cones; the map is the first followed by the
//! inverse of the second.

mod certify;
pub mod correspondence;
pub mod energy;
mod error;
pub mod flat_layout;
pub mod measures;
pub mod overlay;
pub mod parametrisation;
pub mod relaxation;

pub use crate::certificate::Certificate;
pub use certify::certify;
pub use error::MapError;
pub use parametrisation::cone_surface::ConeSurface;
pub use parametrisation::embedding::{Anchor, Embedding, Parametrised};

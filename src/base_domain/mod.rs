//! The base domain: the mesh whose vertices are the landmarks.
//!
//! Quadric error simplification (Garland & Heckbert 1997; thesis section 3.2) down to exactly the landmarks.

mod domain;
mod simplify;
mod stages;

pub use domain::BaseDomain;
pub use simplify::{SimplifyError, joint_simplification_stages, simplification_stages, simplify};
pub use stages::SimplificationStage;

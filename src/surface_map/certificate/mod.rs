//! The proof that a parametrisation is a homeomorphism onto the cone surface, read off the result alone.

pub mod base_lines;
pub mod certify;

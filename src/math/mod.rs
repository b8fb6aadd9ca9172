//! Formulas on numbers. Knows no mesh.

pub mod decorated;
pub mod quadric;
pub mod random;
pub mod rigid2;
pub mod rigid3;
pub mod scalar;
pub mod triangle;

//! Formulas and small algorithms on numbers. Knows no mesh.

pub mod barycentric;
pub mod bends;
pub mod decorated;
pub mod disjoint_sets;
pub mod golden;
pub mod matrix2;
pub mod min_queue;
pub mod mirror_plane;
pub mod predicates;
pub mod quadric;
pub mod quantile;
pub mod random;
pub mod rigid2;
pub mod rigid3;
pub mod scalar;
pub mod screen_light;
pub mod segment;
pub mod triangle;

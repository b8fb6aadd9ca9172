//! Parametrisations of a mesh onto the flat cone surface: the first one, levels of coarseness, the flat relaxation.

mod coarsen_to_base;
pub mod cone_surface;
pub mod embedding;
pub mod fan;
pub mod initial;
mod kernel;
pub mod level;
pub mod problem;
pub mod rest_triangle;
mod star;
pub mod tutte;
pub(super) mod unknowns;

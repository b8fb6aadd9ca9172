//! The relaxation of the map: lowers its energy as a whole, then vertex by vertex where it is distorted most.

mod clipping;
mod covered_star;
pub mod dent_energy;
pub mod dents;
mod evaluation;
pub mod map_relaxation;

//! The energy of the map itself is lowered: over the whole map, then vertex by vertex where it is distorted most.

mod clipping;
mod covered_star;
pub mod dent_energy;
pub mod dents;
mod evaluation;
pub mod map_relaxation;

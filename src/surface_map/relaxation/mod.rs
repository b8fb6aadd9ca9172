//! The energy of the map itself is lowered: over the whole map, then vertex by vertex where it is distorted most.

pub mod dents;
pub mod map_relaxation;

//! The thesis' patchwise map over two flat cone metrics.

mod bins;
mod development;
mod patchwise_map;

pub use patchwise_map::{PatchwiseMap, patchwise_map, straight_map};

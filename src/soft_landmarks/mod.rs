//! Soft landmarks, whose clicks are uncertain: their points on the target are moved, within a radius, to the images that the map of their
//! surroundings predicts.

mod prediction;
mod settling;

pub use settling::{Settled, SettlingInput, SettlingOptions, settle};

//! Landmarks whose clicks are uncertain: their points on the target are moved, within a radius, to where the map around them leads.

mod prediction;
mod settling;

pub use settling::{Settled, SettlingInput, SettlingOptions, settle};

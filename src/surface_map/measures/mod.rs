//! Measures of a finished map: distortion, images of points, the common mesh, distances to a known map.

pub mod coverage;
pub mod distortion;
pub mod ground_truth;
pub mod queries;
pub mod transfer;

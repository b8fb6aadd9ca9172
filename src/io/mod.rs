//! Bytes to polygon soups and back. One file per format.

pub mod landmark_file;
pub mod off;

//! How map files are named and begin.

/// The ending of map files' names, without the dot.
pub const ENDING: &str = "conemap";

/// How a map file begins.
pub(super) const MAGIC: &[u8; 8] = b"CONEMAP\0";
/// Files with another major version are refused.
pub(super) const MAJOR: u16 = 1;
/// Grows with what old readers may leave out.
pub(super) const MINOR: u16 = 0;

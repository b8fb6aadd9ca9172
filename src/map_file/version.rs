//! The names and the first bytes of map files.

/// The ending of map files' names, without the dot.
pub const ENDING: &str = "conemap";

/// The first bytes of a map file.
pub(super) const MAGIC: &[u8; 8] = b"CONEMAP\0";
/// Whether bytes begin as a map file does, whole or not.
pub fn is_one(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Files with another major version are refused.
pub(super) const MAJOR: u16 = 1;
/// The minor version, which grows with what old readers may leave out.
pub(super) const MINOR: u16 = 0;

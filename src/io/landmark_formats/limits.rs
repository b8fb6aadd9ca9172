//! The limits for the sizes of landmark files.

/// The largest number of points; a file with more is refused.
pub const MAX_POINTS: usize = 100_000;

/// The largest size of a landmark file in bytes; larger ones are refused.
pub const MAX_BYTES: usize = 1 << 26;

//! What landmark files may ask for.

/// More points than this are refused.
pub const MAX_POINTS: usize = 100_000;

/// Landmark files larger than this are refused.
pub const MAX_BYTES: usize = 1 << 26;

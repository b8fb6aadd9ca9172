//! A map that is still being made, as far as it can be seen.

use glam::DVec3;

/// Of which mesh a preview tells the images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PreviewOf {
    /// Of the source's vertices, on the target.
    Source,
    /// Of the target's vertices, on the source.
    Target,
}

impl PreviewOf {
    /// Of the other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Source => Self::Target,
            Self::Target => Self::Source,
        }
    }
}

/// A map that is still being made. Nothing is computed before it is asked for.
pub trait MapPreview {
    /// By vertex of a mesh its place on the other one, in that one's coordinates: nearly, and nearly on it. `None` where the map
    /// cannot be told now.
    fn images(&self, of: PreviewOf) -> Option<Vec<DVec3>>;
}

//! A map that is still being made, as far as it can be seen.

use glam::DVec3;

/// The mesh whose vertices a preview has the images of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PreviewOf {
    /// The source: its vertices have images on the target.
    Source,
    /// The target: its vertices have images on the source.
    Target,
}

impl PreviewOf {
    /// The other mesh.
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
    /// The approximate image of each vertex of a mesh, in the other mesh's coordinates and near its surface. `None` where the map is not
    /// known at this moment.
    fn images(&self, of: PreviewOf) -> Option<Vec<DVec3>>;
}

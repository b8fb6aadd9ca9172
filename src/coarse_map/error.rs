//! Why there is no coarse map.

use crate::layout::LayoutError;
use crate::monitor::{Cancelled, OrStop};
use crate::surface_map::MapError;

/// Why there is no coarse map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoarseMapError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// No layout has a map.
    #[error("layout: {0}")]
    Layout(LayoutError),
    /// A map could not be relaxed.
    #[error("map: {0}")]
    Map(MapError),
}

impl OrStop for CoarseMapError {
    fn is_stop(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

impl From<LayoutError> for CoarseMapError {
    fn from(error: LayoutError) -> Self {
        match error {
            LayoutError::Cancelled(stop) => Self::Cancelled(stop),
            other => Self::Layout(other),
        }
    }
}

impl From<MapError> for CoarseMapError {
    fn from(error: MapError) -> Self {
        match error {
            MapError::Cancelled(stop) => Self::Cancelled(stop),
            other => Self::Map(other),
        }
    }
}

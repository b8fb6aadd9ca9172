//! A map that is still being made, as far as it can be seen.

use crate::mesh_side::MeshSide;
use glam::DVec3;

/// A map that is still being made. Nothing is computed before it is asked for.
pub trait MapPreview {
    /// By vertex of a mesh its place on the other one, in that one's coordinates: nearly, and nearly on it. `None` where the map
    /// cannot be told now.
    fn images(&self, of: MeshSide) -> Option<Vec<DVec3>>;
}

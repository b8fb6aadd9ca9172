//! A map that is still being made, as far as it can be seen.

use crate::mesh_side::MeshSide;
use glam::DVec3;

/// A map that is still being made. Nothing is computed before it is asked for.
pub trait MapPreview {
    /// The approximate image of each vertex of a mesh, in the other mesh's coordinates and near its surface. `None` where the map is not
    /// known at this moment.
    fn images(&self, of: MeshSide) -> Option<Vec<DVec3>>;

    /// The landmark pairs of the map that nobody gave: the numbers of a vertex of the source and of one of the target. None where all
    /// landmarks were given.
    fn found_pairs(&self) -> Vec<[usize; 2]> {
        Vec::new()
    }
}

//! The parts of another map in the second view while it shows one.

use crate::gpu::Mesh;

/// Another map, on the source.
pub(super) struct ComparedMap {
    /// Its triangles.
    pub(super) overlay: Mesh,
    /// Its patch lines.
    pub(super) lines: Option<Mesh>,
}

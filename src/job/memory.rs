//! The memory that a map takes, foretold from the sizes of its meshes.

use crate::mesh::SurfaceMesh;

/// The number of bytes that any map may take.
pub const LEAST_MEMORY: u64 = 100 << 20;
/// The number of bytes that each face of both meshes may add, with the files of the map written: above all that were measured
/// (`docs/figures.md`).
pub const MEMORY_PER_FACE: u64 = 10 << 10;

/// Bytes that a map of two meshes takes at most, but for meshes whose triangles or landmarks are made to break programs.
pub fn expected_memory(meshes: [&SurfaceMesh; 2]) -> u64 {
    let faces = meshes.map(|mesh| mesh.face_count() as u64).iter().sum::<u64>();
    LEAST_MEMORY + MEMORY_PER_FACE * faces
}

/// A number of bytes as people read it: whole MiB, up.
pub(super) fn mib(bytes: u64) -> u64 {
    bytes.div_ceil(1 << 20)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn memory_grows_with_the_faces_of_both_meshes() {
        let [small, large] = [icosphere(1), icosphere(3)];
        let [a, b] = [small.face_count() + large.face_count(), 2 * small.face_count()];
        let difference = expected_memory([&small, &large]) - expected_memory([&small, &small]);
        assert_eq!(difference, MEMORY_PER_FACE * (a - b) as u64);
        assert_eq!(mib(LEAST_MEMORY), 100);
        assert_eq!(mib(LEAST_MEMORY + 1), 101);
    }
}

//! Meshes as Wavefront OBJ.

use crate::mesh::SurfaceMesh;
use glam::DVec3;
use std::fmt::Write;

/// Writes the vertices and triangles of a mesh, in order.
pub fn mesh(mesh: &SurfaceMesh) -> Vec<u8> {
    let faces = mesh.triangles().iter().map(|t| t.map(|v| v.0));
    polygons(mesh.positions().as_ref(), faces)
}

/// Writes vertices and polygons, in order.
pub fn polygons(positions: &[DVec3], faces: impl IntoIterator<Item = impl AsRef<[u32]>>) -> Vec<u8> {
    let mut text = String::new();
    // Writing to a string does not fail.
    for p in positions {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for face in faces {
        text.push('f');
        for v in face.as_ref() {
            let _ = write!(text, " {}", v + 1);
        }
        text.push('\n');
    }
    text.into_bytes()
}

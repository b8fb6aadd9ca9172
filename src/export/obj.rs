//! Meshes as Wavefront OBJ.

use crate::mesh::SurfaceMesh;
use std::fmt::Write;

/// Vertices and triangles, in order.
pub fn mesh(mesh: &SurfaceMesh) -> Vec<u8> {
    let mut text = String::new();
    // Writing to a string does not fail.
    for p in mesh.positions() {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for t in mesh.triangles() {
        let _ = writeln!(text, "f {} {} {}", t[0].0 + 1, t[1].0 + 1, t[2].0 + 1);
    }
    text.into_bytes()
}

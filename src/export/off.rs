//! Meshes as OFF.

use crate::mesh::SurfaceMesh;
use std::fmt::Write;

/// Writes the vertices and triangles of a mesh, in order.
pub fn mesh(mesh: &SurfaceMesh) -> Vec<u8> {
    let mut text = format!("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
    // Writing to a string does not fail.
    for p in mesh.positions() {
        let _ = writeln!(text, "{} {} {}", p.x, p.y, p.z);
    }
    for t in mesh.triangles() {
        let _ = writeln!(text, "3 {} {} {}", t[0].0, t[1].0, t[2].0);
    }
    text.into_bytes()
}

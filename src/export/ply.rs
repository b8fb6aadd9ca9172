//! Meshes as binary PLY.

use crate::mesh::SurfaceMesh;

/// Vertices and triangles, in order; coordinates in f64.
pub fn mesh(mesh: &SurfaceMesh) -> Vec<u8> {
    let (vertices, faces) = (mesh.vertex_count(), mesh.face_count());
    let coordinates = ["x", "y", "z"].map(|name| format!("property double {name}\n")).concat();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n{coordinates}\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for p in mesh.positions() {
        p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    for t in mesh.triangles() {
        bytes.push(3);
        t.iter().for_each(|v| bytes.extend(v.0.to_le_bytes()));
    }
    bytes
}

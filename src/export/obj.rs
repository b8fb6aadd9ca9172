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

#[cfg(test)]
mod tests {
    use crate::io::read_mesh;
    use crate::mesh::check::closed_genus_zero;
    use crate::mesh::generators::icosphere;

    #[test]
    fn the_reader_reads_it_back() {
        let sphere = icosphere(1);
        let back = closed_genus_zero(&read_mesh(&super::mesh(&sphere)).unwrap()).unwrap().mesh;
        assert_eq!(back.positions(), sphere.positions());
        assert_eq!(back.triangles(), sphere.triangles());
    }
}

//! Meshes as binary PLY; coordinates in f64.

use crate::mesh::SurfaceMesh;
use glam::DVec3;

/// Vertices and triangles, in order.
pub fn mesh(mesh: &SurfaceMesh) -> Vec<u8> {
    let mut bytes = vertices(mesh.positions().as_ref(), mesh.face_count(), "uchar");
    for t in mesh.triangles() {
        bytes.push(3);
        t.iter().for_each(|v| bytes.extend(v.0.to_le_bytes()));
    }
    bytes
}

/// Vertices and polygons, in order. The number of corners takes four bytes, so that any polygon has room.
pub fn polygons(positions: &[DVec3], faces: &[Vec<u32>]) -> Vec<u8> {
    let mut bytes = vertices(positions, faces.len(), "uint");
    for face in faces {
        bytes.extend((face.len() as u32).to_le_bytes());
        face.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

/// The head of a file with so many faces, their number of corners of this type, and its vertices.
fn vertices(positions: &[DVec3], faces: usize, corners: &str) -> Vec<u8> {
    let coordinates = ["x", "y", "z"].map(|name| format!("property double {name}\n")).concat();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n{coordinates}\
         element face {faces}\nproperty list {corners} int vertex_indices\nend_header\n",
        positions.len()
    )
    .into_bytes();
    for p in positions {
        p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::obj;
    use crate::io::read_mesh;

    #[test]
    fn the_reader_reads_polygons_back() {
        let positions: Vec<DVec3> = (0..8)
            .map(|k| DVec3::new((k & 1).into(), ((k >> 1) & 1).into(), f64::from(k >> 2) + 0.1))
            .collect();
        let cube = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces: Vec<Vec<u32>> = cube.map(|face| face.to_vec()).to_vec();
        for bytes in [obj::polygons(&positions, &faces), polygons(&positions, &faces)] {
            let soup = read_mesh(&bytes).unwrap();
            assert_eq!((soup.positions, soup.polygons), (positions.clone(), faces.clone()));
        }
    }
}

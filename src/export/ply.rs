//! Meshes as binary PLY; coordinates in f64.

use crate::io::vertex_table::Column;
use crate::mesh::SurfaceMesh;
use glam::DVec3;

/// Writes the vertices and triangles of a mesh, in order.
pub fn mesh(mesh: &SurfaceMesh) -> Vec<u8> {
    let mut bytes = vertices(mesh.positions().as_ref(), mesh.face_count(), "uchar", &[]);
    for t in mesh.triangles() {
        bytes.push(3);
        t.iter().for_each(|v| bytes.extend(v.0.to_le_bytes()));
    }
    bytes
}

/// Writes vertices and polygons, in order. The number of corners takes four bytes, so that any polygon has room.
pub fn polygons(positions: &[DVec3], faces: &[Vec<u32>]) -> Vec<u8> {
    polygons_with(positions, faces, &[])
}

/// Writes vertices and polygons with further properties of the vertices; a vertex without a value gets 0.
pub fn polygons_with(positions: &[DVec3], faces: &[Vec<u32>], properties: &[Column]) -> Vec<u8> {
    let mut bytes = vertices(positions, faces.len(), "uint", properties);
    for face in faces {
        bytes.extend((face.len() as u32).to_le_bytes());
        face.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

/// The head of a file with so many faces, their number of corners of this type, and its vertices.
fn vertices(positions: &[DVec3], faces: usize, corners: &str, properties: &[Column]) -> Vec<u8> {
    let coordinates = ["x", "y", "z"].map(|name| format!("property double {name}\n")).concat();
    let further: String = properties
        .iter()
        .map(|column| format!("property {} {}\n", column.number_type.name(), one_word(&column.name)))
        .collect();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n{coordinates}{further}\
         element face {faces}\nproperty list {corners} int vertex_indices\nend_header\n",
        positions.len()
    )
    .into_bytes();
    for (v, p) in positions.iter().enumerate() {
        p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        for column in properties {
            let value = column.values.get(v).copied().flatten().unwrap_or(0.0);
            column.number_type.push(value, &mut bytes);
        }
    }
    bytes
}

/// A name as a head can hold it.
fn one_word(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_graphic() { c } else { '_' }).collect()
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

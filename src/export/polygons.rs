//! Polygon meshes: positions by vertex of a file with the file's own polygons.

use glam::DVec3;
use std::fmt::Write;

/// As Wavefront OBJ.
pub fn obj(positions: &[DVec3], polygons: &[Vec<u32>]) -> Vec<u8> {
    let mut text = String::new();
    // Writing to a string does not fail.
    for p in positions {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for polygon in polygons {
        text.push('f');
        for v in polygon {
            let _ = write!(text, " {}", v + 1);
        }
        text.push('\n');
    }
    text.into_bytes()
}

/// As binary PLY; coordinates in f64. The number of corners takes four bytes, so that any polygon has room.
pub fn ply(positions: &[DVec3], polygons: &[Vec<u32>]) -> Vec<u8> {
    let (vertices, faces) = (positions.len(), polygons.len());
    let coordinates = ["x", "y", "z"].map(|name| format!("property double {name}\n")).concat();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n{coordinates}\
         element face {faces}\nproperty list uint int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for p in positions {
        p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    for polygon in polygons {
        bytes.extend((polygon.len() as u32).to_le_bytes());
        polygon.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;

    #[test]
    fn the_reader_reads_polygons_back() {
        let positions: Vec<DVec3> = (0..8)
            .map(|k| DVec3::new((k & 1).into(), ((k >> 1) & 1).into(), f64::from(k >> 2) + 0.1))
            .collect();
        let cube = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let polygons: Vec<Vec<u32>> = cube.map(|face| face.to_vec()).to_vec();
        for bytes in [obj(&positions, &polygons), ply(&positions, &polygons)] {
            let soup = read_mesh(&bytes).unwrap();
            assert_eq!((soup.positions, soup.polygons), (positions.clone(), polygons.clone()));
        }
    }
}

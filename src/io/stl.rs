//! STL, text and binary: loose triangles, joined at equal coordinates. Vertex 3 t + k is corner k of triangle t.

use super::problem::{Place, Problem};
use super::reading::{number, text, weld};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Binary files have exactly the size that their count says; some begin with "solid" like text files.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    triangle_count(bytes).is_some_and(|n| HEADER as u64 + TRIANGLE as u64 * n == bytes.len() as u64)
}

fn triangle_count(bytes: &[u8]) -> Option<u64> {
    Some(u64::from(u32::from_le_bytes(bytes.get(80..HEADER)?.try_into().ok()?)))
}

pub(super) fn read(bytes: &[u8]) -> Result<PolygonSoup, Problem> {
    let positions = if is_binary(bytes) { binary(bytes) } else { ascii(bytes)? };
    let polygons = (0..positions.len() as u32 / 3).map(|t| vec![3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Ok(weld(PolygonSoup { positions, polygons, ..PolygonSoup::default() }))
}

fn binary(bytes: &[u8]) -> Vec<DVec3> {
    let coordinate = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let triangles = bytes[HEADER..].chunks_exact(TRIANGLE);
    // 12 bytes of normal, then three corners of three floats.
    triangles
        .flat_map(|t| t[12..48].chunks_exact(12))
        .map(|c| DVec3::new(coordinate(&c[..4]), coordinate(&c[4..8]), coordinate(&c[8..])))
        .collect()
}

fn ascii(bytes: &[u8]) -> Result<Vec<DVec3>, Problem> {
    let mut positions = Vec::new();
    let mut lines = 0;
    for (index, line) in text(bytes)?.lines().enumerate() {
        lines = index + 1;
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vertex") => {
                let mut next = || number::<f64>(words.next(), lines, "a coordinate");
                positions.push(DVec3::new(next()?, next()?, next()?));
            }
            Some("endfacet") if positions.len() % 3 != 0 => {
                return Err((Place::Line(lines), "the facet does not have three vertices".into()));
            }
            _ => {}
        }
    }
    if positions.len() % 3 != 0 {
        return Err((Place::Line(lines), "the file ends inside a facet".into()));
    }
    Ok(positions)
}

//! STL, text and binary: loose triangles, joined at equal coordinates. Vertex 3 t + k is corner k of triangle t.

use super::problem::{Place, Unread};
use super::reading::{lines, number, text, weld};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::Pulse;
use glam::DVec3;

/// The bytes before the triangles of a binary file: 80 of any content and the count of triangles.
const HEADER: usize = 84;
/// The bytes of a triangle in a binary file: a normal and three corners as f32, and two more bytes.
const TRIANGLE: usize = 50;

/// Binary files have exactly the size that their count says; some begin with "solid" like text files.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    triangle_count(bytes).is_some_and(|n| size(n) == bytes.len() as u64)
}

/// Whether a file looks like a binary one that is cut off or has more bytes than its triangles: by its first triangle, whose
/// normal is a unit vector or zero and whose corners are usual numbers.
pub(super) fn is_likely_binary(bytes: &[u8]) -> bool {
    let Some(first) = bytes.get(HEADER..HEADER + TRIANGLE) else { return false };
    let floats: Vec<f32> = first[..48].as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    let length = floats[..3].iter().map(|x| x * x).sum::<f32>();
    let is_usual = |x: &f32| *x == 0.0 || (1e-20..1e20).contains(&x.abs());
    triangle_count(bytes) != Some(0)
        && (length == 0.0 || (length - 1.0).abs() < 0.05)
        && floats[3..].iter().all(is_usual)
        && floats[3..].iter().any(|x| *x != 0.0)
}

/// Whether a file looks like a text one.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let is_solid = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    is_solid && !bytes[..bytes.len().min(HEADER + TRIANGLE)].contains(&0)
}

fn triangle_count(bytes: &[u8]) -> Option<u64> {
    Some(u64::from(u32::from_le_bytes(bytes.get(80..HEADER)?.try_into().ok()?)))
}

/// The size of a binary file in bytes.
fn size(triangles: u64) -> u64 {
    HEADER as u64 + TRIANGLE as u64 * triangles
}

pub(super) fn read(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Unread> {
    let positions =
        if is_binary(bytes) || !is_text(bytes) { binary(bytes, pulse)? } else { ascii(bytes, pulse)? };
    let polygons = (0..positions.len() as u32 / 3).map(|t| vec![3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Ok(weld(PolygonSoup { positions, polygons, ..PolygonSoup::default() }, pulse)?)
}

/// Bytes after the last triangle are passed over.
fn binary(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<Vec<DVec3>, Unread> {
    let count = triangle_count(bytes).unwrap_or(0);
    if size(count) > bytes.len() as u64 {
        let there = bytes.len().saturating_sub(HEADER) / TRIANGLE;
        let problem = format!("it announces {count} triangles and has {there}: the file is cut off");
        return Err((Place::Header, problem).into());
    }
    let coordinate = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let triangles = bytes[HEADER..size(count) as usize].chunks_exact(TRIANGLE);
    // 12 bytes of normal, then three corners of three floats.
    let corners = triangles.flat_map(|t| t[12..48].chunks_exact(12));
    let position = |c: &[u8]| {
        pulse.beat()?;
        Ok(DVec3::new(coordinate(&c[..4]), coordinate(&c[4..8]), coordinate(&c[8..])))
    };
    corners.map(position).collect()
}

fn ascii(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<Vec<DVec3>, Unread> {
    let at = |line: usize, problem: &str| Unread::from((Place::Line(line), problem.to_owned()));
    let mut positions = Vec::new();
    let (mut last, mut is_ended) = (0, false);
    for (line_number, line) in lines(&text(bytes)?) {
        pulse.beat()?;
        let mut words = line.split_whitespace();
        let Some(word) = words.next() else { continue };
        last = line_number;
        if word.eq_ignore_ascii_case("vertex") {
            let mut next = || number::<f64>(words.next(), line_number, "a coordinate");
            positions.push(DVec3::new(next()?, next()?, next()?));
        } else if word.eq_ignore_ascii_case("endfacet") && positions.len() % 3 != 0 {
            return Err(at(line_number, "the facet does not have three vertices"));
        }
        is_ended = word.eq_ignore_ascii_case("endsolid") || is_ended && word.starts_with(['#', ';']);
    }
    if positions.len() % 3 != 0 {
        return Err(at(last, "the file ends inside a facet: it is cut off"));
    }
    if !is_ended {
        return Err(at(last, "the file ends without `endsolid`: it is cut off"));
    }
    Ok(positions)
}

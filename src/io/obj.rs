//! Wavefront OBJ: vertices and faces; the vertex order of the file is kept.

use super::problem::{Place, Problem};
use super::reading::{number, text};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

pub(super) fn read(bytes: &[u8]) -> Result<PolygonSoup, Problem> {
    let mut soup = PolygonSoup::default();
    for (index, line) in text(bytes)?.lines().enumerate() {
        let line_number = index + 1;
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || number::<f64>(words.next(), line_number, "a coordinate");
                soup.positions.push(DVec3::new(next()?, next()?, next()?));
            }
            Some("f") => {
                let corner = |word: &str| vertex(word, soup.positions.len(), line_number);
                soup.polygons.push(words.map(corner).collect::<Result<_, _>>()?);
            }
            _ => {}
        }
    }
    Ok(soup)
}

/// The vertex of a corner `v`, `v/t`, `v//n` or `v/t/n`; negative numbers count back from the last vertex so far.
fn vertex(word: &str, vertices: usize, line: usize) -> Result<u32, Problem> {
    let value: i64 = number(word.split('/').next(), line, "a vertex number")?;
    let index = if value < 0 { vertices as i64 + value } else { value - 1 };
    u32::try_from(index).map_err(|_| (Place::Line(line), format!("there is no vertex {value}")))
}

//! OFF (also COFF and NOFF: colours and normals are passed over); the vertex order of the file is kept.

use super::problem::{Place, Problem};
use super::reading::{number, text};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

pub(super) fn read(bytes: &[u8]) -> Result<PolygonSoup, Problem> {
    let text = text(bytes)?;
    let lines =
        text.lines().enumerate().map(|(i, l)| (i + 1, l.split('#').next().unwrap_or_default().trim()));
    let mut lines = lines.filter(|(_, l)| !l.is_empty());
    let (mut line, mut header) = lines.next().unwrap_or((1, ""));
    // The counts may stand on the first line, after the format's name.
    header = header.split_once(char::is_whitespace).map_or("", |(_, rest)| rest.trim());
    if header.is_empty() {
        (line, header) = lines
            .next()
            .ok_or((Place::Line(line), "the numbers of vertices and faces are missing".into()))?;
    }
    let mut counts = header.split_whitespace();
    let vertices: usize = number(counts.next(), line, "the number of vertices")?;
    let faces: usize = number(counts.next(), line, "the number of faces")?;
    // A vertex takes at least 6 bytes, a face at least 8.
    if vertices > bytes.len() / 6 + 1 || faces > bytes.len() / 8 + 1 {
        let problem =
            format!("it announces {vertices} vertices and {faces} faces, more than the file can hold");
        return Err((Place::Line(line), problem));
    }
    let mut soup = PolygonSoup {
        positions: Vec::with_capacity(vertices),
        polygons: Vec::with_capacity(faces),
        ..PolygonSoup::default()
    };
    let mut next_line = |what: &str| {
        lines
            .next()
            .ok_or_else(|| (Place::Line(text.lines().count()), format!("the file ends before {what}")))
    };
    for v in 0..vertices {
        let (line, content) = next_line(&format!("vertex {v} of {vertices}"))?;
        let mut words = content.split_whitespace();
        let mut next = || number::<f64>(words.next(), line, "a coordinate");
        soup.positions.push(DVec3::new(next()?, next()?, next()?));
    }
    for f in 0..faces {
        let (line, content) = next_line(&format!("face {f} of {faces}"))?;
        let mut words = content.split_whitespace();
        let corners: usize = number(words.next(), line, "a number of corners")?;
        let corner = |_| number::<u32>(words.next(), line, "a vertex number");
        soup.polygons.push((0..corners).map(corner).collect::<Result<_, _>>()?);
    }
    Ok(soup)
}

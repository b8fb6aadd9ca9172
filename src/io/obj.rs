//! Wavefront OBJ: vertices and faces; the vertex order of the file is kept.

use super::problem::{Place, Problem};
use super::reading::{lines, number, text, without_comment};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

pub(super) fn read(bytes: &[u8]) -> Result<PolygonSoup, Problem> {
    let mut soup = PolygonSoup::default();
    let text = text(bytes)?;
    let mut lines = lines(&text);
    while let Some((line_number, line)) = lines.next() {
        let content = without_comment(line);
        match content.split_whitespace().next() {
            Some("v" | "f") if content.ends_with('\\') => {
                read_line(&whole(content, &mut lines), line_number, &mut soup)?;
            }
            Some("v" | "f") => read_line(content, line_number, &mut soup)?,
            _ => {}
        }
    }
    Ok(soup)
}

/// A line that is continued: a backslash at its end joins the next one to it.
fn whole<'a>(first: &str, rest: &mut impl Iterator<Item = (usize, &'a str)>) -> String {
    let mut joined = String::new();
    let mut part = first;
    while let Some(open) = part.strip_suffix('\\') {
        joined.push_str(open);
        joined.push(' ');
        part = rest.next().map_or("", |(_, line)| without_comment(line));
    }
    joined + part
}

/// A vertex or a face.
fn read_line(content: &str, line: usize, soup: &mut PolygonSoup) -> Result<(), Problem> {
    let mut words = content.split_whitespace();
    if words.next() == Some("v") {
        let mut next = || number::<f64>(words.next(), line, "a coordinate");
        soup.positions.push(DVec3::new(next()?, next()?, next()?));
        return Ok(());
    }
    let corner = |word: &str| vertex(word, soup.positions.len(), line);
    let polygon: Vec<u32> = words.map(corner).collect::<Result<_, _>>()?;
    if polygon.len() < 3 {
        let problem = format!("the face has {} corners; it needs at least 3", polygon.len());
        return Err((Place::Line(line), problem));
    }
    soup.polygons.push(polygon);
    Ok(())
}

/// The vertex of a corner `v`, `v/t`, `v//n` or `v/t/n`; negative numbers count back from the last vertex so far.
fn vertex(word: &str, vertices: usize, line: usize) -> Result<u32, Problem> {
    let value: i64 = number(word.split('/').next(), line, "a vertex number")?;
    let index = if value < 0 { vertices as i64 + value } else { value - 1 };
    u32::try_from(index).map_err(|_| (Place::Line(line), format!("there is no vertex {value}")))
}

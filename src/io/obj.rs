//! Wavefront OBJ: vertices and faces; the vertex order of the file is kept. Its lines and numbers are read here for all who
//! read something of such a file.

use super::problem::{Place, Problem, Unread};
use super::reading::{lines, number, text, unusable, without_comment};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::Pulse;
use glam::DVec3;

/// Kinds of lines that may be continued. Others hold names, which may end in a backslash, or are passed over.
const CONTINUED: [&str; 5] = ["v", "vt", "vn", "f", "l"];

pub(super) fn read(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Unread> {
    let mut soup = PolygonSoup::default();
    // The largest vertex index that a face names, with its line: a face may stand before its vertices.
    let mut largest: Option<(u32, usize)> = None;
    for line in whole_lines(&text(bytes)?) {
        pulse.beat()?;
        match line.kind {
            "v" => soup.positions.push(DVec3::from(coordinates(&line)?)),
            "f" => {
                let corner = |word: &str| vertex(word, soup.positions.len(), line.number);
                let polygon: Vec<u32> = corners(&line)?.map(corner).collect::<Result<_, _>>()?;
                for &index in &polygon {
                    if largest.is_none_or(|(most, _)| index > most) {
                        largest = Some((index, line.number));
                    }
                }
                soup.polygons.push(polygon);
            }
            _ => {}
        }
    }
    let vertices = soup.positions.len();
    match largest.filter(|&(index, _)| index as usize >= vertices) {
        // The numbers of the file begin at 1.
        Some((index, line)) => {
            let number = u64::from(index) + 1;
            let problem = format!("the face names vertex {number}, but the file has {vertices} vertices");
            Err((Place::Line(line), problem).into())
        }
        None => Ok(soup),
    }
}

/// A line with those that continue it: a backslash at its end joins the next one to it.
pub(super) struct WholeLine<'a> {
    /// The number of its first line in the file, from 1.
    pub number: usize,
    /// Its first word.
    pub kind: &'a str,
    first: &'a str,
    /// The lines that continue it.
    rest: Vec<&'a str>,
}

impl<'a> WholeLine<'a> {
    /// The words after the first one, without comments, as they stand in the text.
    pub(super) fn words(&self) -> impl Iterator<Item = &'a str> {
        let can_go_on = CONTINUED.contains(&self.kind);
        let content = move |part| if can_go_on { unfinished(part).0 } else { without_comment(part) };
        self.parts().flat_map(move |part| content(part).split_whitespace()).skip(1)
    }

    /// The lines as they stand in the text, without their ends.
    pub(super) fn parts(&self) -> impl Iterator<Item = &'a str> {
        std::iter::once(self.first).chain(self.rest.iter().copied())
    }
}

/// The content of a line without its comment and without the backslash at its end, and whether there is a backslash.
fn unfinished(line: &str) -> (&str, bool) {
    let content = without_comment(line);
    content.strip_suffix('\\').map_or((content, false), |content| (content, true))
}

/// The lines of a text that hold more than spaces and comments.
pub(super) fn whole_lines(text: &str) -> impl Iterator<Item = WholeLine<'_>> {
    let mut lines = lines(text);
    std::iter::from_fn(move || {
        loop {
            let (number, first) = lines.next()?;
            let (content, mut is_open) = unfinished(first);
            let Some(kind) = content.split_whitespace().next() else { continue };
            is_open &= CONTINUED.contains(&kind);
            let mut rest = Vec::new();
            while is_open {
                let Some((_, line)) = lines.next() else { break };
                is_open = unfinished(line).1;
                rest.push(line);
            }
            return Some(WholeLine { number, kind, first, rest });
        }
    })
}

/// The words of a vertex's coordinates.
pub(super) fn coordinate_words<'a>(line: &WholeLine<'a>) -> [Option<&'a str>; 3] {
    let mut words = line.words();
    std::array::from_fn(|_| words.next())
}

fn coordinates(line: &WholeLine<'_>) -> Result<[f64; 3], Problem> {
    let mut p = [0.0; 3];
    for (x, word) in p.iter_mut().zip(coordinate_words(line)) {
        *x = number(word, line.number, "a coordinate")?;
    }
    match unusable(DVec3::from(p)) {
        Some(problem) => Err((Place::Line(line.number), problem)),
        None => Ok(p),
    }
}

/// The words of a face's corners, of which there must be three.
pub(super) fn corners<'a>(line: &WholeLine<'a>) -> Result<impl Iterator<Item = &'a str>, Problem> {
    let count = line.words().take(3).count();
    if count < 3 {
        let problem = format!("the face has {count} corners; it needs at least 3");
        return Err((Place::Line(line.number), problem));
    }
    Ok(line.words())
}

/// The vertex of a corner `v`, `v/t`, `v//n` or `v/t/n`; negative numbers count back from the last vertex so far.
pub(super) fn vertex(word: &str, so_far: usize, line: usize) -> Result<u32, Problem> {
    let value = number(word.split('/').next(), line, "a vertex number")?;
    index(value, so_far).ok_or_else(|| (Place::Line(line), format!("there is no vertex {value}")))
}

/// The index, from 0, of a number that counts from 1, or back from the last of those so far.
pub(super) fn index(value: i64, so_far: usize) -> Option<u32> {
    u32::try_from(if value < 0 { so_far as i64 + value } else { value - 1 }).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_whole() {
        let text = "#v \\\nv 1\\\r\n 2 # two\\\n3\n\rg C:\\\rf 1 \\\n\\\n2\nvt 1\\";
        let found: Vec<_> = whole_lines(text)
            .map(|line| (line.number, line.kind, line.words().collect::<Vec<_>>()))
            .collect();
        // What ends in a comment is not continued.
        let expected = [
            (2, "v", vec!["1", "2"]),
            (4, "3", vec![]),
            (6, "g", vec!["C:\\"]),
            (7, "f", vec!["1", "2"]),
            (10, "vt", vec!["1"]),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn numbers_count_from_both_ends() {
        let found = [1, 3, 4, -1, -3, -4, 0, i64::MIN, i64::MAX].map(|value| index(value, 3));
        assert_eq!(found, [Some(0), Some(2), Some(3), Some(2), Some(0), None, None, None, None]);
    }
}

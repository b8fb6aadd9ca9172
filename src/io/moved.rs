//! Text of a mesh file with its vertices at other places: all else stays byte for byte.
//!
//! Of an OBJ file only the three coordinates of its `v` lines change, of an OFF file those of its vertices. What follows them on the
//! line, as colours do, stays, and so do order, comments, spaces and line ends.

use super::{Format, detect};
use glam::DVec3;
use std::fmt::Write;

/// What becomes of the normals in an OBJ file: they are those of the old places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// They stay as they are.
    #[default]
    Kept,
    /// Their lines go, and their numbers in faces, so that programs make new ones.
    Dropped,
}

/// Why a file cannot be written with other places.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MoveError {
    /// Its format has no lines that could be kept.
    #[error(
        "lines can be kept of OBJ and OFF files only, and this is {}: save the mesh as OBJ first",
        .0.map_or("none of them".to_owned(), |format| format!("a file in the format {format}"))
    )]
    Format(Option<Format>),
    /// It is not text.
    #[error("the file holds bytes that are not text: it may be damaged")]
    NotText,
    /// It has another number of vertices.
    #[error("the file has {found} vertices, but there are places for {places}")]
    Count {
        /// Vertices in the file.
        found: usize,
        /// Places that were given.
        places: usize,
    },
}

/// The file with its vertices, in their order, at other places.
///
/// # Errors
/// [`MoveError`].
pub fn with_positions(bytes: &[u8], places: &[DVec3], normals: Normals) -> Result<Vec<u8>, MoveError> {
    let format = detect(bytes);
    let text = std::str::from_utf8(bytes).map_err(|_| MoveError::NotText);
    let (moved, found) = match format {
        Some(Format::Obj) => obj(text?, places, normals),
        Some(Format::Off) => off(text?, places),
        other => return Err(MoveError::Format(other)),
    };
    if found == places.len() {
        Ok(moved.into_bytes())
    } else {
        Err(MoveError::Count { found, places: places.len() })
    }
}

/// Whether a file's format has lines that can be kept.
///
/// # Errors
/// [`MoveError::Format`].
pub fn check_format(bytes: &[u8]) -> Result<(), MoveError> {
    match detect(bytes) {
        Some(Format::Obj | Format::Off) => Ok(()),
        other => Err(MoveError::Format(other)),
    }
}

/// Whether an OBJ file holds normals.
pub fn has_normals(bytes: &[u8]) -> bool {
    let is_normal = |line: &[u8]| line.trim_ascii_start().starts_with(b"vn");
    detect(bytes) == Some(Format::Obj) && bytes.split(|b| *b == b'\n').any(is_normal)
}

/// The first word of a line.
fn first_word(line: &str) -> Option<&str> {
    line.trim_start_matches('\u{feff}').split_whitespace().next()
}

fn obj(text: &str, places: &[DVec3], normals: Normals) -> (String, usize) {
    let mut moved = String::with_capacity(2 * text.len());
    let mut found = 0;
    for line in text.split_inclusive('\n') {
        match (first_word(line), normals) {
            (Some("v"), _) => {
                write_moved(&mut moved, line, 1, places.get(found));
                found += 1;
            }
            (Some("vn"), Normals::Dropped) => {}
            (Some("f"), Normals::Dropped) => write_without_normals(&mut moved, line),
            _ => moved.push_str(line),
        }
    }
    (moved, found)
}

fn off(text: &str, places: &[DVec3]) -> (String, usize) {
    let mut moved = String::with_capacity(2 * text.len());
    let mut found = 0;
    // The format's name, then the counts, which may stand on one line.
    let mut header = 2;
    for line in text.split_inclusive('\n') {
        let content = line.trim_start_matches('\u{feff}').split('#').next().unwrap_or_default();
        let words = content.split_whitespace().count();
        if words == 0 {
            moved.push_str(line);
        } else if header > 0 {
            moved.push_str(line);
            header = if header == 2 && words == 1 { 1 } else { 0 };
        } else if found < places.len() {
            write_moved(&mut moved, line, 0, places.get(found));
            found += 1;
        } else {
            moved.push_str(line);
        }
    }
    (moved, found)
}

/// A line with three of its words, after the first `skipped`, replaced by the coordinates of a place.
fn write_moved(moved: &mut String, line: &str, skipped: usize, place: Option<&DVec3>) {
    let Some(place) = place else { return moved.push_str(line) };
    let mut rest = line;
    for word in 0..skipped + 3 {
        let begin = rest.find(|c: char| !c.is_whitespace()).unwrap_or(rest.len());
        let (space, from_word) = rest.split_at(begin);
        let end = from_word.find(|c: char| c.is_whitespace() || c == '#').unwrap_or(from_word.len());
        let (old, after) = from_word.split_at(end);
        moved.push_str(space);
        match word.checked_sub(skipped) {
            // Writing to a string does not fail.
            Some(axis) => drop(write!(moved, "{}", place[axis])),
            None => moved.push_str(old),
        }
        rest = after;
    }
    moved.push_str(rest);
}

/// A face's line, its corners `v/t/n` as `v/t` and `v//n` as `v`.
fn write_without_normals(moved: &mut String, line: &str) {
    let mut rest = line;
    while !rest.is_empty() {
        let begin = rest.find(|c: char| !c.is_whitespace()).unwrap_or(rest.len());
        let (space, from_word) = rest.split_at(begin);
        let end = from_word.find(char::is_whitespace).unwrap_or(from_word.len());
        let (word, after) = from_word.split_at(end);
        moved.push_str(space);
        let mut numbers = word.split('/');
        moved.push_str(numbers.next().unwrap_or_default());
        if let Some(texture) = numbers.next().filter(|texture| !texture.is_empty()) {
            moved.push('/');
            moved.push_str(texture);
        }
        rest = after;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;

    const OBJ: &str = "\u{feff}# by hand\r\nmtllib a.mtl\r\n  v  0 0\t0 1 0.5 0.25\r\nv 1 0 0\r\nvt 0 1\r\nvn 0 0 1\r\n\
                       g left\r\nv 0 1 0 # last\r\nusemtl skin\r\nf 1/1/1 2//1  3/1\r\n\r\ns off";

    fn places() -> Vec<DVec3> {
        vec![DVec3::new(0.1, -2e-9, 3.0), DVec3::splat(7.0), DVec3::new(1.0 / 3.0, 0.0, -1.0)]
    }

    #[test]
    fn only_the_coordinates_of_an_obj_change() {
        let moved = with_positions(OBJ.as_bytes(), &places(), Normals::Kept).unwrap();
        let text = String::from_utf8(moved.clone()).unwrap();
        assert!(text.contains("\r\n  v  0.1 -0.000000002\t3 1 0.5 0.25\r\n"), "{text}");
        assert!(text.contains("\r\nv 0.3333333333333333 0 -1 # last\r\n"), "{text}");
        let others = |text: &str| -> Vec<String> {
            let is_other = |line: &&str| first_word(line) != Some("v");
            text.split_inclusive('\n').filter(is_other).map(str::to_owned).collect()
        };
        assert_eq!(others(&text), others(OBJ));
        assert_eq!(read_mesh(&moved).unwrap().positions, places());
    }

    #[test]
    fn dropped_normals_leave_faces_that_can_be_read() {
        let moved = with_positions(OBJ.as_bytes(), &places(), Normals::Dropped).unwrap();
        let text = String::from_utf8(moved.clone()).unwrap();
        assert!(text.contains("\r\nf 1/1 2  3/1\r\n") && !text.contains("vn"), "{text}");
        assert_eq!(read_mesh(&moved).unwrap().polygons, read_mesh(OBJ.as_bytes()).unwrap().polygons);
    }

    #[test]
    fn only_the_coordinates_of_an_off_change() {
        for header in ["COFF\n# counts\n3 1 0\n", "OFF 3 1 0 # in one line\n"] {
            let text = format!("{header}\n0 0 0 255 0 0\n1 0 0#c\n 0 1 0\n3 0 1 2\n");
            let moved = with_positions(text.as_bytes(), &places(), Normals::Kept).unwrap();
            let expected =
                format!("{header}\n0.1 -0.000000002 3 255 0 0\n7 7 7#c\n 0.3333333333333333 0 -1\n3 0 1 2\n");
            assert_eq!(String::from_utf8(moved).unwrap(), expected);
        }
    }

    #[test]
    fn other_formats_and_numbers_are_refused() {
        let stl = b"solid t\nendsolid t\n";
        assert_eq!(
            with_positions(stl, &[], Normals::Kept).unwrap_err(),
            MoveError::Format(Some(Format::Stl))
        );
        let error = with_positions(OBJ.as_bytes(), &places()[..2], Normals::Kept).unwrap_err();
        assert_eq!(error, MoveError::Count { found: 3, places: 2 });
        let sentence = MoveError::Format(Some(Format::Stl)).to_string();
        assert!(sentence.contains("format STL: save the mesh as OBJ first"), "{sentence}");
    }
}

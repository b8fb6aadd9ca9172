//! Text of a mesh file with its vertices at other places: all else stays byte for byte.
//!
//! In an OBJ file only the three coordinates of its `v` lines change, in an OFF file those of its vertices (a fourth one, by which they are
//! divided, becomes 1). What follows them on the line, as colours do, stays, and so do order, comments, spaces, line ends and the encoding.
//! The readers of both formats say where coordinates stand, and the written file is read again: a file that would be read otherwise is
//! refused.

use super::problem::Place;
use super::written_text::{Replacing, WrittenText};
use super::{Format, ReadError, detect, obj, off, read_mesh};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

/// The treatment of the normals in an OBJ file, which are those of the old places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// The normals stay as they are.
    #[default]
    Kept,
    /// The lines of normals go, and their numbers in faces, so that programs make new ones.
    Dropped,
}

/// Why a file cannot be written with other places.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MoveError {
    /// The file's format has no lines that could be kept.
    #[error(
        "lines can be kept of OBJ and OFF files only, and this is {}: save the mesh as OBJ first",
        .0.map_or("none of them".to_owned(), |format| format!("a file in the format {format}"))
    )]
    Format(Option<Format>),
    /// The file is binary.
    #[error(
        "lines can be kept of text files only, and this is a binary OFF file: save the mesh as OBJ first"
    )]
    Binary,
    /// The file is not text.
    #[error("the file holds bytes that are not text: it may be damaged; save the mesh anew as OBJ")]
    NotText,
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// With other places, or without its normals, the file could not be read.
    #[error("what would be written cannot be read ({0}): save the mesh anew as OBJ")]
    Unreadable(ReadError),
    /// The file has another number of vertices.
    #[error("the file has {found} vertices, but there are places for {places}")]
    Count {
        /// Number of vertices in the file.
        found: usize,
        /// Number of places that were given.
        places: usize,
    },
    /// With other places the file holds another mesh.
    #[error(
        "with its vertices at other places the file is read otherwise, at {0}: save the mesh anew as OBJ"
    )]
    ReadsOtherwise(Place),
}

/// The file with its vertices, in their order, at other places; it reads back as these places and the polygons as they were.
///
/// # Errors
/// [`MoveError`].
pub fn with_positions(bytes: &[u8], places: &[DVec3], normals: Normals) -> Result<Vec<u8>, MoveError> {
    moved(bytes, &read_mesh(bytes)?, places, normals)
}

/// Whether a file can be written with other places: it is tried with its own ones, and with these moved.
///
/// # Errors
/// [`MoveError`].
pub fn check(bytes: &[u8], normals: Normals) -> Result<(), MoveError> {
    let format = detect(bytes);
    if !matches!(format, Some(Format::Obj | Format::Off)) {
        return Err(MoveError::Format(format));
    }
    let soup = read_mesh(bytes)?;
    moved(bytes, &soup, &soup.positions, normals)?;
    // The mesh is made smaller by a third and moved, so that all words become others, of another length.
    let size = soup.positions.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let shift = DVec3::new(size + 1.0, -size, size) / 3.0;
    let others: Vec<DVec3> = soup.positions.iter().map(|p| *p / 3.0 + shift).collect();
    moved(bytes, &soup, &others, normals).map(drop)
}

/// Whether a file holds normals.
pub fn has_normals(bytes: &[u8]) -> bool {
    let Some(written) = WrittenText::of(bytes) else { return false };
    match detect(bytes) {
        Some(Format::Obj) => obj::whole_lines(&written.text).any(|line| line.kind == "vn"),
        Some(Format::Off) => off::has_normals(&written.text),
        _ => false,
    }
}

fn moved(bytes: &[u8], soup: &PolygonSoup, places: &[DVec3], normals: Normals) -> Result<Vec<u8>, MoveError> {
    let format = detect(bytes);
    if soup.positions.len() != places.len() {
        return Err(MoveError::Count { found: soup.positions.len(), places: places.len() });
    }
    if format == Some(Format::Off) && off::is_binary(bytes) {
        return Err(MoveError::Binary);
    }
    let rewritten = match format {
        Some(Format::Obj) => rewritten_obj,
        Some(Format::Off) => rewritten_off,
        other => return Err(MoveError::Format(other)),
    };
    let written = WrittenText::of(bytes).ok_or(MoveError::NotText)?;
    let moved = written.encoded(&rewritten(&written.text, places, normals));
    let again = read_mesh(&moved).map_err(MoveError::Unreadable)?;
    match other_place(soup, places, &again) {
        Some(place) => Err(MoveError::ReadsOtherwise(place)),
        None => Ok(moved),
    }
}

/// The place at which a mesh that was read differs from what it should be: these places with the polygons of the other soup.
fn other_place(soup: &PolygonSoup, places: &[DVec3], found: &PolygonSoup) -> Option<Place> {
    let shorter = places.len().min(found.positions.len());
    let vertex = (0..shorter).find(|&v| places[v] != found.positions[v]);
    let vertex = vertex.or((places.len() != found.positions.len()).then_some(shorter));
    let shorter = soup.polygons.len().min(found.polygons.len());
    let face = || (0..shorter).find(|&f| soup.polygons[f] != found.polygons[f]);
    let face = || face().or((soup.polygons.len() != found.polygons.len()).then_some(shorter));
    vertex.map(Place::Vertex).or_else(|| face().map(Place::Face))
}

fn rewritten_obj(text: &str, places: &[DVec3], normals: Normals) -> String {
    let mut replacing = Replacing::new(text);
    let mut places = places.iter();
    for line in obj::whole_lines(text) {
        match (line.kind, normals) {
            ("v", _) => {
                let words = obj::coordinate_words(&line).into_iter().flatten();
                let place = places.next().into_iter().flat_map(|place| place.to_array());
                words.zip(place).for_each(|(word, x)| replacing.replace(word, x));
            }
            ("vn", Normals::Dropped) => line.parts().for_each(|part| replacing.leave_out_line(part)),
            ("f", Normals::Dropped) => {
                line.words().for_each(|corner| replacing.replace(corner, without_normal(corner)));
            }
            _ => {}
        }
    }
    replacing.finish()
}

/// A corner `v/t/n` as `v/t`, and `v//n` as `v`.
fn without_normal(corner: &str) -> &str {
    corner
        .rsplit_once('/')
        .filter(|(rest, _)| rest.contains('/'))
        .map_or(corner, |(rest, _)| rest.trim_end_matches('/'))
}

fn rewritten_off<'a>(text: &'a str, places: &[DVec3], _: Normals) -> String {
    let mut replacing = Replacing::new(text);
    let mut places = places.iter();
    let replace = |words: off::CoordinateWords<'a>| {
        let Some(place) = places.next() else { return };
        words.axes.into_iter().zip(place.to_array()).for_each(|(word, x)| replacing.replace(word, x));
        words.divisor.into_iter().for_each(|word| replacing.replace(word, 1));
    };
    // The text was read before; where it cannot be read now, the result is not what it should be, which is found.
    let _ = off::each_vertex(text, replace);
    replacing.finish()
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
            let is_other = |line: &&str| !line.trim_start().starts_with("v ");
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
    fn normals_are_dropped_from_lines_of_any_ends_and_not_from_comments() {
        let obj = "v 0 0 0\rv 1 0 0\rvn 0 0 \\\r 1\rv 0 1 0\rf 1//1 2//1 \\\r3//1 # of 1//1\rvn 0 1 0";
        let moved = with_positions(obj.as_bytes(), &places(), Normals::Dropped).unwrap();
        let text = String::from_utf8(moved.clone()).unwrap();
        assert!(text.ends_with("-1\rf 1 2 \\\r3 # of 1//1\r") && !text.contains("vn"), "{text:?}");
        assert!(has_normals(obj.as_bytes()) && !has_normals(&moved));
        let off =
            |keyword: &str| format!("{keyword}\n3 1 0\n{}3 0 1 2\n", "0 0 0 0 0 1\n".repeat(3)).into_bytes();
        assert_eq!(
            ["NOFF", "CNOFF", "OFF", "nOFF"].map(|keyword| has_normals(&off(keyword))),
            [true, true, false, false]
        );
    }

    #[test]
    fn encodings_continued_lines_and_ends_of_lines_stay() {
        let obj = "# Größe\rv 0 \\\r0 0 1\rv 1 0 0\\\r\rg C:\\\rv 0 1 0\rf 1 2 3\r";
        let wanted =
            "# Größe\rv 0.1 \\\r-0.000000002 3 1\rv 7 7 7\\\r\rg C:\\\rv 0.3333333333333333 0 -1\rf 1 2 3\r";
        let latin1 = |text: &str| text.chars().map(|c| c as u8).collect::<Vec<_>>();
        let utf16 = |text: &str, order: fn(u16) -> [u8; 2]| -> Vec<u8> {
            "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(order).collect()
        };
        let written = |text: &str| {
            [
                text.as_bytes().to_vec(),
                latin1(text),
                utf16(text, u16::to_le_bytes),
                utf16(text, u16::to_be_bytes),
            ]
        };
        for (given, wanted) in written(obj).into_iter().zip(written(wanted)) {
            assert_eq!(with_positions(&given, &places(), Normals::Kept), Ok(wanted));
            assert_eq!(check(&given, Normals::Dropped), Ok(()));
        }
    }

    #[test]
    fn only_the_coordinates_of_an_off_change() {
        let texts = [
            "COFF\n# counts\n3 1 0\n\n{a} 255 0 0\n{b}#c\n {c}\n3 0 1 2\n",
            "OFF 3 1 0 # in one line\n{a}\n{b}\n{c}\n3 0 1 2\n",
            "OFF3 1 0\r{a}\r{b}\r{c}\r3 0 1 2\r",
            "nOFF\n3\n3 1 0\n{a}\n{b}\n{c}\n3 0 1 2\n",
            "nOFF 3 3 1 0\n{a}\n{b}\n{c}\n3 0 1 2\n",
            "NOFF\n# a\n\n3 1 0\n{a} 0 0 1\n{b} 0 0 1\n{c} 0 0 1\n3 0 1 2\n",
            "STCNOFF\r\n3 1 0\r\n{a} 0 0 1 1 1 1 1 0 0\r\n{b} 0 0 1\r\n{c}\r\n3 0 1 2 # last\r\n",
            "OFF 3 1 0 {a} {b} {c} 3 0 1 2",
            "OFF 3 1 0 {a} {b}\n# between\n{c} 3\n0 1 2\n",
            "NOFF 3 1 0 {a} 0 0 1 {b} 0 0 1 {c} 0 0 1 3 0 1 2",
            "3 1 0\n{a}\n{b}\n{c}\n3 0 1 2\n",
            "\u{feff}# no keyword\n3 1\n{a}\n{b}\n{c}\n3 0 1 2\n",
        ];
        let with =
            |text: &str, [a, b, c]: [&str; 3]| text.replace("{a}", a).replace("{b}", b).replace("{c}", c);
        let moved_to = ["0.1 -0.000000002 3", "7\t7 7", "0.3333333333333333 0 -1"];
        for text in texts {
            let given = with(text, ["0 0 0", "1.5\t0 0", "0 1e0 0"]);
            let moved = with_positions(given.as_bytes(), &places(), Normals::Kept).unwrap();
            assert_eq!(String::from_utf8(moved).unwrap(), with(text, moved_to));
            assert_eq!(check(given.as_bytes(), Normals::Kept), Ok(()));
        }
    }

    #[test]
    fn a_fourth_coordinate_becomes_1() {
        let given = "4OFF\n3 1 0\n0 0 0 2\n1 0 0 -3 255\n0 1 0 0.3\n3 0 1 2\n";
        let wanted = "4OFF\n3 1 0\n0.1 -0.000000002 3 1\n7 7 7 1 255\n0.3333333333333333 0 -1 1\n3 0 1 2\n";
        let moved = with_positions(given.as_bytes(), &places(), Normals::Kept).unwrap();
        assert_eq!(String::from_utf8(moved).unwrap(), wanted);
        assert_eq!(check(given.as_bytes(), Normals::Kept), Ok(()));
    }

    #[test]
    fn what_would_be_read_otherwise_is_refused() {
        let mut places = places();
        places[1].y = f64::INFINITY;
        let error = with_positions(OBJ.as_bytes(), &places, Normals::Kept).unwrap_err();
        assert!(matches!(error, MoveError::Unreadable(_)), "{error}");
        let soup = read_mesh(OBJ.as_bytes()).unwrap();
        let mut other = soup.clone();
        other.positions[2].z = 1.0;
        assert_eq!(other_place(&soup, &soup.positions, &other), Some(Place::Vertex(2)));
        let (mut longer, mut turned) = (soup.clone(), soup.clone());
        longer.polygons.push(vec![0, 1, 2]);
        turned.polygons[0].reverse();
        assert_eq!(other_place(&soup, &soup.positions, &longer), Some(Place::Face(1)));
        assert_eq!(other_place(&soup, &soup.positions, &turned), Some(Place::Face(0)));
        assert_eq!(other_place(&soup, &soup.positions, &soup), None);
        let half = b"\xff\xfev\0 \x000\0 \x000\0 \x000\0\n\0#\0\0";
        assert_eq!(check(half, Normals::Kept), Err(MoveError::NotText));
        let binary = [b"OFF BINARY\n".to_vec(), [0, 0, 0].map(u32::to_be_bytes).concat()].concat();
        assert_eq!(check(&binary, Normals::Kept), Err(MoveError::Binary));
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

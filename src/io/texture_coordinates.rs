//! A mesh file's own texture coordinates, corner by corner of its polygons: `vt` of OBJ files, and of PLY files the vertex
//! properties `u`, `v`, or `s`, `t`, or `texture_u`, `texture_v`.

use super::problem::{Place, Problem};
use super::reading::{number, text};
use super::{Format, MAX_BYTES, ReadError, detect, read_mesh, vertex_table};
use glam::DVec2;

/// Names of the two vertex properties of PLY files.
const PROPERTIES: [[&str; 2]; 3] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]];

/// What is wrong with texture coordinates, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureCoordinateError {
    /// The mesh cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Another format, or none there.
    #[error(
        "it has no texture coordinates that can be read: give an OBJ file with `vt` lines, or a PLY file with the vertex properties u and v"
    )]
    None,
    /// Something in them is wrong.
    #[error("{place}: {problem}")]
    Malformed {
        /// Where.
        place: Place,
        /// What is wrong.
        problem: String,
    },
}

impl From<Problem> for TextureCoordinateError {
    fn from((place, problem): Problem) -> Self {
        Self::Malformed { place, problem }
    }
}

/// Texture coordinates of each corner of each polygon, in the file's order.
///
/// # Errors
/// [`TextureCoordinateError`].
pub fn read(bytes: &[u8]) -> Result<Vec<Vec<DVec2>>, TextureCoordinateError> {
    if bytes.len() > MAX_BYTES {
        return Err(ReadError::TooLarge { bytes: bytes.len() }.into());
    }
    match detect(bytes) {
        Some(Format::Obj) => obj(bytes),
        Some(Format::Ply) => ply(bytes),
        _ => Err(TextureCoordinateError::None),
    }
}

fn obj(bytes: &[u8]) -> Result<Vec<Vec<DVec2>>, TextureCoordinateError> {
    let (mut given, mut polygons) = (Vec::new(), Vec::new());
    for (index, content) in text(bytes)?.lines().enumerate() {
        let line = index + 1;
        let mut words = content.split_whitespace();
        match words.next() {
            Some("vt") => {
                let mut next = || number::<f64>(words.next(), line, "a texture coordinate");
                let uv = DVec2::new(next()?, next()?);
                if !uv.is_finite() {
                    return Err((Place::Line(line), format!("{uv} are no usable texture coordinates")).into());
                }
                given.push(uv);
            }
            Some("f") => {
                let corner = |word: &str| of_corner(word, &given, line);
                polygons.push(words.map(corner).collect::<Result<Vec<_>, _>>()?);
            }
            _ => {}
        }
    }
    if given.is_empty() { Err(TextureCoordinateError::None) } else { Ok(polygons) }
}

/// The texture coordinates of a corner `v/t` or `v/t/n`; negative numbers count back from the last ones so far.
fn of_corner(word: &str, given: &[DVec2], line: usize) -> Result<DVec2, Problem> {
    let token = word.split('/').nth(1).filter(|token| !token.is_empty());
    let none = || (Place::Line(line), format!("the corner {word} has no texture coordinates"));
    let value: i64 = number(Some(token.ok_or_else(none)?), line, "a number of texture coordinates")?;
    let index = if value < 0 { (given.len() as i64).checked_add(value) } else { value.checked_sub(1) };
    let known = index.and_then(|index| given.get(usize::try_from(index).ok()?));
    known.copied().ok_or_else(|| (Place::Line(line), format!("there are no texture coordinates {value}")))
}

fn ply(bytes: &[u8]) -> Result<Vec<Vec<DVec2>>, TextureCoordinateError> {
    let soup = read_mesh(bytes)?;
    let table = vertex_table::read(bytes, soup.positions.len()).map_err(|_| TextureCoordinateError::None)?;
    let column = |name: &str| table.columns.iter().find(|column| column.name == name);
    let found = PROPERTIES.iter().find_map(|[u, v]| column(u).zip(column(v)));
    let (us, vs) = found.ok_or(TextureCoordinateError::None)?;
    let uv = |v: &u32| {
        let value = |column: &vertex_table::Column| column.values[*v as usize].unwrap_or(0.0);
        DVec2::new(value(us), value(vs))
    };
    Ok(soup.polygons.iter().map(|polygon| polygon.iter().map(uv).collect()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_read_of_both_formats() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
        let text = format!("{vertices}vt 0 0\nvt 0.5 1 0\nvt 1 0\nf 1/1 2/2/1 3/-1\nf 1/3 3/2 4/1\n");
        let [a, b, c] = [[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]].map(DVec2::from);
        assert_eq!(read(text.as_bytes()).unwrap(), [[a, b, c], [c, b, a]]);
        let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                   property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                   0 0 0 0 0\n1 0 0 0.5 1\n0 1 0 1 0\n3 0 1 2\n";
        assert_eq!(read(ply.as_bytes()).unwrap(), [[a, b, c]]);
    }

    #[test]
    fn faults_are_told_with_their_line() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
        let told = |rest: &str| read(format!("{vertices}{rest}").as_bytes()).unwrap_err().to_string();
        assert!(told("f 1 2 3\nf 1 2 4\n").starts_with("line 5: the corner 1 has no texture coordinates"));
        assert_eq!(told("vt 0 0\nf 1/1 2/2 3/1\n"), "line 6: there are no texture coordinates 2");
        assert_eq!(told("vt 0 inf\nf 1/1 2/1 3/1\n"), "line 5: [0, inf] are no usable texture coordinates");
        assert_eq!(told("vt 0\n"), "line 5: a texture coordinate is missing: the file may be cut off");
        assert_eq!(read(b"OFF\n4 4 0\n"), Err(TextureCoordinateError::None));
    }
}

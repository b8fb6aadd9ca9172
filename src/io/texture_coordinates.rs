//! A mesh file's own texture coordinates, corner by corner of its polygons: `vt` of OBJ files, and of PLY files the vertex
//! properties `u`, `v`, or `s`, `t`, or `texture_u`, `texture_v`.

use super::problem::{Place, Problem};
use super::reading::{number, text};
use super::vertex_table::{TableError, VertexTable};
use super::{Format, MAX_BYTES, ReadError, detect, obj, read_mesh, vertex_table};
use glam::DVec2;

/// Names of the two vertex properties of PLY files.
const PROPERTIES: [[&str; 2]; 3] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]];

/// The error about texture coordinates, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureCoordinateError {
    /// The mesh cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file has another format, or no texture coordinates.
    #[error(
        "it has no texture coordinates that can be read: give an OBJ file with `vt` lines, or a PLY file with the vertex properties u and v"
    )]
    None,
    /// Something in them is wrong.
    #[error("{place}: {problem}")]
    Malformed {
        /// The place of the fault.
        place: Place,
        /// The problem.
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
/// [`TextureCoordinateError`], also where a corner has none.
pub fn read(bytes: &[u8]) -> Result<Vec<Vec<DVec2>>, TextureCoordinateError> {
    if bytes.len() > MAX_BYTES {
        return Err(ReadError::TooLarge { bytes: bytes.len() }.into());
    }
    match detect(bytes) {
        Some(Format::Obj) => {
            let whole = |polygon: PolygonPlaces| {
                let problem = "a corner of the face has no texture coordinates".to_owned();
                let corners: Option<Vec<DVec2>> = polygon.corners.into_iter().collect();
                corners.ok_or_else(|| (Place::Line(polygon.line), problem).into())
            };
            of_obj(bytes)?.into_iter().map(whole).collect()
        }
        Some(Format::Ply) => ply(bytes),
        _ => Err(TextureCoordinateError::None),
    }
}

/// The texture coordinates of a polygon of an OBJ file.
pub(super) struct PolygonPlaces {
    /// The line of the polygon, from 1.
    line: usize,
    /// The texture coordinates of each corner; `None` for a corner without.
    pub(super) corners: Vec<Option<DVec2>>,
}

/// The texture coordinates of an OBJ file, polygon by polygon.
pub(super) fn of_obj(bytes: &[u8]) -> Result<Vec<PolygonPlaces>, TextureCoordinateError> {
    let (mut given, mut polygons) = (Vec::new(), Vec::new());
    for line in obj::whole_lines(&text(bytes)?) {
        match line.kind {
            "vt" => {
                let mut words = line.words();
                let mut next = || number::<f64>(words.next(), line.number, "a texture coordinate");
                let uv = DVec2::new(next()?, next()?);
                if !uv.is_finite() {
                    let problem = format!("{uv} are no usable texture coordinates");
                    return Err((Place::Line(line.number), problem).into());
                }
                given.push(uv);
            }
            "f" => {
                let corner = |word: &str| of_corner(word, &given, line.number);
                let corners = obj::corners(&line)?.map(corner).collect::<Result<_, _>>()?;
                polygons.push(PolygonPlaces { line: line.number, corners });
            }
            _ => {}
        }
    }
    Ok(polygons)
}

/// The texture coordinates of a corner `v/t` or `v/t/n`, and none of `v` or `v//n`; negative numbers count back from the last ones so far.
fn of_corner(word: &str, given: &[DVec2], line: usize) -> Result<Option<DVec2>, Problem> {
    let Some(token) = word.split('/').nth(1).filter(|token| !token.is_empty()) else { return Ok(None) };
    let value: i64 = number(Some(token), line, "a number of texture coordinates")?;
    let known = obj::index(value, given.len()).and_then(|index| given.get(index as usize));
    let none = || (Place::Line(line), format!("there are no texture coordinates {value}"));
    known.copied().map(Some).ok_or_else(none)
}

fn ply(bytes: &[u8]) -> Result<Vec<Vec<DVec2>>, TextureCoordinateError> {
    let soup = read_mesh(bytes)?;
    let table = vertex_table::of_ply(bytes, soup.positions.len())
        .map_err(|TableError { place, problem }| TextureCoordinateError::Malformed { place, problem })?;
    of_table(&table, &soup.polygons).ok_or(TextureCoordinateError::None)
}

/// Texture coordinates of each corner of each polygon from those of the vertices; `None` where they have none.
pub(super) fn of_table(table: &VertexTable, polygons: &[Vec<u32>]) -> Option<Vec<Vec<DVec2>>> {
    let column = |name: &str| table.columns.iter().find(|column| column.name == name);
    let found = PROPERTIES.iter().find_map(|[u, v]| column(u).zip(column(v)));
    let (us, vs) = found?;
    let uv = |v: &u32| {
        // Both columns have a number for each vertex, and the vertices of polygons are there.
        let value = |column: &vertex_table::Column| column.values[*v as usize].unwrap_or(0.0);
        DVec2::new(value(us), value(vs))
    };
    Some(polygons.iter().map(|polygon| polygon.iter().map(uv).collect()).collect())
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
        let told_of_none = told("vt 0 0\nf 1/1 2 3//1\n");
        assert_eq!(told_of_none, "line 6: a corner of the face has no texture coordinates");
        assert_eq!(told("f 1 2 3\n"), "line 5: a corner of the face has no texture coordinates");
        assert_eq!(told("vt 0 0\nf 1/1 2/2 3/1\n"), "line 6: there are no texture coordinates 2");
        assert_eq!(told("vt 0 inf\nf 1/1 2/1 3/1\n"), "line 5: [0, inf] are no usable texture coordinates");
        assert_eq!(told("vt 0\n"), "line 5: a texture coordinate is missing: the file may be cut off");
        assert_eq!(read(b"OFF\n4 4 0\n"), Err(TextureCoordinateError::None));
        assert_eq!(told("vt 0 0\nf 1/1 2/1\n"), "line 6: the face has 2 corners; it needs at least 3");
        assert!(told("vt 0 0\nf 1/1 2/1 3/-2\n").ends_with("there are no texture coordinates -2"));
        let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                   property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                   0 0 0 0 0\n1 0 0 0.5 1e999\n0 1 0 1 0\n3 0 1 2\n";
        let told = read(ply.as_bytes()).unwrap_err().to_string();
        assert_eq!(told, "vertex 1: its \"v\" is not a usable number");
        let without = ply
            .replace("property float u\nproperty float v\n", "")
            .replace(" 0 0\n1 0 0 0.5 1e999\n0 1 0 1 0", "\n1 0 0\n0 1 0");
        assert_eq!(read(without.as_bytes()), Err(TextureCoordinateError::None));
    }

    #[test]
    fn lines_are_those_of_the_mesh() {
        let text = "v 0 0 0\rv 1 0 0\rv 0 1 \\\r0\rvt 0 \\\r0.5\r# f 1/9\rf 1/1 2/1 \\\r3/-1 # 4/7\r";
        let uv = DVec2::new(0.0, 0.5);
        let marked = format!("\u{feff}{text}");
        let utf16: Vec<u8> = marked.encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [text.as_bytes(), marked.as_bytes(), &utf16] {
            assert_eq!(read(bytes).unwrap(), [[uv; 3]]);
            assert_eq!(read_mesh(bytes).unwrap().polygons, [[0, 1, 2]]);
        }
    }
}

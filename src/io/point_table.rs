//! Points of a mesh, one a line: `face,b0,b1,b2` or `vertex`, fields in quotes or not. A first line may name the columns; where the first
//! one has no name it counts the rows, as R and pandas write it. What follows `#` is left out.

use super::MAX_BYTES;
use super::landmark_file::LandmarkPoint;
use super::problem::{Place, Problem};
use super::reading::{content_lines, short, text};
use super::separated::fields;
use std::borrow::Cow;

/// Why a table of points cannot be used, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct PointTableError {
    /// The place of the fault.
    pub place: Place,
    /// The problem and its remedy.
    pub problem: String,
}

impl From<Problem> for PointTableError {
    fn from((place, problem): Problem) -> Self {
        Self { place, problem }
    }
}

/// Names of a column of vertices or faces; a first line that names columns begins with one of them.
const NAMES: [&str; 6] = ["face", "vertex", "source_face", "target_face", "source_vertex", "target_vertex"];

/// Reads the points, with the numbers of their lines; neither vertices nor faces are checked against a mesh.
///
/// # Errors
/// [`PointTableError`] with the line.
pub fn read(bytes: &[u8]) -> Result<Vec<(usize, LandmarkPoint)>, PointTableError> {
    if bytes.len() > MAX_BYTES {
        let problem = format!("the file has {} bytes; the limit is {MAX_BYTES}", bytes.len());
        return Err(PointTableError { place: Place::Header, problem });
    }
    let text = text(bytes)?;
    let (mut points, mut counted) = (Vec::new(), 0);
    for (row, (line, content)) in content_lines(&text).enumerate() {
        let fields: Vec<Cow<'_, str>> = fields(content, ',').skip(counted).take(6).collect();
        let fields: Vec<&str> = fields.iter().map(Cow::as_ref).collect();
        match heading(&fields).filter(|_| row == 0) {
            Some(before) => counted = before,
            None => points.push((line, point(&fields).map_err(|problem| (Place::Line(line), problem))?)),
        }
    }
    Ok(points)
}

/// The number of columns before those of the points where these fields name columns; `None` where they do not.
fn heading(fields: &[&str]) -> Option<usize> {
    let before = usize::from(fields.first()?.is_empty());
    let (first, weights) = fields[before..].split_first()?;
    let is_named = NAMES.iter().any(|name| first.eq_ignore_ascii_case(name));
    (is_named && weights.iter().all(|name| name.parse::<f64>().is_err())).then_some(before)
}

fn point(fields: &[&str]) -> Result<LandmarkPoint, String> {
    let expected = || format!("expected `face,b0,b1,b2` or `vertex`, found \"{}\"", short(&fields.join(",")));
    let number = |word: &str| word.parse::<u32>().map_err(|_| expected());
    let weight = |word: &str| word.parse::<f64>().map_err(|_| expected());
    let point = match fields {
        [vertex] => LandmarkPoint::Vertex(number(vertex)?),
        [face, a, b, c] => {
            LandmarkPoint::OnFace { face: number(face)?, barycentric: [weight(a)?, weight(b)?, weight(c)?] }
        }
        _ => return Err(expected()),
    };
    match point {
        LandmarkPoint::OnFace { barycentric, .. } if !point.is_sound() => {
            Err(format!("the weights {barycentric:?} are negative or do not sum to 1"))
        }
        _ => Ok(point),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Result<Vec<(usize, LandmarkPoint)>, String> {
        read(text.as_bytes()).map_err(|error| error.to_string())
    }

    #[test]
    fn points_are_read_with_and_without_names_of_columns() {
        let on_face = LandmarkPoint::OnFace { face: 3, barycentric: [0.25, 0.75, 0.0] };
        let both = |lines: [usize; 2]| Ok(vec![(lines[0], LandmarkPoint::Vertex(7)), (lines[1], on_face)]);
        assert_eq!(points("7\n3,0.25,0.75,0\n"), both([1, 2]));
        assert_eq!(points("# points\nFace, b0, b1, b2\n7 # tip\n\n3, 0.25, 0.75, 0\n"), both([3, 5]));
        assert_eq!(points("vertex\r\"7\"\r\"3\",\"0.25\",\"0.75\",0\r"), both([2, 3]));
        assert_eq!(points(",target_face,b0,b1,b2\n0,7\n1,3,0.25,0.75,0\n"), both([2, 3]));
        assert_eq!(points("\"\",\"vertex\"\n\"1\",7\n"), Ok(vec![(2, LandmarkPoint::Vertex(7))]));
        assert_eq!(points(""), Ok(Vec::new()));
    }

    #[test]
    fn a_first_line_that_names_no_columns_is_no_heading() {
        let expected = |line, found| {
            Err(format!("line {line}: expected `face,b0,b1,b2` or `vertex`, found \"{found}\""))
        };
        assert_eq!(points("f12,0.2,0.3,0.5\n7\n"), expected(1, "f12,0.2,0.3,0.5"));
        assert_eq!(points("x17\n7\n"), expected(1, "x17"));
        assert_eq!(points("face,0.2,0.3,0.5\n"), expected(1, "face,0.2,0.3,0.5"));
        assert_eq!(points("7\nvertex\n"), expected(2, "vertex"));
        assert_eq!(points("-1\n"), expected(1, "-1"));
        assert_eq!(
            points("0,1,1,1\n"),
            Err("line 1: the weights [1.0, 1.0, 1.0] are negative or do not sum to 1".to_owned())
        );
    }
}

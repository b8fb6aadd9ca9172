//! Curves on a mesh, as users give them: polylines over its vertices or over points of its faces.
//!
//! OBJ: lines `l` over vertices by the numbers of the mesh's own file, which may hold its `v` lines too. Tables: `curve,vertex` or
//! `curve,face,b0,b1,b2` with or without more columns, fields in quotes or not, and before them or not a column without a name that
//! counts the rows, as R and pandas write it; lines that follow each other with one name are one curve, closed where its last point is its
//! first. JSON: `{"curves": [{"name"?, "closed"?, "points": [vertex or {"face", "barycentric"}]}]}`.

use super::landmark_file::LandmarkPoint;
use super::problem::{Place, Problem};
use super::reading::{content_lines, number, text};
use super::separated::fields;
use super::{MAX_BYTES, obj};
use serde::Deserialize;
use std::borrow::Cow;

/// A curve as a file gives it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Its name; its number, from 1, where it has none.
    pub name: String,
    /// Whether its last point is joined with its first.
    pub is_closed: bool,
    /// Its points, in the mesh file's numbers; not checked against the mesh.
    pub points: Vec<LandmarkPoint>,
}

/// First words of OBJ files in which curves are; tables have commas.
const OBJ_WORDS: [&str; 11] = ["v", "vn", "vt", "l", "f", "o", "g", "s", "mtllib", "usemtl", "p"];

/// The largest number of points; a file with more is refused.
pub const MAX_POINTS: usize = 1_000_000;

/// The error about a curve file, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct CurveFileError {
    /// The place of the fault.
    pub place: Place,
    /// The problem and its remedy.
    pub problem: String,
}

impl From<Problem> for CurveFileError {
    fn from((place, problem): Problem) -> Self {
        Self { place, problem }
    }
}

/// Reads the curves of a mesh whose file has that many vertices. Formats are recognised by content.
///
/// # Errors
/// [`CurveFileError`] with the line.
pub fn read(bytes: &[u8], vertices: usize) -> Result<Vec<Curve>, CurveFileError> {
    if bytes.len() > MAX_BYTES {
        let problem = format!("the file has {} bytes; the limit is {MAX_BYTES}", bytes.len());
        return Err(CurveFileError { place: Place::Header, problem });
    }
    let text = text(bytes)?;
    let curves = match content_lines(&text).next() {
        Some((_, line)) if line.starts_with('{') => json(&text)?,
        Some((_, line)) if is_of_obj(line) => obj(&text, vertices)?,
        _ => table(&text)?,
    };
    let curves: Vec<Curve> = curves.into_iter().map(closed_at_its_end).collect();
    if curves.is_empty() {
        let problem = "it has no curves: give OBJ lines `l`, a table `curve,vertex`, or JSON".to_owned();
        return Err(CurveFileError { place: Place::Header, problem });
    }
    Ok(curves)
}

/// Whether a file is one of curves, without reading them: JSON with `curves`, an OBJ file with a line `l`, or a table whose rows begin
/// with a curve's name. A table of nothing but numbers and other names is one of values.
pub fn is_one(bytes: &[u8]) -> bool {
    let Ok(text) = text(bytes) else { return false };
    let mut lines = content_lines(&text).map(|(_, line)| line);
    match lines.next() {
        Some(line) if line.starts_with('{') => text.contains("\"curves\""),
        Some(line) if is_of_obj(line) => obj::whole_lines(&text).any(|line| line.kind == "l"),
        Some(line) => is_row_of_curve(line) || (is_curve_heading(line) && lines.next().is_some()),
        None => false,
    }
}

/// Whether a line begins as one of an OBJ file does.
fn is_of_obj(line: &str) -> bool {
    line.split_whitespace().next().is_some_and(|word| OBJ_WORDS.contains(&word))
}

/// Whether a row has a name and numbers behind it.
fn is_row_of_curve(line: &str) -> bool {
    let mut fields = fields(line, ',').take(6);
    let is_named = fields.next().is_some_and(|name| !name.is_empty() && name.parse::<f64>().is_err());
    let mut numbers = fields.peekable();
    is_named && numbers.peek().is_some() && numbers.all(|field| field.parse::<f64>().is_ok())
}

/// Whether a line names the columns of a table of curves, as this program writes them or others.
fn is_curve_heading(line: &str) -> bool {
    let mut fields = fields(line, ',').map(|field| field.to_ascii_lowercase()).peekable();
    // A column without a name counts the rows.
    fields.next_if(String::is_empty);
    let is_point = |field: String| field.ends_with("vertex") || field.ends_with("face");
    fields.next().is_some_and(|name| name == "curve") && fields.next().is_some_and(is_point)
}

/// A curve whose last point is its first is closed, and has the point once.
fn closed_at_its_end(mut curve: Curve) -> Curve {
    if curve.points.len() > 2 && curve.points.first() == curve.points.last() {
        curve.points.pop();
        curve.is_closed = true;
    }
    curve
}

fn check_count(count: usize, line: usize) -> Result<(), Problem> {
    if count > MAX_POINTS {
        return Err((Place::Line(line), format!("there are more than {MAX_POINTS} points of curves")));
    }
    Ok(())
}

fn obj(text: &str, vertices: usize) -> Result<Vec<Curve>, Problem> {
    let (mut curves, mut count, mut own, mut group) = (Vec::new(), 0, 0_usize, None);
    for line in obj::whole_lines(text) {
        match line.kind {
            "v" => own += 1,
            "o" | "g" => group = line.words().next().map(str::to_owned),
            "l" => {
                let mut points = Vec::new();
                for word in line.words() {
                    count += 1;
                    check_count(count, line.number)?;
                    points.push(LandmarkPoint::Vertex(obj::vertex(word, own, line.number)?));
                }
                let name = group.clone().unwrap_or_else(|| (curves.len() + 1).to_string());
                curves.push(Curve { name, is_closed: false, points });
            }
            _ => {}
        }
    }
    if own != 0 && own != vertices {
        let problem = format!(
            "it has {own} vertices, but the mesh file has {vertices}: lines must run over the vertices of the mesh's own file"
        );
        return Err((Place::Header, problem));
    }
    Ok(curves)
}

fn table(text: &str) -> Result<Vec<Curve>, Problem> {
    let mut curves: Vec<Curve> = Vec::new();
    let (mut count, mut counted) = (0, 0);
    for (line, content) in content_lines(text) {
        let fields: Vec<Cow<'_, str>> = fields(content, ',').skip(counted).take(6).collect();
        let fields: Vec<&str> = fields.iter().map(Cow::as_ref).collect();
        let is_heading =
            count == 0 && fields.get(1).is_some_and(|field| field.starts_with(char::is_alphabetic));
        if is_heading {
            // A column without a name counts the rows.
            counted = usize::from(fields[0].is_empty());
            continue;
        }
        count += 1;
        check_count(count, line)?;
        let point = match fields[..] {
            [_, vertex] => LandmarkPoint::Vertex(number(Some(vertex), line, "a vertex number")?),
            [_, face, a, b, c, ..] => {
                let weight = |word| number::<f64>(Some(word), line, "a weight");
                LandmarkPoint::OnFace {
                    face: number(Some(face), line, "a face number")?,
                    barycentric: [weight(a)?, weight(b)?, weight(c)?],
                }
            }
            _ => {
                return Err((
                    Place::Line(line),
                    "expected `curve,vertex` or `curve,face,b0,b1,b2`".to_owned(),
                ));
            }
        };
        match curves.last_mut().filter(|curve| curve.name == fields[0]) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve { name: fields[0].to_owned(), is_closed: false, points: vec![point] }),
        }
    }
    Ok(curves)
}

fn json(text: &str) -> Result<Vec<Curve>, Problem> {
    #[derive(Deserialize)]
    struct File {
        curves: Vec<Given>,
    }
    #[derive(Deserialize)]
    struct Given {
        name: Option<String>,
        #[serde(default)]
        closed: bool,
        points: Vec<LandmarkPoint>,
    }
    // A point has four commas at most, within it and behind it, and names have some.
    if text.bytes().filter(|b| *b == b',').count() > 8 * MAX_POINTS {
        check_count(usize::MAX, 1)?;
    }
    let file: File = serde_json::from_str(text).map_err(|e| {
        let words = e.to_string();
        let problem = words.split(" at line ").next().unwrap_or_default().to_owned();
        (Place::Line(e.line().max(1)), problem)
    })?;
    let count = file.curves.iter().map(|curve| curve.points.len()).sum();
    check_count(count, 1)?;
    let curve = |(k, given): (usize, Given)| Curve {
        name: given.name.unwrap_or_else(|| (k + 1).to_string()),
        is_closed: given.closed,
        points: given.points,
    };
    Ok(file.curves.into_iter().enumerate().map(curve).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves(text: &str) -> Result<Vec<Curve>, String> {
        read(text.as_bytes(), 8).map_err(|e| e.to_string())
    }

    fn over(name: &str, is_closed: bool, vertices: &[u32]) -> Curve {
        let points = vertices.iter().map(|v| LandmarkPoint::Vertex(*v)).collect();
        Curve { name: name.to_owned(), is_closed, points }
    }

    #[test]
    fn every_format_is_read() {
        let vertices = "v 0 0 0\n".repeat(8);
        let belt = [over("belt", true, &[0, 1, 2]), over("2", false, &[7, 6])];
        assert_eq!(curves(&format!("{vertices}g belt\nl 1 2/2 3 1\ng\nl -1 -2\n")).unwrap(), belt);
        assert_eq!(curves("l 1 2\n").unwrap(), [over("1", false, &[0, 1])]);
        assert_eq!(curves("curve,vertex\nbelt,0\nbelt,1\nbelt,2\nbelt,0 # again\n2,7\n2,6\n").unwrap(), belt);
        let json =
            r#"{"curves": [{"name": "belt", "closed": true, "points": [0, 1, 2]}, {"points": [7, 6]}]}"#;
        assert_eq!(curves(json).unwrap(), belt);
        for table in [
            "\"curve\",\"vertex\"\n\"belt\",0\n\"belt\",1\n\"belt\",2\n\"belt\",0\n\"2\",7\n\"2\",6\n",
            "\"\",\"curve\",\"vertex\"\n\"1\",\"belt\",0\n\"2\",\"belt\",1\n\"3\",\"belt\",2\n\"4\",\"belt\",0\n\"5\",\"2\",7\n\"6\",\"2\",6\n",
            ",curve,vertex\n0,belt,0\n1,belt,1\n2,belt,2\n3,belt,0\n4,2,7\n5,2,6\n",
        ] {
            assert_eq!(curves(table).unwrap(), belt, "{table}");
        }
        assert_eq!(curves("\"left, upper\",4\n").unwrap(), [over("left, upper", false, &[4])]);
        let on_face = LandmarkPoint::OnFace { face: 3, barycentric: [0.5, 0.5, 0.0] };
        let mixed = curves("a,3,0.5,0.5,0,1,2,3\na,4\n").unwrap();
        assert_eq!(mixed[0].points, [on_face, LandmarkPoint::Vertex(4)]);
    }

    #[test]
    fn lines_are_those_of_every_obj_file() {
        let vertices = "v 0 0 \\\r 0\r".repeat(8);
        let found = curves(&format!("{vertices}g belt\rl 1 2 \\\r3 1 # 4\rg C:\\\rl -1 \\\r\r")).unwrap();
        assert_eq!(found, [over("belt", true, &[0, 1, 2]), over("C:\\", false, &[7])]);
        assert_eq!(curves("\u{feff}a,1\ra,2\r").unwrap(), [over("a", false, &[1, 2])]);
        assert_eq!(curves("a,1\ra,x\r"), Err("line 2: \"x\" should be a vertex number".to_owned()));
        assert_eq!(curves("l 1 2\rl \\\r1 0\r"), Err("line 2: there is no vertex 0".to_owned()));
    }

    #[test]
    fn files_of_curves_are_told_from_others() {
        let curves = [
            "{\"curves\": []}",
            "v 0 0 0\nv 1 0 0\nl 1 2\n",
            "curve,vertex\n1,0\n",
            "Curve,target_face,b0,b1,b2,x,y,z\n1,0,1,0,0,0,0,0\n",
            "belt,0\nbelt,1\n",
            "a,3,0.5,0.5,0,1,2,3\n",
            "\"\",\"curve\",\"vertex\"\n\"1\",\"1\",0\n",
            "\"left, upper\",4\n",
        ];
        assert!(curves.iter().all(|text| is_one(text.as_bytes())));
        let others = [
            "",
            "{\"pairs\": []}",
            "v 0 0 0\nf 1 1 1\n",
            "vertex,heat\n0,1\n",
            "heat\n1\n",
            "0,1\n1,2\n",
            "curve,vertex\n",
        ];
        assert!(!others.iter().any(|text| is_one(text.as_bytes())));
        assert!(!is_one(&[0xff, 0xfe, 0, 1]));
    }

    #[test]
    fn very_many_points_are_refused_before_they_are_read() {
        let many = format!("{{\"curves\": [{{\"points\": [{}x", "0,".repeat(8 * MAX_POINTS + 1));
        assert_eq!(curves(&many), Err(format!("line 1: there are more than {MAX_POINTS} points of curves")));
    }

    #[test]
    fn faults_are_told_with_their_line() {
        let cases = [
            ("", "header: it has no curves: give OBJ lines `l`, a table `curve,vertex`, or JSON"),
            (
                "v 0 0 0\nl 1 1\n",
                "header: it has 1 vertices, but the mesh file has 8: lines must run over the vertices of the mesh's own file",
            ),
            ("l 1 x\n", "line 1: \"x\" should be a vertex number"),
            ("l 1 0\n", "line 1: there is no vertex 0"),
            ("l 1 -9223372036854775808\n", "line 1: there is no vertex -9223372036854775808"),
            ("a,1\na,2,3\n", "line 2: expected `curve,vertex` or `curve,face,b0,b1,b2`"),
            ("a,1\na,-2\n", "line 2: \"-2\" should be a vertex number"),
            ("{\n\"curves\": 3}", "line 2: invalid type: integer `3`, expected a sequence"),
        ];
        for (text, sentence) in cases {
            assert_eq!(curves(text), Err(sentence.to_owned()), "{text}");
        }
    }
}

//! Matrices of NTSYSpc and of geomorph (`.nts`, `.dta`): comments in lines that begin with `"` or `'`, a line of parameters, the
//! labels, then numbers that may be broken into lines anywhere.
//!
//! The parameters are `1 rows columns missing DIM=3`. `rows` counts specimens and `columns` their coordinates; or, where there
//! are three columns, `rows` counts the points of one specimen. An `L` behind a number says that a list of labels precedes the
//! matrix, a `B` or `E` that one begins or ends each row. `missing` is 0, or 1 and then the number that stands for what is not known.

use super::content::{Mark, MarkList, Spot, SurfaceMarks};
use super::text::{check_count, coordinate, coordinates, lines, one_word};
use crate::io::problem::{Place, Problem};
use crate::io::reading::number;
use glam::DVec3;

/// The place of the labels of rows or columns.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Labels {
    None,
    Listed,
    RowBegins,
    RowEnds,
}

/// The line of parameters.
struct Parameters {
    rows: usize,
    columns: usize,
    row_labels: Labels,
    has_column_labels: bool,
    /// The number that stands for an unknown coordinate.
    missing: Option<f64>,
}

/// The line of parameters, which is the first that is no comment.
fn is_comment(line: &str) -> bool {
    line.trim().is_empty() || line.trim_start().starts_with(['"', '\''])
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let lines = lines(bytes)?;
    let last = lines.len().max(1);
    let mut lines = lines.into_iter().filter(|(_, line)| !is_comment(line));
    let (line, header) =
        lines.next().ok_or_else(|| (Place::Line(last), "the line of parameters is missing".to_owned()))?;
    let parameters = parameters(header, line, bytes.len())?;
    let mut words = Words { words: lines.flat_map(|(n, l)| l.split_whitespace().map(move |w| (n, w))), last };
    let rows = parameters.rows;
    let mut labels = match parameters.row_labels {
        Labels::Listed => (0..rows).map(|_| words.label()).collect::<Result<_, _>>()?,
        _ => vec![String::new(); rows],
    };
    if parameters.has_column_labels {
        (0..parameters.columns).try_for_each(|_| words.label().map(drop))?;
    }
    let mut points = Vec::with_capacity(rows * parameters.columns / 3);
    for label in &mut labels {
        if parameters.row_labels == Labels::RowBegins {
            *label = words.label()?;
        }
        for _ in 0..parameters.columns / 3 {
            points.push(words.point(parameters.missing)?);
        }
        if parameters.row_labels == Labels::RowEnds {
            *label = words.label()?;
        }
    }
    if let Some((line, _)) = words.words.next() {
        return Err((Place::Line(line), "the file goes on after its matrix".into()));
    }
    Ok(lists(&parameters, labels, points))
}

/// One list for each specimen.
fn lists(parameters: &Parameters, labels: Vec<String>, points: Vec<Option<DVec3>>) -> Vec<MarkList> {
    let mark = |label: String, place: &Option<DVec3>| Mark { label, spot: place.map(Spot::InSpace) };
    if parameters.columns == 3 {
        let marks = labels.into_iter().zip(&points).map(|(label, place)| mark(label, place)).collect();
        return vec![MarkList { marks, ..MarkList::default() }];
    }
    let specimens = points.chunks(parameters.columns / 3);
    let list = |(name, points): (String, &[Option<DVec3>])| {
        let marks = points.iter().map(|place| mark(String::new(), place)).collect();
        MarkList { name, marks, ..MarkList::default() }
    };
    labels.into_iter().zip(specimens).map(list).collect()
}

fn parameters(header: &str, line: usize, bytes: usize) -> Result<Parameters, Problem> {
    let wrong = |problem: &str| (Place::Line(line), problem.to_owned());
    let upper = header.to_ascii_uppercase().replace("DIM =", "DIM=").replace("DIM= ", "DIM=");
    let words: Vec<_> = upper.split_whitespace().filter(|word| !word.starts_with("DIM=")).collect();
    if words.first() != Some(&"1") {
        return Err(wrong("the parameters do not begin with 1, for a rectangular matrix"));
    }
    if !upper.contains("DIM=3") {
        return Err(wrong("the points are not said to have three coordinates (DIM=3)"));
    }
    let size = |k: usize, what: &str| {
        let word = words.get(k).copied();
        let digits = word.map(|word| word.trim_end_matches(['L', 'B', 'E']));
        number::<usize>(digits, line, what)
    };
    let labels = |k: usize| match words.get(k).and_then(|word| word.chars().last()) {
        Some('L') => Labels::Listed,
        Some('B') => Labels::RowBegins,
        Some('E') => Labels::RowEnds,
        _ => Labels::None,
    };
    let (rows, columns) = (size(1, "a number of rows")?, size(2, "a number of columns")?);
    let cells = rows.saturating_mul(columns);
    if columns == 0 || columns % 3 != 0 {
        return Err(wrong("the number of columns is no multiple of 3, for three coordinates a point"));
    }
    check_count(cells / 3, line)?;
    // A number takes at least a digit and what separates it.
    if cells > bytes / 2 + 1 {
        return Err((
            Place::Line(line),
            format!("it announces {cells} numbers, more than the file can hold"),
        ));
    }
    let missing = match words.get(3) {
        None | Some(&"0") => None,
        Some(_) => words.get(4).map(|word| coordinate(Some(word), line)).transpose()?,
    };
    Ok(Parameters {
        rows,
        columns,
        row_labels: labels(1),
        has_column_labels: labels(2) == Labels::Listed,
        missing,
    })
}

/// The words behind the parameters with their lines.
struct Words<'a, I: Iterator<Item = (usize, &'a str)>> {
    words: I,
    /// The last line of the file.
    last: usize,
}

impl<'a, I: Iterator<Item = (usize, &'a str)>> Words<'a, I> {
    fn next(&mut self) -> Result<(usize, &'a str), Problem> {
        let last = self.last;
        self.words
            .next()
            .ok_or_else(|| (Place::Line(last), "the file ends before its matrix: it may be cut off".into()))
    }

    fn label(&mut self) -> Result<String, Problem> {
        Ok(self.next()?.1.to_owned())
    }

    /// A point; `None` where one of its coordinates is not known.
    fn point(&mut self, missing: Option<f64>) -> Result<Option<DVec3>, Problem> {
        let mut p = [Some(0.0); 3];
        for x in &mut p {
            let (line, word) = self.next()?;
            *x = if word.eq_ignore_ascii_case("na") { None } else { Some(coordinate(Some(word), line)?) };
        }
        let known = p.map(|x| x.filter(|x| Some(*x) != missing));
        Ok(match known {
            [Some(x), Some(y), Some(z)] => Some(DVec3::new(x, y, z)),
            _ => None,
        })
    }
}

/// One row per specimen; a line per point.
pub(super) fn write(sides: &[SurfaceMarks]) -> Vec<u8> {
    let count = sides.iter().map(|side| side.marks.len()).max().unwrap_or(0);
    let name = |(number, side): (usize, &SurfaceMarks)| {
        let word = one_word(&side.name);
        if word.is_empty() { format!("specimen_{}", number + 1) } else { word }
    };
    let names: Vec<_> = sides.iter().enumerate().map(name).collect();
    let mut text = format!("1 {}L {} 0 DIM=3\n{}\n", sides.len(), 3 * count, names.join(" "));
    for side in sides {
        for mark in &side.marks {
            text += &format!("{}\n", coordinates(mark.position, " "));
        }
    }
    text.into_bytes()
}

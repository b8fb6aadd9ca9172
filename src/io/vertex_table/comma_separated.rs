//! Tables of values by vertex: a line for each vertex, its fields apart by commas, in quotes or not. A first line may name the columns;
//! where it calls the first one `vertex`, `source_vertex` or `target_vertex`, that column has the vertex numbers and lines may come in any
//! order. A first column without a name, as R and pandas write it, counts the rows, from 0 or 1. What follows `#` is left out. A vertex that no
//! face uses needs no values.

use super::content::{AnnouncedColumn, Column, Heading, Rows, VertexTable};
use super::number_type::NumberType;
use crate::io::problem::{Place, Problem};
use crate::io::reading::{content_lines, in_few_digits, is_usable, number, text};
use crate::io::separated::fields;
use std::borrow::Cow;

/// The length of the longest line in bytes.
const MAX_LINE: usize = 1 << 20;

/// The largest number of values in all, whether a line of the table gives them or not.
const MAX_VALUES: usize = 1 << 27;

/// Names of a column of vertex numbers.
const NUMBERS: [&str; 3] = ["vertex", "source_vertex", "target_vertex"];

pub(super) fn read(bytes: &[u8], vertices: usize) -> Result<VertexTable, Problem> {
    let text = text(bytes)?;
    let mut lines = content_lines(&text).peekable();
    let Some(&(first, line)) = lines.peek() else {
        return Err((Place::Line(1), "the table is empty".to_owned()));
    };
    check_length(first, line)?;
    let Header { names, rows, counts } = Header::of(first, line)?;
    if !matches!(rows, Rows::InOrder { heading: Heading::Missing }) {
        lines.next();
    }
    if names.len().saturating_mul(vertices) > MAX_VALUES {
        let problem =
            format!("{} columns for {vertices} vertices are more than {MAX_VALUES} values", names.len());
        return Err((Place::Line(first), problem));
    }
    let mut filling = Filling::new(names, counts, vertices);
    for (row, (line, content)) in lines.enumerate() {
        check_length(line, content)?;
        filling.line(line, row, content, &rows)?;
    }
    filling.finish(rows)
}

/// What the first line of a table says.
struct Header {
    /// The names of the columns of values.
    names: Vec<String>,
    /// The way in which rows tell their vertex.
    rows: Rows,
    /// Whether a column before them counts the rows.
    counts: bool,
}

impl Header {
    fn of(number: usize, line: &str) -> Result<Self, Problem> {
        let mut names: Vec<String> = fields(line, ',').map(Cow::into_owned).collect();
        let is_named = names.iter().any(|name| name.parse::<f64>().is_err() && !name.is_empty());
        if !is_named {
            let names = (1..=names.len()).map(|k| k.to_string()).collect();
            return Ok(Self { names, rows: Rows::InOrder { heading: Heading::Missing }, counts: false });
        }
        let counts = names[0].is_empty();
        if counts {
            names.remove(0);
        }
        check_names(number, &names, usize::from(counts))?;
        let is_numbered = !counts && NUMBERS.contains(&names[0].as_str());
        let rows = if is_numbered {
            Rows::Numbered(names.remove(0))
        } else {
            Rows::InOrder { heading: Heading::Named }
        };
        Ok(Self { names, rows, counts })
    }
}

/// The columns of values that the first line of a table announces, and whether the line is one of a table at all: it has commas, or
/// nothing but a number, or a number below it.
pub(super) fn announced(bytes: &[u8]) -> Result<Option<Vec<AnnouncedColumn>>, Problem> {
    let text = text(bytes)?;
    let mut lines = content_lines(&text);
    let Some((first, line)) = lines.next() else { return Ok(None) };
    check_length(first, line)?;
    let is_number = |line: &str| line.trim().parse::<f64>().is_ok();
    let is_table =
        line.contains(',') || is_number(line) || lines.next().is_some_and(|(_, line)| is_number(line));
    if !is_table {
        return Ok(None);
    }
    let column = |name| AnnouncedColumn { name, number_type: NumberType::Double };
    Ok(Some(Header::of(first, line)?.names.into_iter().map(column).collect()))
}

fn check_length(line: usize, content: &str) -> Result<(), Problem> {
    if content.len() > MAX_LINE {
        let problem = format!("it has {} bytes, more than the {MAX_LINE} of a line", content.len());
        return Err((Place::Line(line), problem));
    }
    Ok(())
}

/// Refuses columns without a name, and two of one name; `before` columns stand before them.
fn check_names(line: usize, names: &[String], before: usize) -> Result<(), Problem> {
    if let Some(k) = names.iter().position(String::is_empty) {
        return Err((Place::Line(line), format!("column {} has no name", before + k + 1)));
    }
    let mut sorted: Vec<&String> = names.iter().collect();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err((Place::Line(line), format!("two columns are called \"{}\"", pair[0]))),
        None => Ok(()),
    }
}

/// Columns that are being read.
struct Filling {
    columns: Vec<Column>,
    /// The line of each vertex, 0 for none so far.
    line_of: Vec<usize>,
    /// Number of rows so far.
    rows: usize,
    /// The number of the first row in a column that counts the rows; `None` where there is no such column.
    first_count: Option<usize>,
}

impl Filling {
    /// Memory is taken as rows come, not as the mesh is large.
    fn new(names: Vec<String>, counts: bool, vertices: usize) -> Self {
        let column = |name| Column { name, number_type: NumberType::Double, values: Vec::new() };
        let columns = names.into_iter().map(column).collect();
        Self { columns, line_of: vec![0; vertices], rows: 0, first_count: counts.then_some(0) }
    }

    /// Checks the field of a column that counts the rows from `first`, or from 1 where the first row says so.
    fn check_count(&mut self, first: usize, line: usize, row: usize, field: &str) -> Result<(), Problem> {
        let given = field.parse::<usize>().ok();
        let first = if row == 0 && given == Some(1) { 1 } else { first };
        if given != Some(first + row) {
            let problem = "the first column has no name and does not count the rows: call it `vertex` where it has the numbers of vertices";
            return Err((Place::Line(line), problem.to_owned()));
        }
        self.first_count = Some(first);
        Ok(())
    }

    fn line(&mut self, line: usize, row: usize, content: &str, rows: &Rows) -> Result<(), Problem> {
        let mut fields = fields(content, ',');
        if let Some(first) = self.first_count {
            self.check_count(first, line, row, &fields.next().unwrap_or_default())?;
        }
        let vertex = match rows {
            Rows::InOrder { .. } => row,
            Rows::Numbered(_) => number(fields.next().as_deref(), line, "a vertex number")?,
        };
        let Some(earlier) = self.line_of.get_mut(vertex) else {
            let vertices = self.line_of.len();
            let problem = format!("there is no vertex {vertex}: the mesh file has {vertices} vertices");
            return Err((Place::Line(line), problem));
        };
        if *earlier != 0 {
            return Err((Place::Line(line), format!("vertex {vertex} is already in line {earlier}")));
        }
        *earlier = line;
        self.rows += 1;
        for column in &mut self.columns {
            let what = || format!("a number of \"{}\"", column.name);
            let field = fields.next();
            let value = match field.as_deref() {
                Some("") => None,
                field => Some(number::<f64>(field, line, &what())?),
            };
            if let Some(value) = value.filter(|value| !is_usable(*value)) {
                return Err((
                    Place::Line(line),
                    format!("{} is no usable value of \"{}\"", in_few_digits(value), column.name),
                ));
            }
            if column.values.len() <= vertex {
                column.values.resize(vertex + 1, None);
            }
            column.values[vertex] = value;
        }
        match fields.next() {
            Some(_) => Err((Place::Line(line), format!("it has more than {} values", self.columns.len()))),
            None => Ok(()),
        }
    }

    fn finish(mut self, rows: Rows) -> Result<VertexTable, Problem> {
        let vertices = self.line_of.len();
        if matches!(rows, Rows::InOrder { .. }) && self.rows != vertices {
            let problem = format!(
                "it has {} rows, but the mesh file has {vertices} vertices: give each a row, or a first column `vertex`",
                self.rows
            );
            return Err((Place::Header, problem));
        }
        self.columns.iter_mut().for_each(|column| column.values.resize(vertices, None));
        Ok(VertexTable { rows, columns: self.columns, left_out: Vec::new() })
    }
}

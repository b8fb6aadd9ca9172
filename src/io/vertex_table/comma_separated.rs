//! Tables of values by vertex: a line for each vertex, its fields apart by commas. A first line may name the columns; where it
//! calls the first one `vertex`, `source_vertex` or `target_vertex`, that column has the vertex numbers and lines may come in any
//! order. What follows `#` is left out. A vertex that no face uses needs no values.

use super::content::{AnnouncedColumn, Column, Heading, Rows, VertexTable};
use super::number_type::NumberType;
use crate::io::problem::{Place, Problem};
use crate::io::reading::{content_lines, number, text};

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
    let (names, rows) = heading(first, line)?;
    if !matches!(rows, Rows::InOrder { heading: Heading::Missing }) {
        lines.next();
    }
    if names.len().saturating_mul(vertices) > MAX_VALUES {
        let problem =
            format!("{} columns for {vertices} vertices are more than {MAX_VALUES} values", names.len());
        return Err((Place::Line(first), problem));
    }
    let mut filling = Filling::new(names, vertices);
    for (row, (line, content)) in lines.enumerate() {
        check_length(line, content)?;
        filling.line(line, row, content, &rows)?;
    }
    filling.finish(rows)
}

/// The names of the columns of values of a table that begins with this line, and how its rows tell their vertex.
fn heading(number: usize, line: &str) -> Result<(Vec<String>, Rows), Problem> {
    let mut names: Vec<String> = line.split(',').map(|name| name.trim().to_owned()).collect();
    let is_named = names.iter().any(|name| name.parse::<f64>().is_err() && !name.is_empty());
    if !is_named {
        let numbered = (1..=names.len()).map(|k| k.to_string()).collect();
        return Ok((numbered, Rows::InOrder { heading: Heading::Missing }));
    }
    check_names(number, &names)?;
    if NUMBERS.contains(&names[0].as_str()) {
        let rows = Rows::Numbered(names.remove(0));
        return Ok((names, rows));
    }
    Ok((names, Rows::InOrder { heading: Heading::Named }))
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
    Ok(Some(heading(first, line)?.0.into_iter().map(column).collect()))
}

fn check_length(line: usize, content: &str) -> Result<(), Problem> {
    if content.len() > MAX_LINE {
        let problem = format!("it has {} bytes, more than the {MAX_LINE} of a line", content.len());
        return Err((Place::Line(line), problem));
    }
    Ok(())
}

fn check_names(line: usize, names: &[String]) -> Result<(), Problem> {
    if let Some(k) = names.iter().position(String::is_empty) {
        return Err((Place::Line(line), format!("column {} has no name", k + 1)));
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
}

impl Filling {
    /// Memory is taken as rows come, not as the mesh is large.
    fn new(names: Vec<String>, vertices: usize) -> Self {
        let column = |name| Column { name, number_type: NumberType::Double, values: Vec::new() };
        Self { columns: names.into_iter().map(column).collect(), line_of: vec![0; vertices], rows: 0 }
    }

    fn line(&mut self, line: usize, row: usize, content: &str, rows: &Rows) -> Result<(), Problem> {
        let mut fields = content.split(',').map(str::trim);
        let vertex = match rows {
            Rows::InOrder { .. } => row,
            Rows::Numbered(_) => number(fields.next(), line, "a vertex number")?,
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
            let value = match field {
                Some("") => None,
                _ => Some(number::<f64>(field, line, &what())?),
            };
            if let Some(value) = value.filter(|value| !value.is_finite()) {
                return Err((
                    Place::Line(line),
                    format!("{value} is no usable value of \"{}\"", column.name),
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

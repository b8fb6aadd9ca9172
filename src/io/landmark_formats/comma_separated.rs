//! Tables with a header line (`.csv`), whose columns are separated by commas, semicolons or tabs. With the columns `x`, `y`, `z` they hold the
//! landmarks of one mesh; with `sx`, `sy`, `sz`, `tx`, `ty`, `tz` those of source and target. The names are in `name` or `label`.
//! `l`, `p`, `s` and `r`, `a`, `s` are the coordinates in tables of 3D Slicer.

use super::content::{Mark, MarkList, Space, Spot, SurfaceMarks};
use super::text::{check_count, coordinates, lines, position};
use crate::io::problem::{Place, Problem};
use crate::io::separated::{field, fields};
use std::borrow::Cow;

/// The columns of a table.
pub(super) struct Columns {
    separator: char,
    label: Option<usize>,
    /// The columns of the coordinates: of one mesh, or of source and target.
    sides: Vec<[usize; 3]>,
    space: Option<Space>,
}

/// The columns that a header line names; `None` for a line that is no such header.
pub(super) fn columns(header: &str) -> Option<Columns> {
    let separator = [',', ';', '\t'].into_iter().find(|sign| header.contains(*sign))?;
    let header = header.to_ascii_lowercase();
    let names: Vec<Cow<'_, str>> = fields(&header, separator).collect();
    let column = |name: &str| names.iter().position(|n| n == name);
    let triple = |[x, y, z]: [&str; 3]| Some([column(x)?, column(y)?, column(z)?]);
    let source = triple(["sx", "sy", "sz"]).or_else(|| triple(["source_x", "source_y", "source_z"]));
    let target = triple(["tx", "ty", "tz"]).or_else(|| triple(["target_x", "target_y", "target_z"]));
    let (sides, space) = if let (Some(source), Some(target)) = (source, target) {
        (vec![source, target], None)
    } else if let Some(side) = triple(["x", "y", "z"]) {
        (vec![side], None)
    } else if let Some(side) = triple(["l", "p", "s"]) {
        (vec![side], Some(Space::Lps))
    } else {
        (vec![triple(["r", "a", "s"])?], Some(Space::Ras))
    };
    let label = ["name", "label", "landmark", "id"].into_iter().find_map(column);
    Some(Columns { separator, label, sides, space })
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let mut lines = lines(bytes)?.into_iter().filter(|(_, line)| {
        let line = line.trim_start();
        !line.is_empty() && !line.starts_with('#')
    });
    let no_header = |line| {
        let problem = "the header should name the columns x, y, z or sx, sy, sz, tx, ty, tz, and name";
        (Place::Line(line), problem.to_owned())
    };
    let (number, header) = lines.next().ok_or_else(|| no_header(1))?;
    let columns = columns(header).ok_or_else(|| no_header(number))?;
    let empty = MarkList { space: columns.space, ..MarkList::default() };
    let mut lists = vec![empty; columns.sides.len()];
    for (number, line) in lines {
        let fields: Vec<Cow<'_, str>> = fields(line, columns.separator).collect();
        let text = |column: usize| fields.get(column).map(Cow::as_ref);
        let label = columns.label.and_then(text).unwrap_or_default();
        for (list, side) in lists.iter_mut().zip(&columns.sides) {
            let spot = position(side.map(text), number)?.map(Spot::InSpace);
            list.marks.push(Mark { label: label.to_owned(), spot });
            check_count(list.marks.len(), number)?;
        }
    }
    Ok(lists)
}

pub(super) fn write(sides: &[SurfaceMarks]) -> Vec<u8> {
    let header = if sides.len() == 2 { "name,sx,sy,sz,tx,ty,tz" } else { "name,x,y,z" };
    let mut text = format!("{header}\n");
    for row in 0..sides.iter().map(|side| side.marks.len()).min().unwrap_or(0) {
        let marks = sides.iter().map(|side| &side.marks[row]);
        let label = sides[0].marks[row].label.as_str();
        let numbers: Vec<_> = marks.map(|mark| coordinates(mark.position, ",")).collect();
        text += &format!("{},{}\n", field(label), numbers.join(","));
    }
    text.into_bytes()
}

//! 3D Slicer's lists of fiducial points (`.fcsv`): comments that name the coordinate system and the columns, then one line per
//! point.

use super::content::{Mark, MarkList, Space, Spot, SurfaceMarks};
use super::text::{check_count, coordinates, lines, position};
use crate::io::problem::{Place, Problem};
use crate::io::separated::{field, fields};
use std::borrow::Cow;

/// The columns of a file without a comment that names them.
const COLUMNS: &str = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";

/// The columns that matter.
struct Columns {
    coordinates: [usize; 3],
    /// The column with the name of the point.
    label: Option<usize>,
}

impl Columns {
    /// The columns of a list of names apart by commas; `None` where the coordinates are not among them.
    fn named(list: &str) -> Option<Self> {
        let list = list.to_ascii_lowercase();
        let names: Vec<Cow<'_, str>> = fields(&list, ',').collect();
        let column = |name: &str| names.iter().position(|n| n == name);
        Some(Self {
            coordinates: [column("x")?, column("y")?, column("z")?],
            label: column("label").or_else(|| column("id")),
        })
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    // Files without a named system are older than those that name it, and RAS was all there was.
    let mut list = MarkList { space: Some(Space::Ras), ..MarkList::default() };
    let no_columns = |line| (Place::Line(line), "the columns x, y and z are missing".to_owned());
    let mut columns = Columns::named(COLUMNS).ok_or_else(|| no_columns(1))?;
    for (number, line) in lines(bytes)? {
        if let Some(comment) = line.trim_start().strip_prefix('#') {
            match comment.split_once('=').map(|(name, value)| (name.trim(), value.trim())) {
                Some(("CoordinateSystem", system)) => list.space = Some(space(system, number)?),
                Some(("columns", names)) => {
                    columns = Columns::named(names).ok_or_else(|| no_columns(number))?;
                }
                _ => {}
            }
        } else if !line.trim().is_empty() {
            let fields: Vec<Cow<'_, str>> = fields(line, ',').collect();
            let text = |column: usize| fields.get(column).map(Cow::as_ref);
            let spot = position(columns.coordinates.map(text), number)?.map(Spot::InSpace);
            let label = columns.label.and_then(text).unwrap_or_default().to_owned();
            list.marks.push(Mark { label, spot });
            check_count(list.marks.len(), number)?;
        }
    }
    Ok(vec![list])
}

/// The coordinate system of a header: a name, or the number that older files have.
fn space(word: &str, line: usize) -> Result<Space, Problem> {
    match word.to_ascii_uppercase().as_str() {
        "LPS" | "1" => Ok(Space::Lps),
        "RAS" | "0" => Ok(Space::Ras),
        _ => {
            let short: String = word.chars().take(20).collect();
            Err((Place::Line(line), format!("the coordinate system \"{short}\" should be LPS or RAS")))
        }
    }
}

pub(super) fn write(side: &SurfaceMarks) -> Vec<u8> {
    let mut text = format!(
        "# Markups fiducial file version = 4.11\n# CoordinateSystem = {}\n# columns = {COLUMNS}\n",
        side.space.name()
    );
    for (number, mark) in side.marks.iter().enumerate() {
        let position = coordinates(mark.position, ",");
        text += &format!("{number},{position},0,0,0,1,1,1,0,{},,\n", field(&mark.label));
    }
    text.into_bytes()
}

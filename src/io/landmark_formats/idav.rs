//! Points of the IDAV Landmark Editor (`.pts`): `Version 1.0`, their number, and a line `name x y z` each. A point at
//! (9999, 9999, 9999) was not placed.

use super::content::{Mark, MarkList, Spot, SurfaceMarks};
use super::text::{coordinates, lines, one_word, point_count, position};
use crate::io::problem::{Place, Problem};
use glam::DVec3;

/// The place at which points lie that were not placed.
const MISSING: DVec3 = DVec3::splat(9999.0);

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let lines = lines(bytes)?;
    let last = lines.len();
    let mut lines = lines.into_iter().filter(|(_, line)| !line.trim().is_empty()).skip(1);
    let (number, line) = lines.next().ok_or_else(|| {
        (Place::Line(last), "the number of points is missing: the file may be cut off".to_owned())
    })?;
    let count = point_count(Some(line.trim()), number, bytes.len())?;
    let mut marks = Vec::with_capacity(count);
    for point in 0..count {
        let (number, line) = lines.next().ok_or_else(|| {
            (
                Place::Line(last),
                format!("the file ends before point {} of {count}: it may be cut off", point + 1),
            )
        })?;
        marks.push(mark(line, number)?);
    }
    if let Some((number, _)) = lines.next() {
        return Err((Place::Line(number), format!("the file goes on after its {count} points")));
    }
    Ok(vec![MarkList { marks, ..MarkList::default() }])
}

/// The last three words are the coordinates, what stands before them the name.
fn mark(line: &str, number: usize) -> Result<Mark, Problem> {
    let mut words: Vec<_> = line.split_whitespace().collect();
    let start = words.len().saturating_sub(3);
    let numbers = words.split_off(start);
    let place = position([0, 1, 2].map(|k| numbers.get(k).copied()), number)?;
    let spot = place.filter(|p| *p != MISSING).map(Spot::InSpace);
    Ok(Mark { label: words.join(" "), spot })
}

pub(super) fn write(side: &SurfaceMarks) -> Vec<u8> {
    let mut text = format!("Version 1.0\n{}\n", side.marks.len());
    for (number, mark) in side.marks.iter().enumerate() {
        let label = one_word(&mark.label);
        // As the Landmark Editor names points.
        let name = if label.is_empty() { format!("S{number:03}") } else { label };
        text += &format!("{name} {}\n", coordinates(mark.position, " "));
    }
    text.into_bytes()
}

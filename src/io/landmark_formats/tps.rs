//! Specimens of the tps programs and of geomorph (`.tps`): blocks that begin with `LM3=` and the number of points, then a line
//! `x y z` each, then `ID=` and other properties. Where there is a `SCALE=` the coordinates are multiplied by it. Curves and
//! outlines are no landmarks and are passed over.

use super::content::{Mark, MarkList, Spot, SurfaceMarks};
use super::text::{check_count, coordinate, coordinates, lines, point_count, position, usable};
use crate::io::problem::{Place, Problem};
use crate::io::separated::one_line;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let mut lists: Vec<MarkList> = Vec::new();
    let lines = lines(bytes)?;
    let last = lines.len();
    let mut lines = lines.into_iter().filter(|(_, line)| !line.trim().is_empty());
    let mut total = 0;
    while let Some((number, line)) = lines.next() {
        let Some((key, value)) = line.split_once('=') else {
            // Points of curves and outlines are passed over; before the first block nothing is.
            if lists.is_empty() {
                return Err((Place::Line(number), "the first block does not begin with LM3=".into()));
            }
            continue;
        };
        match (key.trim().to_ascii_uppercase().as_str(), lists.last_mut()) {
            ("LM3", _) => {
                let count = point_count(Some(value.trim()), number, bytes.len())?;
                total += count;
                check_count(total, number)?;
                let mut list = MarkList::default();
                for point in 0..count {
                    let (number, line) = lines.next().ok_or_else(|| {
                        let problem =
                            format!("the file ends before point {} of {count}: it may be cut off", point + 1);
                        (Place::Line(last), problem)
                    })?;
                    list.marks.push(mark(line, number)?);
                }
                lists.push(list);
            }
            ("LM", _) => {
                let problem = "its points have two coordinates (LM=): three are needed (LM3=)";
                return Err((Place::Line(number), problem.into()));
            }
            ("ID", Some(list)) => list.name = value.trim().to_owned(),
            ("IMAGE", Some(list)) if list.name.is_empty() => list.name = value.trim().to_owned(),
            ("SCALE", Some(list)) => scale(list, coordinate(Some(value.trim()), number)?, number)?,
            _ => {}
        }
    }
    Ok(lists)
}

fn mark(line: &str, number: usize) -> Result<Mark, Problem> {
    let mut words = line.split_whitespace();
    let place = position([(); 3].map(|()| words.next()), number)?;
    Ok(Mark { label: String::new(), spot: place.map(Spot::InSpace) })
}

fn scale(list: &mut MarkList, factor: f64, line: usize) -> Result<(), Problem> {
    for mark in &mut list.marks {
        if let Some(Spot::InSpace(p)) = &mut mark.spot {
            *p *= factor;
            if p.to_array().iter().any(|x| usable(*x).is_none()) {
                return Err((Place::Line(line), "with this scale the coordinates are too large".into()));
            }
        }
    }
    Ok(())
}

pub(super) fn write(sides: &[SurfaceMarks]) -> Vec<u8> {
    let mut text = String::new();
    for side in sides {
        text += &format!("LM3={}\n", side.marks.len());
        for mark in &side.marks {
            text += &format!("{}\n", coordinates(mark.position, " "));
        }
        text += &format!("ID={}\n", one_line(&side.name));
    }
    text.into_bytes()
}

//! MeshLab's picked points (`.pp`): XML with one element `point` each. Points that are not active were not placed.

use super::content::{Mark, MarkList, Spot, SurfaceMarks};
use super::text::{check_count, position};
use crate::io::problem::{Place, Problem};
use crate::io::reading;
use crate::io::separated::one_line;
use quick_xml::Reader;
use quick_xml::escape::escape;
use quick_xml::events::{BytesStart, Event};

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let text = &*reading::text(bytes)?;
    let mut reader = Reader::from_str(text);
    reader.config_mut().check_end_names = true;
    let mut list = MarkList::default();
    let mut lines = LineCounter { text: text.as_bytes(), at: 0, line: 1 };
    let mut depth = 0_usize;
    loop {
        let event = reader.read_event();
        let line = lines.at(reader.buffer_position() as usize);
        match event.map_err(|e| broken(&e, line))? {
            Event::Start(element) => {
                depth += 1;
                add(&element, line, &mut list)?;
            }
            Event::Empty(element) => add(&element, line, &mut list)?,
            Event::End(_) => depth = depth.saturating_sub(1),
            Event::Eof if depth > 0 => {
                return Err((
                    Place::Line(line),
                    "the file ends before its last element: it may be cut off".into(),
                ));
            }
            Event::Eof => return Ok(vec![list]),
            _ => {}
        }
    }
}

/// Adds an element that is a point.
fn add(element: &BytesStart<'_>, line: usize, list: &mut MarkList) -> Result<(), Problem> {
    if element.name().as_ref() == b"DataFileName" {
        list.name = attribute(element, "name", line)?.unwrap_or_default();
    }
    if element.name().as_ref() != b"point" {
        return Ok(());
    }
    let numbers = ["x", "y", "z"].map(|name| attribute(element, name, line));
    let [x, y, z] = numbers;
    let numbers = [x?, y?, z?];
    let is_active = attribute(element, "active", line)?.is_none_or(|active| active != "0");
    let place = if is_active { position(numbers.each_ref().map(Option::as_deref), line)? } else { None };
    let label = attribute(element, "name", line)?.unwrap_or_default();
    list.marks.push(Mark { label, spot: place.map(Spot::InSpace) });
    check_count(list.marks.len(), line)
}

fn attribute(element: &BytesStart<'_>, name: &str, line: usize) -> Result<Option<String>, Problem> {
    let Some(attribute) = element.try_get_attribute(name).map_err(|e| broken(&e, line))? else {
        return Ok(None);
    };
    let raw = std::str::from_utf8(&attribute.value).map_err(|e| broken(&e, line))?;
    let value = quick_xml::escape::unescape(raw).map_err(|e| broken(&e, line))?;
    Ok(Some(value.into_owned()))
}

fn broken(e: &impl std::fmt::Display, line: usize) -> Problem {
    (Place::Line(line), format!("it is no sound XML: {e}"))
}

/// Counts lines up to places that never go back.
struct LineCounter<'a> {
    text: &'a [u8],
    at: usize,
    line: usize,
}

impl LineCounter<'_> {
    fn at(&mut self, place: usize) -> usize {
        let place = place.clamp(self.at, self.text.len());
        self.line += self.text[self.at..place].iter().filter(|byte| **byte == b'\n').count();
        self.at = place;
        self.line
    }
}

pub(super) fn write(side: &SurfaceMarks) -> Vec<u8> {
    let name = one_line(&side.name);
    let mut text = format!(
        "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData>\n  <DataFileName name=\"{}\"/>\n  <templateName name=\"\"/>\n </DocumentData>\n",
        escape(&name)
    );
    for mark in &side.marks {
        let [x, y, z] = mark.position.to_array();
        let label = one_line(&mark.label);
        text +=
            &format!(" <point x=\"{x}\" y=\"{y}\" z=\"{z}\" active=\"1\" name=\"{}\"/>\n", escape(&label));
    }
    text += "</PickedPoints>\n";
    text.into_bytes()
}

//! The tools that readers and writers share: lines of bounded length, coordinates, labels.

use super::limits::MAX_POINTS;
use crate::io::problem::{Place, Problem};
use crate::io::reading;
use crate::io::separated::one_line;
use glam::DVec3;

/// The length of the longest line in bytes.
const MAX_LINE: usize = 1 << 20;

/// The lines of a text (UTF-8, as [`super::read`] gives it) with their numbers, counted from 1.
pub fn lines(bytes: &[u8]) -> Result<Vec<(usize, &str)>, Problem> {
    let text = std::str::from_utf8(bytes);
    let text = text.map_err(|_| (Place::Header, "it holds bytes that are not text".to_owned()))?;
    let lines: Vec<_> = reading::lines(text).collect();
    match lines.iter().find(|(_, line)| line.len() > MAX_LINE) {
        Some((number, line)) => {
            let problem = format!("it has {} bytes, more than the {MAX_LINE} of a line", line.len());
            Err((Place::Line(*number), problem))
        }
        None => Ok(lines),
    }
}

/// A coordinate.
pub fn coordinate(token: Option<&str>, line: usize) -> Result<f64, Problem> {
    let value = reading::number::<f64>(token, line, "a coordinate")?;
    usable(value).ok_or_else(|| (Place::Line(line), format!("{value} is no usable coordinate")))
}

/// A coordinate that is finite and of sane size.
pub fn usable(value: f64) -> Option<f64> {
    reading::is_usable(value).then_some(value)
}

/// Three coordinates; `None` where all are left empty or `NA`, which says that the point was not placed.
pub fn position(tokens: [Option<&str>; 3], line: usize) -> Result<Option<DVec3>, Problem> {
    let is_missing = |token: &str| token.is_empty() || token.eq_ignore_ascii_case("na");
    if tokens.iter().all(|token| token.is_some_and(is_missing)) {
        return Ok(None);
    }
    let [x, y, z] = tokens;
    Ok(Some(DVec3::new(coordinate(x, line)?, coordinate(y, line)?, coordinate(z, line)?)))
}

/// A number of points, not more than may be and not more than a file of this size can hold.
pub fn point_count(token: Option<&str>, line: usize, bytes: usize) -> Result<usize, Problem> {
    let count: usize = reading::number(token, line, "a number of points")?;
    check_count(count, line)?;
    // A point takes at least three digits and what separates them.
    if count > bytes / 6 + 1 {
        let problem = format!("it announces {count} points, more than the file can hold");
        return Err((Place::Line(line), problem));
    }
    Ok(count)
}

/// Refuses too many points.
pub fn check_count(count: usize, line: usize) -> Result<(), Problem> {
    if count > MAX_POINTS {
        let problem = format!("there are {count} points or more; the limit is {MAX_POINTS}");
        return Err((Place::Line(line), problem));
    }
    Ok(())
}

/// The problem that a JSON reader reports, with its line.
pub fn json_problem(e: &serde_json::Error) -> Problem {
    let words = e.to_string();
    let problem = words.split(" at line ").next().unwrap_or_default().to_owned();
    (Place::Line(e.line().max(1)), problem)
}

/// A label without spaces, as formats need that separate by them.
pub fn one_word(label: &str) -> String {
    one_line(label).split_whitespace().collect::<Vec<_>>().join("_")
}

/// The three coordinates with all their digits, apart by `separator`.
pub fn coordinates(p: DVec3, separator: &str) -> String {
    format!("{}{separator}{}{separator}{}", p.x, p.y, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stay_on_their_line_and_in_their_word() {
        assert_eq!(one_line(" tip\r\nof the\ttail "), "tip  of the tail");
        assert_eq!(one_word(" tip\nof the tail "), "tip_of_the_tail");
    }

    #[test]
    fn a_long_line_is_refused_by_its_number() {
        let text = format!("short\n{}\n", "x".repeat(MAX_LINE + 1));
        assert_eq!(lines(text.as_bytes()).unwrap_err().0, Place::Line(2));
    }
}

//! The tools that several readers need: text, lines, numbers, and vertices joined by their coordinates.

use super::problem::{Place, Problem};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::{Cancelled, Pulse};
use glam::DVec3;
use std::borrow::Cow;

/// The bytes of a file without its mark: UTF-16 with its mark becomes UTF-8, and the mark of UTF-8 is taken away.
pub fn unmarked(bytes: &[u8]) -> Cow<'_, [u8]> {
    let utf16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
        Cow::Owned(String::from_utf16_lossy(&units).into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, ..] => utf16(u16::from_le_bytes),
        [0xfe, 0xff, ..] => utf16(u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

/// The text of a file: UTF-8, UTF-16 with its mark, or else Latin-1, of which any bytes are text but for control characters.
pub fn text(bytes: &[u8]) -> Result<Cow<'_, str>, Problem> {
    let is_control = |b: &u8| matches!(b, 0..=8 | 14..=25 | 27..=31 | 127);
    let not_text = |before: usize| {
        let line = 1 + bytes[..before].iter().filter(|b| **b == b'\n').count();
        (Place::Line(line), "it holds bytes that are not text: the file may be damaged".to_owned())
    };
    let text = match unmarked(bytes) {
        Cow::Borrowed(bytes) => std::str::from_utf8(bytes).map(Cow::Borrowed).ok(),
        Cow::Owned(bytes) => String::from_utf8(bytes).map(Cow::Owned).ok(),
    };
    match text {
        // Control characters in comments and names of good text do no harm, zeros show that it is none.
        Some(text) if !text.contains('\0') => Ok(text),
        text => match bytes.iter().position(is_control) {
            None if text.is_none() => Ok(Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect())),
            control => Err(not_text(control.unwrap_or(0))),
        },
    }
}

/// The lines of a text with their numbers, counted from 1. They end as on Unix, Windows or the Macintosh of old.
pub fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> + Clone {
    let whole = text.split('\n').map(|line| line.strip_suffix('\r').unwrap_or(line));
    whole.flat_map(|line| line.split('\r')).enumerate().map(|(index, line)| (index + 1, line))
}

/// The lines that hold more than spaces and comments (after `#`), without these.
pub fn content_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    lines(text).map(|(number, line)| (number, without_comment(line))).filter(|(_, line)| !line.is_empty())
}

/// A line without its comment and the spaces around it.
pub fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// A number of a text file.
pub fn number<T: std::str::FromStr>(token: Option<&str>, line: usize, what: &str) -> Result<T, Problem> {
    let token =
        token.ok_or_else(|| (Place::Line(line), format!("{what} is missing: the file may be cut off")))?;
    token.parse().map_err(|_| {
        let short = short(token);
        let has_comma = token.replacen(',', ".", 1).parse::<f64>().is_ok() && token.contains(',');
        let hint = if has_comma { ": write its decimals after a point, not a comma" } else { "" };
        (Place::Line(line), format!("\"{short}\" should be {what}{hint}"))
    })
}

/// The beginning of a word, for error sentences.
pub fn short(word: &str) -> String {
    word.chars().filter(|c| !c.is_control()).take(20).collect()
}

/// The sentence on a vertex that cannot be here, as one of its coordinates is not finite or so large that products of three are
/// not; `None` for a usable vertex.
pub fn unusable(p: DVec3) -> Option<String> {
    let [x, y, z] = p.to_array().map(in_few_digits);
    let are_usable = p.to_array().into_iter().all(is_usable);
    (!are_usable).then(|| format!("the coordinates [{x}, {y}, {z}] are not usable numbers"))
}

/// Whether a number is finite and of sane size: products of three stay finite.
pub fn is_usable(x: f64) -> bool {
    x.abs() < 1e100
}

/// A number without hundreds of digits.
pub fn in_few_digits(x: f64) -> String {
    if x == 0.0 || (1e-6..1e15).contains(&x.abs()) || !x.is_finite() {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

/// Makes polygons name the first of the vertices with exactly equal coordinates; formats without shared vertices need it.
pub fn weld(mut soup: PolygonSoup, pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Cancelled> {
    let mut first_at = rustc_hash::FxHashMap::default();
    let joined = |(number, p): (u32, &DVec3)| {
        pulse.beat()?;
        // Adding 0 makes -0 and 0 the same bits.
        let key = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
        Ok(*first_at.entry(key).or_insert(number))
    };
    soup.joined_with = (0..).zip(&soup.positions).map(joined).collect::<Result<_, _>>()?;
    for v in soup.polygons.iter_mut().flatten() {
        *v = soup.joined_with.get(*v as usize).copied().unwrap_or(u32::MAX);
    }
    Ok(soup)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_three_ways() {
        let numbered = |text| lines(text).collect::<Vec<_>>();
        let expected = [(1, "a"), (2, "b"), (3, "")];
        for text in ["a\nb\n", "a\r\nb\r\n", "a\rb\n"] {
            assert_eq!(numbered(text), expected, "{text:?}");
        }
        assert_eq!(numbered("a\rb\r"), expected[..2]);
    }

    #[test]
    fn text_is_told_from_other_bytes() {
        let utf16 =
            |order: fn(u16) -> [u8; 2]| "\u{feff}é#".encode_utf16().flat_map(order).collect::<Vec<u8>>();
        for bytes in
            [&b"\xe9#"[..], b"\xef\xbb\xbf\xc3\xa9#", &utf16(u16::to_le_bytes), &utf16(u16::to_be_bytes)]
        {
            assert_eq!(text(bytes).unwrap(), "é#");
        }
        let line = |bytes| text(bytes).unwrap_err().0;
        assert_eq!(line(b"a\nb\n\0"), Place::Line(3));
        assert_eq!(line(b"\xff\n\x01"), Place::Line(2));
    }

    #[test]
    fn a_decimal_comma_is_told() {
        let says = |token| number::<f64>(Some(token), 7, "a coordinate").unwrap_err().1;
        assert_eq!(
            says("1,5"),
            "\"1,5\" should be a coordinate: write its decimals after a point, not a comma"
        );
        assert_eq!(says("1,5,2"), "\"1,5,2\" should be a coordinate");
    }
}

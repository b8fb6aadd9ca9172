//! Tells formats by content.

use super::format::LandmarkFormat;
use super::limits::MAX_BYTES;
use super::{comma_separated, wrap};
use crate::io::reading;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// The number of bytes that are looked at in text formats: headers with comments are shorter.
const HEAD: usize = 1 << 14;

/// Tells the format of a landmark file. Where the content allows several, the ending of the name decides; a file that is not of
/// any format has none, whatever its name.
pub fn detect(name: &str, bytes: &[u8]) -> Option<LandmarkFormat> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace())?;
    match bytes[start] {
        b'{' | b'[' => json(bytes, LandmarkFormat::of_name(name)),
        b'<' => head(bytes).contains("PickedPoints").then_some(LandmarkFormat::MeshLab),
        _ => text(&head(bytes), LandmarkFormat::of_name(name)),
    }
}

fn head(bytes: &[u8]) -> String {
    String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]).into_owned()
}

fn text(head: &str, named: Option<LandmarkFormat>) -> Option<LandmarkFormat> {
    let mut lines = reading::lines(head).map(|(_, line)| line.trim()).filter(|line| !line.is_empty());
    let first = lines.clone().next()?;
    let upper = first.to_ascii_uppercase();
    if upper.split_whitespace().take(2).eq(["VERSION", "1.0"]) {
        return Some(LandmarkFormat::Idav);
    }
    if ["LM3", "LM"].iter().any(|word| upper.split('=').next().is_some_and(|key| key.trim() == *word))
        && upper.contains('=')
    {
        return Some(LandmarkFormat::Tps);
    }
    if is_fcsv_comment(first) {
        return Some(LandmarkFormat::Fcsv);
    }
    let parameters = lines.clone().find(|line| !line.starts_with(['"', '\'']));
    let is_matrix = |line: &str| line.starts_with("1 ") && line.to_ascii_uppercase().contains("DIM");
    if parameters.is_some_and(is_matrix) {
        return Some(LandmarkFormat::Nts);
    }
    let row = lines.find(|line| !line.starts_with('#'))?;
    if comma_separated::columns(row).is_some() {
        return Some(LandmarkFormat::Csv);
    }
    // Without its comments a list of fiducial points is a table without a header.
    let numbers = row.split(',').filter(|field| field.trim().parse::<f64>().is_ok()).count();
    (named == Some(LandmarkFormat::Fcsv) && numbers >= 3).then_some(LandmarkFormat::Fcsv)
}

fn is_fcsv_comment(line: &str) -> bool {
    let comment = line.strip_prefix('#').map(str::trim_start);
    comment.is_some_and(|comment| {
        ["Markups fiducial", "CoordinateSystem", "columns =", "Fiducial List file"]
            .iter()
            .any(|word| comment.starts_with(word))
    })
}

/// The first level of a JSON file tells its format.
fn json(bytes: &[u8], named: Option<LandmarkFormat>) -> Option<LandmarkFormat> {
    if bytes.len() > MAX_BYTES {
        return None;
    }
    let is_list = bytes.trim_ascii_start().starts_with(b"[");
    // The ending of Wrap's files is that of the program's own.
    if is_list && named == Some(LandmarkFormat::Conemap) || wrap::has_form(bytes) {
        return Some(LandmarkFormat::Wrap);
    }
    let has = |key: &str| match serde_json::from_slice::<BTreeMap<String, IgnoredAny>>(bytes) {
        Ok(entries) => entries.contains_key(key),
        // A damaged file belongs to the format that its first words name, so that the error tells the line.
        Err(_) => head(bytes).contains(&format!("\"{key}\"")),
    };
    if is_list {
        None
    } else if has("pairs") {
        Some(LandmarkFormat::Conemap)
    } else {
        has("markups").then_some(LandmarkFormat::SlicerJson)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides_and_names_only_among_what_it_allows() {
        use LandmarkFormat::{Conemap, Csv, Fcsv, Idav, MeshLab, Nts, SlicerJson, Tps, Wrap};
        let rows = "0,1,2,3,0,0,0,1,1,1,0,F-1,,\n";
        let cases = [
            ("a.json", "{\"pairs\": []}", Some(Conemap)),
            ("a.csv", "\u{feff} {\"source\": 1, \"pairs\": []}", Some(Conemap)),
            ("a.json", "{\"pairs\": [[1, 2], [3,", Some(Conemap)),
            ("a.json", "{\"markups\": []}", Some(SlicerJson)),
            ("a.txt", "[[1, 0.5, 0.5]]", Some(Wrap)),
            ("a.json", "{\"pairs of eyes\": [1, 0.5, 0.5]}", Some(Wrap)),
            ("a.json", "[[1, 0.5", Some(Wrap)),
            ("a.txt", "[[1, 0.5", None),
            ("a.json", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": []}", None),
            ("a.json", "{\"x\": 3}", None),
            ("a.json", "7", None),
            ("a.txt", "<!DOCTYPE PickedPoints>\n<PickedPoints/>", Some(MeshLab)),
            ("a.pp", "<svg/>", None),
            ("a.txt", "Version 1.0\n0\n", Some(Idav)),
            ("a.pts", "0 0 0\n", None),
            ("a.txt", "lm3=4\n", Some(Tps)),
            ("a.txt", "LM = 4\n", Some(Tps)),
            ("a.txt", "\"by hand\n1 4L 3 0 Dim=3\n", Some(Nts)),
            ("a.txt", "Name;X;Y;Z\n", Some(Csv)),
            ("a.txt", "label,l,p,s,defined\n", Some(Csv)),
            ("a.csv", "# Markups fiducial file version = 4.11\n", Some(Fcsv)),
            ("a.fcsv", rows, Some(Fcsv)),
            ("a.csv", rows, None),
            ("a.fcsv", "v 0 0 0\n", None),
            ("a.obj", "# made by hand\nv 0 0 0\n", None),
            ("a.off", "OFF\n4 4 6\n", None),
            ("a.fcsv", "", None),
        ];
        for (name, text, format) in cases {
            assert_eq!(detect(name, text.as_bytes()), format, "{name}: {text}");
        }
    }
}

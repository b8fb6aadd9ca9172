//! Tells the formats of mesh files by content.

use super::format::Format;
use super::reading::unmarked;
use super::{off, stl};

/// OBJ has no magic word: this many of the first lines must all be of its kinds.
const OBJ_LINES: usize = 6;

/// The first words of the lines of an OBJ file, also of those that are passed over.
const OBJ_WORDS: [&str; 47] = [
    "v",
    "vn",
    "vt",
    "vp",
    "f",
    "fo",
    "l",
    "p",
    "o",
    "g",
    "s",
    "mg",
    "mtllib",
    "usemtl",
    "maplib",
    "usemap",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "bsp",
    "bzp",
    "cdc",
    "cdp",
    "res",
    "call",
    "csh",
    "xyzrgb",
    "vc",
];

/// Tells the format by content.
pub fn detect(bytes: &[u8]) -> Option<Format> {
    let bytes = &*unmarked(bytes);
    if bytes.starts_with(b"glTF") {
        return Some(Format::Gltf);
    }
    let is_ply =
        bytes.strip_prefix(b"ply").is_some_and(|rest| rest.first().is_none_or(u8::is_ascii_whitespace));
    if is_ply {
        return Some(Format::Ply);
    }
    if stl::is_binary(bytes) {
        return Some(Format::Stl);
    }
    let mut lines = contents(bytes);
    let first = lines.next()?;
    let by_text = if off::is_header(first, lines.next()) {
        Some(Format::Off)
    } else if stl::is_text(bytes) {
        Some(Format::Stl)
    } else if first.starts_with(b"{") && bytes.windows(7).any(|word| word == b"\"asset\"") {
        Some(Format::Gltf)
    } else {
        is_obj(bytes).then_some(Format::Obj)
    };
    // Binary STL comes last, since it is recognised only by plausible numbers.
    by_text.or_else(|| stl::is_likely_binary(bytes).then_some(Format::Stl))
}

/// Lines that hold more than spaces and comments, however many of those there are; with the comments at their ends.
fn contents(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let lines = bytes.split(|b| matches!(b, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    lines.filter(|line| !line.is_empty() && !line.starts_with(b"#"))
}

fn is_obj(bytes: &[u8]) -> bool {
    let mut is_continued = false;
    let is_of_its_kind = |line: &[u8]| {
        let word = line.split(u8::is_ascii_whitespace).next().unwrap_or_default();
        let is_known = is_continued || OBJ_WORDS.iter().any(|known| known.as_bytes() == word);
        is_continued = line.ends_with(b"\\");
        is_known
    };
    contents(bytes).take(OBJ_LINES).all(is_of_its_kind)
}

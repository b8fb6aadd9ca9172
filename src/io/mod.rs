//! Bytes to polygon soups and landmark files. One file per format; formats are told by content, not by name.
//!
//! Everything is hostile until checked: sizes are compared with the file before anything is allocated.

pub mod curve_file;
mod format;
mod gltf_file;
pub mod gltf_parts;
pub mod landmark_file;
pub mod landmark_formats;
mod obj;
mod off;
pub mod picture;
mod ply;
mod problem;
mod reading;
mod stl;
pub mod texture_coordinates;
pub mod vertex_table;

pub use format::Format;
pub use problem::Place;

use crate::mesh::soup::PolygonSoup;
use problem::Problem;

/// Files larger than this are refused.
pub const MAX_BYTES: usize = 1 << 30;

/// Why a file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// No known format.
    #[error("this is not a mesh file that can be read: use {}", Format::NAMES)]
    UnknownFormat,
    /// Too large.
    #[error("the file has {bytes} bytes; the limit is {MAX_BYTES}")]
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// Something in the file is wrong.
    #[error("{format} file, {place}: {problem}")]
    Malformed {
        /// The format.
        format: Format,
        /// Where.
        place: Place,
        /// What is wrong and what to do.
        problem: String,
    },
}

/// Reads a mesh file of any known format.
///
/// # Errors
/// [`ReadError`] that names the line, vertex or face.
pub fn read_mesh(bytes: &[u8]) -> Result<PolygonSoup, ReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(ReadError::TooLarge { bytes: bytes.len() });
    }
    let format = detect(bytes).ok_or(ReadError::UnknownFormat)?;
    let soup = match format {
        Format::Obj => obj::read(bytes),
        Format::Off => off::read(bytes),
        Format::Ply => ply::read(bytes),
        Format::Stl => stl::read(bytes),
        Format::Gltf => gltf_file::read(bytes),
    };
    let malformed = |(place, problem)| ReadError::Malformed { format, place, problem };
    let soup = soup.map_err(malformed)?;
    check_numbers(&soup).map_err(malformed)?;
    Ok(soup)
}

/// Tells the format by content.
pub fn detect(bytes: &[u8]) -> Option<Format> {
    if bytes.starts_with(b"glTF") {
        return Some(Format::Gltf);
    }
    if bytes.starts_with(b"ply") {
        return Some(Format::Ply);
    }
    if stl::is_binary(bytes) {
        return Some(Format::Stl);
    }
    // Long enough for a header with comments.
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
    let head = head.trim_start_matches('\u{feff}');
    let mut lines = head.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#'));
    let first = lines.next()?;
    if matches!(first.split_whitespace().next(), Some("OFF" | "COFF" | "NOFF" | "CNOFF" | "STOFF")) {
        return Some(Format::Off);
    }
    if first.starts_with("solid") {
        return Some(Format::Stl);
    }
    if first.starts_with('{') && head.contains("\"asset\"")
        || first.starts_with('{') && bytes.windows(7).any(|w| w == b"\"asset\"")
    {
        return Some(Format::Gltf);
    }
    let is_obj = |l: &str| {
        let word = l.split_whitespace().next().unwrap_or_default();
        matches!(word, "v" | "vn" | "vt" | "f" | "o" | "g" | "s" | "mtllib" | "usemtl")
    };
    // OBJ has no magic word: its first six lines must all be of its kinds.
    (is_obj(first) && lines.take(5).all(is_obj)).then_some(Format::Obj)
}

/// Every coordinate finite and of sane size, every polygon with at least three existing vertices.
fn check_numbers(soup: &PolygonSoup) -> Result<(), Problem> {
    // Products of three coordinates stay finite up to 1e100.
    let sane = |p: &glam::DVec3| p.is_finite() && p.abs().max_element() < 1e100;
    if let Some(v) = soup.positions.iter().position(|p| !sane(p)) {
        return Err((
            Place::Vertex(v),
            format!("the coordinates {} are not usable numbers", soup.positions[v]),
        ));
    }
    for (f, polygon) in soup.polygons.iter().enumerate() {
        if polygon.len() < 3 {
            return Err((
                Place::Face(f),
                format!("it has {} corners; a face needs at least 3", polygon.len()),
            ));
        }
        if let Some(v) = polygon.iter().find(|v| **v as usize >= soup.positions.len()) {
            let count = soup.positions.len();
            return Err((Place::Face(f), format!("it names vertex {v}, but the file has {count} vertices")));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;

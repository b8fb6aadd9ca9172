//! Bytes to polygon soups and landmark files. One file per format; formats are told by content, not by name.
//!
//! Everything is hostile until checked: sizes are compared with the file before anything is allocated.

pub mod appearance;
pub mod curve_file;
mod data_uri;
mod detection;
mod format;
mod gltf_container;
mod gltf_document;
mod gltf_file;
mod gltf_look;
pub mod gltf_parts;
pub mod landmark_file;
pub mod landmark_formats;
pub mod moved;
mod obj;
mod off;
mod other_file;
pub mod picture;
mod ply;
mod problem;
mod reading;
mod stl;
pub mod texture_coordinates;
pub mod vertex_table;
mod written_text;

pub use detection::detect;
pub use format::Format;
pub use other_file::OtherFile;
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
    /// A file of another kind.
    #[error("{0}")]
    OtherFile(OtherFile),
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
    let Some(format) = detect(bytes) else {
        return Err(OtherFile::of(bytes).map_or(ReadError::UnknownFormat, ReadError::OtherFile));
    };
    let bytes = &*reading::unmarked(bytes);
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

/// Every coordinate finite and of sane size, every polygon with at least three existing vertices.
fn check_numbers(soup: &PolygonSoup) -> Result<(), Problem> {
    // Products of three coordinates stay finite up to 1e100.
    let sane = |p: &glam::DVec3| p.is_finite() && p.abs().max_element() < 1e100;
    if let Some(v) = soup.positions.iter().position(|p| !sane(p)) {
        let [x, y, z] = soup.positions[v].to_array().map(short);
        return Err((Place::Vertex(v), format!("the coordinates [{x}, {y}, {z}] are not usable numbers")));
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

/// A number without hundreds of digits.
fn short(x: f64) -> String {
    if x == 0.0 || (1e-6..1e15).contains(&x.abs()) || !x.is_finite() {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

#[cfg(test)]
mod tests;

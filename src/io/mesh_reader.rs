//! From the bytes of a mesh file of any known format to a polygon soup whose numbers can be used.

use super::detection::detect;
use super::format::Format;
use super::other_file::OtherFile;
use super::problem::{Place, Unread};
use super::{gltf_file, obj, off, ply, reading, stl};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::{Cancelled, Monitor, Pulse, Silent};
use glam::DVec3;

/// The largest size of a file in bytes; larger files are refused.
pub const MAX_BYTES: usize = 1 << 30;

/// Why a file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file has no known format.
    #[error("this is not a mesh file that can be read: use {}", Format::NAMES)]
    UnknownFormat,
    /// The file is one of another kind.
    #[error("{0}")]
    OtherFile(OtherFile),
    /// The file is too large.
    #[error("the file has {bytes} bytes; the limit is {MAX_BYTES}")]
    TooLarge {
        /// The file's size in bytes.
        bytes: usize,
    },
    /// Something in the file is wrong.
    #[error("{format} file, {place}: {problem}")]
    Malformed {
        /// The file's format.
        format: Format,
        /// The place of the fault.
        place: Place,
        /// The problem and its remedy.
        problem: String,
    },
    /// The user asked to stop.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
}

/// The number of elements of a file, or of lines of a text, that are read between two questions to the monitor: some milliseconds.
pub(super) const ASKED_EVERY: usize = 4096;

/// Reads a mesh file of any known format.
///
/// # Errors
/// [`ReadError`] that names the line, vertex or face.
pub fn read_mesh(bytes: &[u8]) -> Result<PolygonSoup, ReadError> {
    read_mesh_asking(bytes, &mut Silent)
}

/// Reads a mesh file of any known format, and asks the monitor meanwhile whether to go on.
///
/// # Errors
/// As [`read_mesh`], and [`ReadError::Stopped`].
pub fn read_mesh_asking(bytes: &[u8], monitor: &mut dyn Monitor) -> Result<PolygonSoup, ReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(ReadError::TooLarge { bytes: bytes.len() });
    }
    let Some(format) = detect(bytes) else {
        return Err(OtherFile::of(bytes).map_or(ReadError::UnknownFormat, ReadError::OtherFile));
    };
    let bytes = &*reading::unmarked(bytes);
    let pulse = &mut Pulse::new(monitor, ASKED_EVERY);
    let soup = match format {
        Format::Obj => obj::read(bytes, pulse),
        Format::Off => off::read(bytes, pulse),
        Format::Ply => ply::read(bytes, pulse),
        Format::Stl => stl::read(bytes, pulse),
        Format::Gltf => gltf_file::read(bytes, pulse),
    };
    let soup = soup.and_then(|soup| check_numbers(&soup, pulse).map(|()| soup));
    soup.map_err(|unread| match unread {
        Unread::Problem((place, problem)) => ReadError::Malformed { format, place, problem },
        Unread::Stopped(stop) => stop.into(),
    })
}

/// Checks that every coordinate is finite and of sane size, and every polygon has at least three vertices that exist.
fn check_numbers(soup: &PolygonSoup, pulse: &mut Pulse<'_>) -> Result<(), Unread> {
    let unusable = |(v, p): (usize, &DVec3)| Some((Place::Vertex(v), reading::unusable(*p)?));
    if let Some(problem) = soup.positions.iter().enumerate().find_map(unusable) {
        return Err(problem.into());
    }
    for (f, polygon) in soup.polygons.iter().enumerate() {
        pulse.beat()?;
        check_polygon(polygon, soup.positions.len()).map_err(|problem| (Place::Face(f), problem))?;
    }
    Ok(())
}

/// Checks that a polygon has at least three corners, at vertices that exist.
fn check_polygon(polygon: &[u32], vertices: usize) -> Result<(), String> {
    if polygon.len() < 3 {
        return Err(format!("it has {} corners; a face needs at least 3", polygon.len()));
    }
    match polygon.iter().find(|v| **v as usize >= vertices) {
        Some(v) => Err(format!("it names vertex {v}, but the file has {vertices} vertices")),
        None => Ok(()),
    }
}

//! Tables told by their content.

use super::content::{TableError, VertexTable};
use super::{comma_separated, properties};
use crate::io::MAX_BYTES;
use crate::io::problem::Place;

/// Reads the values of the vertices of a mesh file with that many vertices: a table, or a PLY file.
///
/// # Errors
/// [`TableError`] that names the line or vertex.
pub fn read(bytes: &[u8], vertices: usize) -> Result<VertexTable, TableError> {
    if bytes.len() > MAX_BYTES {
        let problem = format!("the file has {} bytes; the limit is {MAX_BYTES}", bytes.len());
        return Err(TableError { place: Place::Header, problem });
    }
    let table = if bytes.starts_with(b"ply") {
        properties::read(bytes, vertices)
    } else {
        comma_separated::read(bytes, vertices)
    }?;
    if table.columns.is_empty() {
        let problem = "there is nothing but the vertices: give each of them at least one value".to_owned();
        return Err(TableError { place: Place::Header, problem });
    }
    Ok(table)
}

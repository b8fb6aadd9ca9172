//! Reads tables, whose format is recognised by their content.

use super::content::{AnnouncedColumn, TableError, VertexTable};
use super::{comma_separated, properties};
use crate::io::problem::{Place, Problem};
use crate::io::reading::unmarked;
use crate::io::{Format, MAX_BYTES, detect};

/// Reads the values of the vertices of a mesh file with that many vertices: a table, or a PLY file.
///
/// # Errors
/// [`TableError`] that names the line or vertex.
pub fn read(bytes: &[u8], vertices: usize) -> Result<VertexTable, TableError> {
    if detect(bytes) == Some(Format::Ply) {
        let table = of_ply(bytes, vertices)?;
        check_columns(&table)?;
        return Ok(table);
    }
    check_size(bytes)?;
    let table = comma_separated::read(bytes, vertices)?;
    check_columns(&table)?;
    Ok(table)
}

/// The values that a PLY file has for its vertices, of which there must be that many, but for their coordinates; there may be none.
///
/// # Errors
/// [`TableError`] that names the vertex.
pub fn of_ply(bytes: &[u8], vertices: usize) -> Result<VertexTable, TableError> {
    check_size(bytes)?;
    Ok(properties::read(&unmarked(bytes), vertices)?)
}

/// The columns of values that the beginning of a file announces, whatever mesh they are of, and without reading them: of a PLY file
/// the vertex properties but for the coordinates and lists, which may be none. `None` where the file is neither PLY nor a table.
///
/// # Errors
/// [`TableError`] that names the line.
pub fn announced(bytes: &[u8]) -> Result<Option<Vec<AnnouncedColumn>>, TableError> {
    check_size(bytes)?;
    if detect(bytes) == Some(Format::Ply) {
        return Ok(Some(properties::announced(&unmarked(bytes))?));
    }
    Ok(comma_separated::announced(bytes)?)
}

fn check_size(bytes: &[u8]) -> Result<(), Problem> {
    if bytes.len() > MAX_BYTES {
        return Err((Place::Header, format!("the file has {} bytes; the limit is {MAX_BYTES}", bytes.len())));
    }
    Ok(())
}

fn check_columns(table: &VertexTable) -> Result<(), Problem> {
    if table.columns.is_empty() {
        let problem = "there is nothing but the vertices: give each of them at least one value".to_owned();
        return Err((Place::Header, problem));
    }
    Ok(())
}

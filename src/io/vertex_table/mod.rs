//! Values at the vertices of a mesh file: tables (CSV) and the vertex properties of PLY files.

mod comma_separated;
mod content;
mod number_type;
mod properties;
mod reading;
#[cfg(test)]
mod tests;

pub use content::{AnnouncedColumn, Column, Heading, Rows, TableError, VertexTable};
pub use number_type::NumberType;
pub use reading::{announced, of_ply, read};

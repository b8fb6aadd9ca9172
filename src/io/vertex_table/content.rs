//! The contents of a table of values by vertex, and the errors about one.

use super::number_type::NumberType;
use crate::io::problem::{Place, Problem};

/// Columns of numbers, one number for each vertex of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexTable {
    /// The way in which rows name their vertex.
    pub rows: Rows,
    /// The columns in the order of the file.
    pub columns: Vec<Column>,
    /// Properties that are lists of numbers, and are left out.
    pub left_out: Vec<String>,
}

/// The way in which the rows of a table name their vertex.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rows {
    /// Row i is vertex i.
    InOrder {
        /// Whether the first line of a CSV table names the columns.
        heading: Heading,
    },
    /// The first column, of this name, has the number.
    Numbered(String),
}

/// Whether the first line of a table names its columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heading {
    /// The first line names the columns.
    Named,
    /// The first line has numbers as all others, and the columns are called `1`, `2` and so on.
    Missing,
}

/// A number for each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The type of its numbers in the file.
    pub number_type: NumberType,
    /// The value of each vertex of the file; `None` where it has none.
    pub values: Vec<Option<f64>>,
}

/// A column that the beginning of a file announces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AnnouncedColumn {
    /// Its name.
    pub name: String,
    /// The type of its numbers in the file.
    pub number_type: NumberType,
}

/// The error about a table, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct TableError {
    /// The place of the fault.
    pub place: Place,
    /// The problem and its remedy.
    pub problem: String,
}

impl From<Problem> for TableError {
    fn from((place, problem): Problem) -> Self {
        Self { place, problem }
    }
}

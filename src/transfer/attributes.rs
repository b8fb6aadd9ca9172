//! Attributes of one file's vertices as attributes of the other's.
//!
//! Numbers are projected; weights besides lose what is negative, and keep the sum of their row; labels go by the majority of area.

use super::mapped_files::MappedFiles;
use super::values::{Carrying, ValueCarrier, ValueError, Values};
use crate::export::vertex_image::Direction;
use crate::io::vertex_table::{Column, Rows, VertexTable};
use crate::map_file::FileMesh;
use crate::mesh::VertexId;
use crate::monitor::{Monitor, Portion};
use typed_index_collections::TiVec;

/// The options of bringing attributes over.
#[derive(Clone, Debug)]
pub struct AttributeOptions {
    /// The direction: from which mesh to which.
    pub direction: Direction,
    /// The method to compute a value at a vertex from those of the other mesh.
    pub carrying: Carrying,
    /// Names of columns that are labels. Whole-numbered columns of a PLY file that are no colours are labels anyway.
    pub labels: Vec<String>,
    /// Names of columns that are weights.
    pub weights: Vec<String>,
}

/// Why attributes cannot be brought over.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AttributeError {
    /// A column that was asked for is not there.
    #[error("there is no column \"{name}\": there are {known}")]
    NoColumn {
        /// The name of the column.
        name: String,
        /// The names of the columns that are there.
        known: String,
    },
    /// A column was called labels and weights.
    #[error("the column \"{name}\" cannot be both labels and weights")]
    TwoKinds {
        /// The name of the column.
        name: String,
    },
    /// A vertex has no value.
    #[error("vertex {vertex} has no value of \"{name}\"")]
    Missing {
        /// Its number in the file.
        vertex: usize,
        /// The column.
        name: String,
    },
    /// A label is not a whole number.
    #[error(
        "vertex {vertex} has the label {value} of \"{name}\": labels are whole numbers of at most 15 digits"
    )]
    NoLabel {
        /// Its number in the file.
        vertex: usize,
        /// The column.
        name: String,
        /// The value of the column there.
        value: f64,
    },
    /// A weight is negative.
    #[error("vertex {vertex} has the weight {value} of \"{name}\": weights are not negative")]
    NoWeight {
        /// Its number in the file.
        vertex: usize,
        /// The column.
        name: String,
        /// The value of the column there.
        value: f64,
    },
    /// The values could not be brought over.
    #[error(transparent)]
    Value(#[from] ValueError),
}

/// The kind of values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Number,
    Weight,
    Label,
}

/// The names of colours in PLY files: their whole numbers are no labels.
const COLOURS: [&str; 12] = [
    "red",
    "green",
    "blue",
    "alpha",
    "r",
    "g",
    "b",
    "a",
    "diffuse_red",
    "diffuse_green",
    "diffuse_blue",
    "diffuse_alpha",
];

/// The largest label: larger whole numbers are not exact.
const LARGEST_LABEL: f64 = 1e15;

/// The attributes of the giving file's vertices at the receiving file's vertices, with rows that name their vertices as the given ones do.
/// Of vertices that were joined the first one's values are taken; a vertex that no face uses has none.
///
/// # Errors
/// [`AttributeError`].
pub fn attributes(
    mapped: MappedFiles<'_>,
    table: &VertexTable,
    options: &AttributeOptions,
    monitor: &mut dyn Monitor,
) -> Result<VertexTable, AttributeError> {
    let files = mapped.files;
    let kinds = kinds(table, options)?;
    let giver = options.direction.side();
    let given: Vec<Values> = table
        .columns
        .iter()
        .zip(&kinds)
        .map(|(c, kind)| of_mesh(files[giver], c, *kind))
        .collect::<Result<_, _>>()?;
    let carrier = ValueCarrier::new(mapped.meshes(), mapped.map, options.direction);
    let numbered: Vec<usize> = (0..kinds.len()).filter(|&k| kinds[k] != Kind::Label).collect();
    let labelled: Vec<usize> = (0..kinds.len()).filter(|&k| kinds[k] == Kind::Label).collect();
    let mut carried: Vec<Values> = vec![Values::new(); kinds.len()];
    if !numbered.is_empty() {
        let columns: Vec<Values> = numbered.iter().map(|&k| given[k].clone()).collect();
        let part = &mut Portion::new(monitor, 0.0, numbered.len() as f64 / kinds.len() as f64);
        for (k, values) in numbered.iter().zip(carrier.numbers(&columns, options.carrying, part)?) {
            carried[*k] = values;
        }
    }
    for (done, &k) in labelled.iter().enumerate() {
        let share = |done: usize| (numbered.len() + done) as f64 / kinds.len() as f64;
        let part = &mut Portion::new(monitor, share(done), share(done + 1));
        // Labels were checked to be whole.
        let labels: TiVec<VertexId, i64> = given[k].iter().map(|label| *label as i64).collect();
        let found = carrier.labels(&labels, options.carrying, part).map_err(ValueError::from)?;
        carried[k] = found.into_iter().map(|label| label as f64).collect();
    }
    let weights: Vec<usize> = (0..kinds.len()).filter(|&k| kinds[k] == Kind::Weight).collect();
    keep_weights(&mut carried, &weights);
    let receiver = files[giver.other()].checked();
    let column = |(column, values): (&Column, &Values)| Column {
        name: column.name.clone(),
        number_type: column.number_type,
        values: receiver.by_file_vertex(&values.raw),
    };
    let rows = match &table.rows {
        Rows::Numbered(_) => Rows::Numbered(numbers_name(&table.rows, options.direction)),
        rows @ Rows::InOrder { .. } => rows.clone(),
    };
    let columns = table.columns.iter().zip(&carried).map(column).collect();
    Ok(VertexTable { rows, columns, left_out: Vec::new() })
}

/// The name of the column of vertex numbers on the other side.
fn numbers_name(rows: &Rows, direction: Direction) -> String {
    match rows {
        Rows::Numbered(name) if name != "vertex" => format!("{}_vertex", direction.names()[1]),
        _ => "vertex".to_owned(),
    }
}

fn kinds(table: &VertexTable, options: &AttributeOptions) -> Result<Vec<Kind>, AttributeError> {
    for name in options.labels.iter().chain(&options.weights) {
        if !table.columns.iter().any(|column| column.name == *name) {
            let known: Vec<String> =
                table.columns.iter().take(20).map(|c| format!("\"{}\"", c.name)).collect();
            return Err(AttributeError::NoColumn { name: name.clone(), known: known.join(", ") });
        }
    }
    let kind = |column: &Column| {
        let name = &column.name;
        match [options.labels.contains(name), options.weights.contains(name)] {
            [true, true] => Err(AttributeError::TwoKinds { name: name.clone() }),
            [true, false] => Ok(Kind::Label),
            [false, true] => Ok(Kind::Weight),
            [false, false] if column.number_type.is_whole() && !COLOURS.contains(&name.as_str()) => {
                Ok(Kind::Label)
            }
            [false, false] => Ok(Kind::Number),
        }
    };
    table.columns.iter().map(kind).collect()
}

/// A column by vertex of the mesh.
fn of_mesh(file: &FileMesh, column: &Column, kind: Kind) -> Result<Values, AttributeError> {
    let value = |v: VertexId| {
        let vertex = file.vertex_number(v);
        let name = || column.name.clone();
        let value = column.values.get(vertex).copied().flatten();
        let value = value.ok_or_else(|| AttributeError::Missing { vertex, name: name() })?;
        match kind {
            Kind::Label if value.fract() != 0.0 || value.abs() > LARGEST_LABEL => {
                Err(AttributeError::NoLabel { vertex, name: name(), value })
            }
            Kind::Weight if value < 0.0 => Err(AttributeError::NoWeight { vertex, name: name(), value }),
            _ => Ok(value),
        }
    };
    file.mesh().vertices().map(value).collect()
}

/// Takes what is negative out of the weights, and brings the rest of each row to the row's sum.
fn keep_weights(columns: &mut [Values], weights: &[usize]) {
    let Some(&first) = weights.first() else { return };
    for v in (0..columns[first].len()).map(VertexId::from) {
        let sum: f64 = weights.iter().map(|&k| columns[k][v]).sum();
        let kept: f64 = weights.iter().map(|&k| columns[k][v].max(0.0)).sum();
        let scale = if kept > 0.0 { sum.max(0.0) / kept } else { 0.0 };
        weights.iter().for_each(|&k| columns[k][v] = columns[k][v].max(0.0) * scale);
    }
}

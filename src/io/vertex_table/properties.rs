//! The vertex properties of PLY files, but for the coordinates.

use super::content::{AnnouncedColumn, Column, Heading, Rows, VertexTable};
use super::number_type::NumberType;
use crate::io::ply::{vertex_element, vertex_rows};
use crate::io::problem::{Place, Problem};
use crate::io::reading::is_usable;
use ply_rs_bw::ply::{PropertyDef, PropertyType, ScalarType};

/// The properties that are places, not values.
const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// The columns that the header announces: all properties except lists and coordinates.
pub(super) fn announced(bytes: &[u8]) -> Result<Vec<AnnouncedColumn>, Problem> {
    let element = vertex_element(bytes)?;
    let column = |(name, property): (&String, &PropertyDef)| match &property.data_type {
        PropertyType::Scalar(scalar_type) if !COORDINATES.contains(&name.as_str()) => {
            Some(AnnouncedColumn { name: name.clone(), number_type: number_type(scalar_type) })
        }
        _ => None,
    };
    Ok(element.properties.iter().filter_map(column).collect())
}

pub(super) fn read(bytes: &[u8], vertices: usize) -> Result<VertexTable, Problem> {
    let (announced, rows) = vertex_rows(bytes)?;
    if rows.len() != vertices {
        let problem = format!("it has {} vertices, but the mesh file has {vertices}", rows.len());
        return Err((Place::Header, problem));
    }
    let (mut columns, mut left_out) = (Vec::new(), Vec::new());
    // The number of the property among those that are no lists.
    let mut number = 0;
    for (name, property) in &announced.properties {
        let number_type = match &property.data_type {
            PropertyType::List(..) => {
                left_out.push(name.clone());
                continue;
            }
            PropertyType::Scalar(scalar_type) => number_type(scalar_type),
        };
        number += 1;
        if COORDINATES.contains(&name.as_str()) {
            continue;
        }
        let mut values = Vec::with_capacity(vertices);
        for (v, row) in rows.iter().enumerate() {
            let value = row.get(number - 1).copied().filter(|value| is_usable(*value));
            if value.is_none() {
                return Err((Place::Vertex(v), format!("its \"{name}\" is not a usable number")));
            }
            values.push(value);
        }
        columns.push(Column { name: name.clone(), number_type, values });
    }
    Ok(VertexTable { rows: Rows::InOrder { heading: Heading::Named }, columns, left_out })
}

fn number_type(scalar: &ScalarType) -> NumberType {
    match scalar {
        ScalarType::Char => NumberType::Char,
        ScalarType::UChar => NumberType::UChar,
        ScalarType::Short => NumberType::Short,
        ScalarType::UShort => NumberType::UShort,
        ScalarType::Int => NumberType::Int,
        ScalarType::UInt => NumberType::UInt,
        ScalarType::Float => NumberType::Float,
        ScalarType::Double => NumberType::Double,
    }
}

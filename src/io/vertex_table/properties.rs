//! The vertex properties of PLY files, but for the coordinates.

use super::{Column, Heading, NumberType, Rows, VertexTable};
use crate::io::ply::{header_and_payload, scalar};
use crate::io::problem::{Place, Problem};
use ply_rs_bw::ply::{PropertyType, ScalarType};

pub(super) fn read(bytes: &[u8], vertices: usize) -> Result<VertexTable, Problem> {
    let (header, mut payload) = header_and_payload(bytes)?;
    let no_vertices = || (Place::Header, "it has no vertices".to_owned());
    let announced = header.elements.get("vertex").ok_or_else(no_vertices)?;
    let elements = payload.swap_remove("vertex").ok_or_else(no_vertices)?;
    if elements.len() != vertices {
        let problem = format!("it has {} vertices, but the mesh file has {vertices}", elements.len());
        return Err((Place::Header, problem));
    }
    let (mut columns, mut left_out) = (Vec::new(), Vec::new());
    for (name, property) in &announced.properties {
        let number_type = match &property.data_type {
            PropertyType::List(..) => {
                left_out.push(name.clone());
                continue;
            }
            PropertyType::Scalar(_) if ["x", "y", "z"].contains(&name.as_str()) => continue,
            PropertyType::Scalar(scalar_type) => number_type(scalar_type),
        };
        let mut values = Vec::with_capacity(vertices);
        for (v, element) in elements.iter().enumerate() {
            let value = element.get(name).and_then(scalar).filter(|value| value.is_finite());
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

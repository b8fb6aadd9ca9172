//! PLY, text and binary; the vertex order of the file is kept.

use super::problem::{Place, Problem};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Encoding, Header, Payload, Property, PropertyType, ScalarType,
};

/// What a file announces, and its elements; the sizes are checked before memory is taken.
pub(super) fn header_and_payload(bytes: &[u8]) -> Result<(Header, Payload<DefaultElement>), Problem> {
    let broken = |e: ParseError| (Place::Header, format!("it cannot be read: {e}"));
    let mut reader = Reader::new(bytes);
    let parser = Parser::<DefaultElement>::new();
    let header = parser.read_header(&mut reader).map_err(broken)?;
    check_sizes(&header, bytes.len())?;
    let payload = parser.read_payload(&mut reader, &header).map_err(|e| {
        (Place::Header, format!("its contents do not match its header ({e}): the file may be cut off"))
    })?;
    Ok((header, payload))
}

pub(super) fn read(bytes: &[u8]) -> Result<PolygonSoup, Problem> {
    let (_, mut payload) = header_and_payload(bytes)?;
    let vertices = payload.swap_remove("vertex").ok_or((Place::Header, "it has no vertices".to_owned()))?;
    let faces = payload.swap_remove("face").ok_or((Place::Header, "it has no faces".to_owned()))?;
    let positions = vertices.iter().enumerate().map(|(v, e)| position(v, e)).collect::<Result<_, _>>()?;
    let polygons = faces.iter().enumerate().map(|(f, e)| polygon(f, e)).collect::<Result<_, _>>()?;
    Ok(PolygonSoup { positions, polygons, ..PolygonSoup::default() })
}

/// The elements announced must fit into the file, so that a small file cannot ask for much memory or time.
fn check_sizes(header: &Header, bytes: usize) -> Result<(), Problem> {
    let mut least = 0_u64;
    for (name, element) in &header.elements {
        let size = least_size(element, header.encoding);
        if size == 0 && element.count > 0 {
            return Err((Place::Header, format!("element \"{name}\" has no properties")));
        }
        least = least.saturating_add(size.saturating_mul(element.count as u64));
    }
    if least > bytes as u64 {
        let problem =
            format!("it announces at least {least} bytes of elements, but the file has {bytes} bytes");
        return Err((Place::Header, problem));
    }
    Ok(())
}

/// The fewest bytes that one element takes.
fn least_size(element: &ElementDef, encoding: Encoding) -> u64 {
    let text = matches!(encoding, Encoding::Ascii);
    let size = |t: &ScalarType| match t {
        _ if text => 2,
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    let property = |p: &PropertyType| match p {
        PropertyType::Scalar(t) => size(t),
        PropertyType::List(count, _) => size(count),
    };
    element.properties.values().map(|p| property(&p.data_type)).sum()
}

fn position(v: usize, element: &DefaultElement) -> Result<DVec3, Problem> {
    let coordinate = |name: &str| {
        element
            .get(name)
            .and_then(scalar)
            .ok_or_else(|| (Place::Vertex(v), format!("it has no coordinate {name}")))
    };
    Ok(DVec3::new(coordinate("x")?, coordinate("y")?, coordinate("z")?))
}

/// A number of any type; `None` for a list.
pub(super) fn scalar(property: &Property) -> Option<f64> {
    Some(match property {
        Property::Char(x) => f64::from(*x),
        Property::UChar(x) => f64::from(*x),
        Property::Short(x) => f64::from(*x),
        Property::UShort(x) => f64::from(*x),
        Property::Int(x) => f64::from(*x),
        Property::UInt(x) => f64::from(*x),
        Property::Float(x) => f64::from(*x),
        Property::Double(x) => *x,
        _ => return None,
    })
}

fn polygon(f: usize, element: &DefaultElement) -> Result<Vec<u32>, Problem> {
    let list = element.get("vertex_indices").or_else(|| element.get("vertex_index"));
    let corners: Option<Vec<u32>> = match list {
        Some(Property::ListChar(x)) => x.iter().map(|&v| u32::try_from(v).ok()).collect(),
        Some(Property::ListUChar(x)) => Some(x.iter().map(|&v| u32::from(v)).collect()),
        Some(Property::ListShort(x)) => x.iter().map(|&v| u32::try_from(v).ok()).collect(),
        Some(Property::ListUShort(x)) => Some(x.iter().map(|&v| u32::from(v)).collect()),
        Some(Property::ListInt(x)) => x.iter().map(|&v| u32::try_from(v).ok()).collect(),
        Some(Property::ListUInt(x)) => Some(x.clone()),
        _ => None,
    };
    corners.ok_or_else(|| (Place::Face(f), "it has no usable list of vertex numbers".into()))
}

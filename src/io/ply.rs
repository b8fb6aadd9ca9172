//! PLY, text and binary; the vertex order of the file is kept.
//!
//! The library reads the elements, some at a time, so that no more of them are held than those: an element of one byte must not become
//! hundreds. Elements of all kinds are read as one type, since the program has a copy of the library's parser for each.

use super::problem::{Place, Problem, Unread};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::{Cancelled, Pulse, Silent};
use glam::DVec3;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::io::{BufRead, ErrorKind, Read};

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

/// The names of the list of a face's vertices.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

pub(super) fn read(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Unread> {
    let file = File::split(bytes)?;
    let stopped = Cell::new(None);
    let (mut reader, header) = file.opened(pulse, &stopped)?;
    check_elements(&header)?;
    check_sizes(&header, bytes.len())?;
    let mut soup = PolygonSoup::default();
    for (name, element) in &header.elements {
        let elements = Elements { element, header: &header, stopped: &stopped };
        match name.as_str() {
            "vertex" => {
                soup.positions.reserve_exact(element.count);
                elements.each(&mut reader, |vertex: MeshElement| {
                    soup.positions.push(DVec3::from(vertex.place));
                    Ok(())
                })?;
            }
            "face" => {
                soup.polygons.reserve_exact(element.count);
                elements.each(&mut reader, |face: MeshElement| {
                    let corners = face.corners.ok_or_else(|| {
                        let face = Place::Face(soup.polygons.len());
                        (face, "it has no usable list of vertex numbers".to_owned())
                    })?;
                    soup.polygons.push(corners);
                    Ok(())
                })?;
            }
            _ => elements.pass_over(&mut reader)?,
        }
    }
    Ok(soup)
}

/// The vertices with their numbers: what is announced of them, and by vertex the values of its properties that are no lists, in order.
pub(super) fn vertex_rows(bytes: &[u8]) -> Result<(ElementDef, Vec<Vec<f64>>), Unread> {
    let file = File::split(bytes)?;
    let (mut silent, stopped) = (Silent, Cell::new(None));
    let mut pulse = Pulse::new(&mut silent, usize::MAX);
    let (mut reader, header) = file.opened(&mut pulse, &stopped)?;
    check_sizes(&header, bytes.len())?;
    for (name, element) in &header.elements {
        let elements = Elements { element, header: &header, stopped: &stopped };
        if name == "vertex" {
            let mut rows = Vec::with_capacity(element.count);
            elements.each(&mut reader, |row: Row| {
                rows.push(row.0);
                Ok(())
            })?;
            return Ok((element.clone(), rows));
        }
        elements.pass_over(&mut reader)?;
    }
    Err((Place::Header, "it has no vertices".to_owned()).into())
}

/// The element of the vertices in the header.
pub(super) fn vertex_element(bytes: &[u8]) -> Result<ElementDef, Problem> {
    let file = File::split(bytes)?;
    let (mut silent, stopped) = (Silent, Cell::new(None));
    let mut pulse = Pulse::new(&mut silent, usize::MAX);
    let (_, header) = file.opened(&mut pulse, &stopped)?;
    let vertices = header.elements.get("vertex").cloned();
    vertices.ok_or_else(|| (Place::Header, "it has no vertices".to_owned()))
}

/// The number of elements that are read together.
const TOGETHER: usize = 4096;

/// The elements of a kind.
struct Elements<'a> {
    element: &'a ElementDef,
    header: &'a Header,
    stopped: &'a Cell<Option<Cancelled>>,
}

impl Elements<'_> {
    /// Reads the elements in turn.
    fn each<E: PropertyAccess, R: BufRead>(
        &self,
        reader: &mut Reader<R>,
        mut take: impl FnMut(E) -> Result<(), Unread>,
    ) -> Result<(), Unread> {
        let parser = Parser::<E>::new();
        let mut some = self.element.clone();
        let mut left = self.element.count;
        while left > 0 {
            some.count = left.min(TOGETHER);
            left -= some.count;
            let read = parser.read_payload_for_element(reader, &some, self.header);
            read.map_err(|error| self.unread(&error))?.into_iter().try_for_each(&mut take)?;
        }
        Ok(())
    }

    fn pass_over<R: BufRead>(&self, reader: &mut Reader<R>) -> Result<(), Unread> {
        self.each(reader, |_: MeshElement| Ok(()))
    }

    fn unread(&self, error: &ParseError) -> Unread {
        if let Some(stop) = self.stopped.get() {
            return stop.into();
        }
        let problem = match error.kind() {
            ErrorKind::UnexpectedEof => {
                let name: String = self.element.name.chars().take(40).collect();
                format!("it ends before the last of {} elements \"{name}\"", self.element.count)
            }
            _ => short(error),
        };
        let words = format!("its contents do not match its header ({problem}): the file may be cut off");
        (Place::Header, words).into()
    }
}

/// The first words of what the library says, which may be whole lines of the file.
fn short(error: &ParseError) -> String {
    let words = error.to_string();
    let first = words.lines().next().unwrap_or_default();
    first.chars().filter(|c| !c.is_control()).take(160).collect::<String>().trim_end_matches('.').to_owned()
}

/// The bytes of a file, which ask whether to go on each time the parser looks for more of them.
struct Asking<'a, 'm, R> {
    bytes: R,
    pulse: &'a mut Pulse<'m>,
    /// The wish to stop, for which the parser's own errors have no place.
    stopped: &'a Cell<Option<Cancelled>>,
}

impl<R: BufRead> Read for Asking<'_, '_, R> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        self.ask()?;
        self.bytes.read(into)
    }
}

impl<R: BufRead> BufRead for Asking<'_, '_, R> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        self.ask()?;
        self.bytes.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.bytes.consume(amount);
    }
}

impl<R> Asking<'_, '_, R> {
    fn ask(&mut self) -> std::io::Result<()> {
        self.pulse.beat().map_err(|stop| {
            self.stopped.set(Some(stop));
            std::io::Error::other(stop)
        })
    }
}

/// A file with its header as the library reads it.
struct File<'a> {
    /// The header; its lines end as on Unix, and its comments, which may be in any encoding, are empty.
    header: String,
    body: std::borrow::Cow<'a, [u8]>,
}

impl<'a> File<'a> {
    fn split(bytes: &'a [u8]) -> Result<Self, Problem> {
        let first_end = bytes.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(bytes.len());
        let is_old_macintosh =
            bytes.get(first_end) == Some(&b'\r') && bytes.get(first_end + 1) != Some(&b'\n');
        let end = if is_old_macintosh { b'\r' } else { b'\n' };
        let (mut header, mut length) = (String::new(), 0);
        for line in bytes.split_inclusive(|b| *b == end) {
            length += line.len();
            let content = String::from_utf8_lossy(line.trim_ascii());
            let is_comment = ["comment", "obj_info"].iter().any(|word| content.starts_with(word));
            header.push_str(if is_comment { "comment" } else { &content });
            header.push('\n');
            if content == "end_header" {
                let body = &bytes[length..];
                let is_text = header.lines().any(|line| line.starts_with("format ascii"));
                let body = if is_old_macintosh && is_text {
                    body.iter().map(|b| if *b == b'\r' { b'\n' } else { *b }).collect()
                } else {
                    body.into()
                };
                return Ok(Self { header, body });
            }
        }
        Err((Place::Header, "it does not end: the line `end_header` is missing".into()))
    }

    /// The header, and a reader of the elements behind it, which ends where the user stops it.
    fn opened<'r>(
        &'r self,
        pulse: &'r mut Pulse<'_>,
        stopped: &'r Cell<Option<Cancelled>>,
    ) -> Result<(Reader<impl BufRead + 'r>, Header), Problem> {
        check_names(&self.header)?;
        let bytes = self.header.as_bytes().chain(&self.body[..]);
        let mut reader = Reader::new(Asking { bytes, pulse, stopped });
        let header = Parser::<MeshElement>::new().read_header(&mut reader);
        let header = header.map_err(|e| (Place::Header, format!("it cannot be read: {}", short(&e))))?;
        Ok((reader, header))
    }
}

/// Refuses names that are there twice, of which the library would keep one.
fn check_names(header: &str) -> Result<(), Problem> {
    let mut elements = BTreeSet::new();
    let mut properties = BTreeSet::new();
    for (index, line) in header.lines().enumerate() {
        let mut words = line.split_whitespace();
        let is_new = match words.next() {
            Some("element") => {
                properties.clear();
                words.next().is_none_or(|name| elements.insert(name))
            }
            Some("property") => words.next_back().is_none_or(|name| properties.insert(name)),
            _ => true,
        };
        if !is_new {
            return Err((Place::Line(index + 1), "its name is there twice".into()));
        }
    }
    Ok(())
}

/// Vertices must have coordinates, and faces their vertices.
fn check_elements(header: &Header) -> Result<(), Problem> {
    let element = |name: &str, what: &str| {
        header.elements.get(name).ok_or_else(|| (Place::Header, format!("it has no {what}")))
    };
    let (vertex, face) = (element("vertex", "vertices")?, element("face", "faces")?);
    for name in ["x", "y", "z"] {
        let property = vertex.properties.get(name).map(|property| &property.data_type);
        if !matches!(property, Some(PropertyType::Scalar(_))) {
            return Err((Place::Header, format!("its vertices have no coordinate {name}")));
        }
    }
    let is_list = |name: &str| {
        let property = face.properties.get(name).map(|property| &property.data_type);
        let is_whole = |t: &ScalarType| !matches!(t, ScalarType::Float | ScalarType::Double);
        matches!(property, Some(PropertyType::List(_, of)) if is_whole(of))
    };
    if CORNERS.into_iter().any(is_list) {
        Ok(())
    } else {
        Err((Place::Header, "its faces have no list vertex_indices of whole numbers".into()))
    }
}

/// The elements announced must fit into the file, so that a small file cannot ask for much memory or time.
fn check_sizes(header: &Header, bytes: usize) -> Result<(), Problem> {
    let mut least = 0_u64;
    for (name, element) in &header.elements {
        let size = least_size(element, header.encoding);
        if size == 0 && element.count > 0 {
            let name: String = name.chars().take(40).collect();
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
        // An empty list is its length alone.
        PropertyType::List(length, _) => size(length),
    };
    element.properties.iter().map(|(_, p)| property(&p.data_type)).sum()
}

/// The numbers of an element; lists are left out.
struct Row(Vec<f64>);

impl PropertyAccess for Row {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, _: &str, property: Property) -> PropertyAccessResult {
        let Some(value) = scalar(&property) else { return PropertyAccessResult::Ignored };
        self.0.push(value);
        PropertyAccessResult::Set
    }
}

/// The properties of an element that a mesh needs: a vertex's place, a face's vertices.
#[derive(Default)]
struct MeshElement {
    place: [f64; 3],
    /// The vertices of a face; `None` where there is no list of them, or where one is negative.
    corners: Option<Vec<u32>>,
}

impl PropertyAccess for MeshElement {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if CORNERS.contains(&name) {
            self.corners = corners(property);
            return PropertyAccessResult::Set;
        }
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == name);
        let Some((axis, value)) = axis.zip(scalar(&property)) else { return PropertyAccessResult::Ignored };
        self.place[axis] = value;
        PropertyAccessResult::Set
    }
}

/// The vertex numbers of a list; `None` where one is negative, or no whole number.
fn corners(list: Property) -> Option<Vec<u32>> {
    match list {
        Property::ListChar(x) => x.iter().map(|&v| u32::try_from(v).ok()).collect(),
        Property::ListUChar(x) => Some(x.iter().map(|&v| u32::from(v)).collect()),
        Property::ListShort(x) => x.iter().map(|&v| u32::try_from(v).ok()).collect(),
        Property::ListUShort(x) => Some(x.iter().map(|&v| u32::from(v)).collect()),
        Property::ListInt(x) => x.iter().map(|&v| u32::try_from(v).ok()).collect(),
        Property::ListUInt(x) => Some(x),
        _ => None,
    }
}

/// A number of any type; `None` for a list.
fn scalar(property: &Property) -> Option<f64> {
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

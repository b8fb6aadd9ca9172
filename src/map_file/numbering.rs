//! Places between a mesh and the numbers of its file.

use super::container::{Container, Sections, fault};
use super::error::{MapFileError, SectionProblem};
use super::file_mesh::FileMesh;
use crate::mesh::{FaceId, HalfedgeId, Place, SurfacePoint};
use glam::DMat2;

/// The number that stands for the kind of a place in a file: here a vertex.
const VERTEX: u8 = 0;
/// The kind of a point of an edge.
const EDGE: u8 = 1;
/// The kind of a point inside a face.
const FACE: u8 = 2;

/// The largest difference of a sum of weights from 1.
const WEIGHT_SUM: f64 = 1e-9;

/// Places as three arrays.
#[derive(Default)]
struct PlaceArrays {
    kinds: Vec<u8>,
    elements: Vec<u32>,
    parameters: Vec<f64>,
}

/// Writes places of a mesh as the sections `NAME.kinds`, `NAME.elements` and `NAME.parameters`.
pub(super) fn write_places(
    sections: &mut Sections,
    name: &str,
    mesh: &FileMesh,
    places: impl Iterator<Item = Place>,
) {
    let mut arrays = PlaceArrays::default();
    places.for_each(|place| arrays.push(mesh, place));
    sections.bytes(&format!("{name}.kinds"), &arrays.kinds);
    sections.integers(&format!("{name}.elements"), &arrays.elements);
    sections.numbers(&format!("{name}.parameters"), &arrays.parameters);
}

impl PlaceArrays {
    fn push(&mut self, mesh: &FileMesh, place: Place) {
        match place {
            Place::Vertex(v) => {
                self.kinds.push(VERTEX);
                self.elements.push(mesh.vertex_number(v) as u32);
            }
            Place::Edge { halfedge, along } => {
                let corner = halfedge.corner();
                // Where weights 1 and 2 are exchanged, the side from corner k to corner k + 1 runs the other way.
                let (corner, along) = if mesh.is_exchanged(halfedge.face()) {
                    (exchanged_side(corner), 1.0 - along)
                } else {
                    (corner, along)
                };
                self.kinds.push(EDGE);
                self.elements.push(HalfedgeId::of(halfedge.face(), corner).0);
                self.parameters.push(along);
            }
            Place::Face(point) => {
                let SurfacePoint { face, barycentric } = mesh.on_file(point);
                self.kinds.push(FACE);
                self.elements.push(face.0);
                self.parameters.extend(barycentric);
            }
        }
    }
}

/// The side with the same ends once corners 1 and 2 are exchanged: 01, 12, 20 become 20, 12, 01.
fn exchanged_side(corner: usize) -> usize {
    2 - corner
}

/// Reads places of a mesh.
pub(super) fn read_places(
    container: &Container<'_>,
    name: &str,
    mesh: &FileMesh,
) -> Result<Vec<Place>, MapFileError> {
    let [kinds_name, elements_name, parameters_name] =
        ["kinds", "elements", "parameters"].map(|part| format!("{name}.{part}"));
    let kinds = container.bytes(&kinds_name)?;
    let elements = container.integers(&elements_name)?;
    let parameters = container.numbers(&parameters_name)?;
    expect_count(&elements_name, elements.len(), kinds.len())?;
    let wanted = kinds.iter().map(|&kind| parameters_of(kind)).sum();
    expect_count(&parameters_name, parameters.len(), wanted)?;
    let mut rest = &parameters[..];
    let mut places = Vec::with_capacity(kinds.len());
    for (index, (&kind, &element)) in kinds.iter().zip(&elements).enumerate() {
        if kind > FACE {
            let problem = SectionProblem::Range { value: kind.into(), limit: u64::from(FACE) + 1 };
            return Err(fault(&kinds_name, Some(index), problem));
        }
        let (here, onwards) = rest.split_at(parameters_of(kind));
        rest = onwards;
        let place = place(mesh, kind, element, here).map_err(|problem| {
            let is_parameter = matches!(problem, SectionProblem::Weights);
            fault(if is_parameter { &parameters_name } else { &elements_name }, Some(index), problem)
        })?;
        places.push(place);
    }
    Ok(places)
}

/// The number of parameters of a place of a kind.
fn parameters_of(kind: u8) -> usize {
    match kind {
        EDGE => 1,
        FACE => 3,
        _ => 0,
    }
}

fn place(mesh: &FileMesh, kind: u8, element: u32, parameters: &[f64]) -> Result<Place, SectionProblem> {
    let surface = mesh.mesh();
    let below = |limit: usize| {
        let problem = SectionProblem::Range { value: element.into(), limit: limit as u64 };
        if (element as usize) < limit { Ok(()) } else { Err(problem) }
    };
    match (kind, parameters) {
        (EDGE, &[along]) => {
            below(3 * surface.face_count())?;
            if !(0.0..=1.0).contains(&along) {
                return Err(SectionProblem::Weights);
            }
            let halfedge = HalfedgeId(element);
            let (corner, along) = if mesh.is_exchanged(halfedge.face()) {
                (exchanged_side(halfedge.corner()), 1.0 - along)
            } else {
                (halfedge.corner(), along)
            };
            Ok(Place::on_edge(surface, HalfedgeId::of(halfedge.face(), corner), along))
        }
        (FACE, &[u, v, w]) => {
            below(surface.face_count())?;
            let barycentric = [u, v, w];
            let sum: f64 = barycentric.iter().sum();
            if !(barycentric.iter().all(|w| *w >= 0.0) && (sum - 1.0).abs() <= WEIGHT_SUM) {
                return Err(SectionProblem::Weights);
            }
            Ok(Place::Face(mesh.on_mesh(SurfacePoint { face: FaceId(element), barycentric })))
        }
        _ => {
            let numbers = &mesh.checked().vertex_from_file;
            below(numbers.len())?;
            let known = numbers[element as usize];
            known.map(Place::Vertex).ok_or(SectionProblem::UnusedVertex { vertex: element })
        }
    }
}

/// A piece's matrix with weights 1 and 2 exchanged where the file has them so; its own inverse.
pub(super) fn exchanged_matrix(meshes: [&FileMesh; 2], faces: [FaceId; 2], matrix: DMat2) -> DMat2 {
    let exchange = DMat2::from_cols(glam::DVec2::Y, glam::DVec2::X);
    let [from, onto] = [0, 1].map(|k| meshes[k].is_exchanged(faces[k]));
    let matrix = if from { matrix * exchange } else { matrix };
    if onto { exchange * matrix } else { matrix }
}

/// Whether a section has as many elements as it should.
pub(super) fn expect_count(section: &str, found: usize, expected: usize) -> Result<(), MapFileError> {
    if found == expected {
        return Ok(());
    }
    Err(fault(section, None, SectionProblem::Count { found, expected }))
}

/// Whether all numbers of a section are below a limit.
pub(super) fn expect_below(section: &str, values: &[u32], limit: usize) -> Result<(), MapFileError> {
    match values.iter().position(|&x| x as usize >= limit) {
        Some(index) => {
            let problem = SectionProblem::Range { value: values[index].into(), limit: limit as u64 };
            Err(fault(section, Some(index), problem))
        }
        None => Ok(()),
    }
}

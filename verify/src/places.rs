//! The places of the overlay's vertices on one mesh.

use crate::container::{Container, expect_count};
use crate::exact::{LARGEST, Weight, Weights};
use crate::mesh::Mesh;
use crate::refusal::{Refusal, Side};

/// The largest difference of a sum of weights from 1: the rounding of a program that divided by their sum.
const SUM: f64 = 1e-9;

/// A point of a mesh, by its file's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A vertex; of joined ones the first.
    Vertex(u32),
    /// A point of the edge between two vertices, and the weights of both.
    Edge([u32; 2], [Weight; 2]),
    /// A point inside a face.
    Face(u32, [f64; 3]),
}

impl Place {
    /// The weights of a face's corners at this place; `None` where the face does not hold it.
    pub fn weights_in(&self, mesh: &Mesh<'_>, face: u32) -> Option<Weights> {
        let corners = mesh.corners(face)?;
        let at = |v: u32| corners.iter().position(|&c| c == v);
        let mut weights = Weights::default();
        match *self {
            Self::Vertex(v) => weights[at(v)?] = Weight::new(1.0),
            Self::Edge(ends, parts) => {
                weights[at(ends[0])?] = parts[0];
                weights[at(ends[1])?] = parts[1];
            }
            Self::Face(f, values) if f == face => weights = values.map(Weight::new),
            Self::Face(..) => return None,
        }
        Some(weights)
    }
}

/// Reads the places of all overlay vertices on one mesh.
pub fn read(container: &Container<'_>, mesh: &Mesh<'_>, side: Side) -> Result<Vec<Place>, Refusal> {
    let [kinds_name, elements_name, parameters_name] =
        ["kinds", "elements", "parameters"].map(|part| format!("vertices.{side}.{part}"));
    let kinds = container.bytes(&kinds_name)?;
    let elements = container.integers(&elements_name)?;
    let parameters = container.numbers(&parameters_name)?;
    expect_count(&elements_name, elements.len(), kinds.len())?;
    let mut reader = Reader { mesh, side, rest: &parameters };
    let places = kinds.iter().zip(&elements).enumerate();
    let places = places.map(|(vertex, (&kind, &element))| reader.place(vertex, kind, element));
    let places: Vec<Place> = places.collect::<Result<_, _>>()?;
    expect_count(&parameters_name, parameters.len(), parameters.len() - reader.rest.len())?;
    Ok(places)
}

struct Reader<'a> {
    mesh: &'a Mesh<'a>,
    side: Side,
    /// The parameters of the places that are still to come.
    rest: &'a [f64],
}

impl Reader<'_> {
    fn place(&mut self, vertex: usize, kind: u8, element: u32) -> Result<Place, Refusal> {
        let side = self.side;
        let nothing = |what: String| Refusal::NoPlace { vertex, side, what };
        match kind {
            0 => {
                let known = self.mesh.vertex(element);
                known
                    .map(Place::Vertex)
                    .ok_or_else(|| nothing(format!("vertex {element}, which no face has")))
            }
            1 => {
                let along = self.next::<1>(vertex)?[0];
                let corners = self.mesh.corners(element / 3);
                let corners = corners.ok_or_else(|| nothing(format!("side {element}, which no face has")))?;
                if !(0.0..=1.0).contains(&along) {
                    return Err(Refusal::BesideEdge { vertex, side, along });
                }
                let k = element as usize % 3;
                let ends = [corners[k], corners[(k + 1) % 3]];
                Ok(Place::Edge(ends, [Weight::rest(along), Weight::new(along)]))
            }
            2 => {
                let weights = self.next::<3>(vertex)?;
                if element as usize >= self.mesh.face_count() {
                    return Err(nothing(format!("face {element}, which does not exist")));
                }
                let is_one = (weights.iter().sum::<f64>() - 1.0).abs() <= SUM;
                if !is_one || weights.iter().any(|w| !(0.0..=LARGEST).contains(w)) {
                    return Err(Refusal::Weights { vertex, side, weights });
                }
                Ok(Place::Face(element, weights))
            }
            _ => Err(nothing(format!("something of kind {kind}, which is none"))),
        }
    }

    fn next<const N: usize>(&mut self, vertex: usize) -> Result<[f64; N], Refusal> {
        let Some((parameters, rest)) = self.rest.split_first_chunk::<N>() else {
            let what = "parameters that the file does not have".to_owned();
            return Err(Refusal::NoPlace { vertex, side: self.side, what });
        };
        self.rest = rest;
        Ok(*parameters)
    }
}

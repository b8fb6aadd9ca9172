//! Why a soup is not a closed surface of genus 0, in words.

use serde::Serialize;
use std::fmt;

/// Elements at fault: their number, and the first few of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Elements<T> {
    /// The number of elements.
    pub count: usize,
    /// At most ten of the elements, in the file's 0-based numbers.
    pub first: Vec<T>,
}

impl<T> Elements<T> {
    /// No elements at all.
    pub(in crate::mesh) fn none() -> Self {
        Self { count: 0, first: Vec::new() }
    }

    /// These elements and others.
    pub(in crate::mesh) fn and(mut self, other: Self) -> Self {
        self.count += other.count;
        self.first.extend(other.first);
        self.first.truncate(10);
        self
    }
}

impl<T> FromIterator<T> for Elements<T> {
    fn from_iter<I: IntoIterator<Item = T>>(all: I) -> Self {
        let mut elements = Self::none();
        for element in all {
            elements.count += 1;
            if elements.first.len() < 10 {
                elements.first.push(element);
            }
        }
        elements
    }
}

/// Why a soup is not a closed surface of genus 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFault {
    /// The soup has no faces.
    #[error("the mesh has no faces")]
    Empty,
    /// Some faces have a repeated vertex or no area.
    #[error("{} without area ({}): remove degenerate faces or merge their vertices", Count::new(&.0.count, "face is", "faces are"), List("face", &.0.first))]
    DegenerateFaces(Elements<usize>),
    /// Some edges have three or more faces.
    #[error(
        "{} more than two faces ({}){}: separate or remove the extra faces there",
        Count::new(&.edges.count, "edge has", "edges have"),
        Edges(&.edges.first),
        Parts(*.parts)
    )]
    NonManifoldEdges {
        /// The edges with more than two faces.
        edges: Elements<[usize; 2]>,
        /// The number of parts into which the surface falls when it is cut along these edges.
        parts: usize,
    },
    /// Some edges have one face.
    #[error("the surface is open: {} only one face ({}): close the holes", Count::new(&.0.count, "edge has", "edges have"), Edges(&.0.first))]
    OpenEdges(Elements<[usize; 2]>),
    /// Neighbouring faces cannot be oriented alike.
    #[error("the surface cannot be oriented: it is one-sided near edge {}-{}", edge[0], edge[1])]
    NotOrientable {
        /// The vertices of the edge between them.
        edge: [usize; 2],
    },
    /// Several fans of faces touch at some vertices.
    #[error("at {} of the surface only touch ({}): split the vertex into one per part", Count::new(&.0.count, "vertex several parts", "vertices several parts"), List("vertex", &.0.first))]
    PinchedVertices(Elements<usize>),
    /// The surface has several components.
    #[error("the mesh has {} separate parts (largest first: {} faces): keep only one of them", .faces.len(), Sizes(.faces))]
    Components {
        /// The number of faces of each component, the largest first.
        faces: Vec<usize>,
    },
    /// The surface has handles.
    #[error("the surface has {genus} handle{} (genus {genus}): only surfaces without handles, like a sphere, can be mapped; cut and close the handles", if *.genus == 1 { "" } else { "s" })]
    Genus {
        /// Number of handles.
        genus: usize,
    },
    /// The surface has fewer faces than any body.
    #[error("the mesh has {faces} faces; a surface that can be mapped has four at least")]
    TooFewFaces {
        /// The number of faces.
        faces: usize,
    },
    /// The file says more faces than fit.
    #[error("the mesh has {faces} faces; the limit is {MAX_FACES}")]
    TooManyFaces {
        /// The number of faces.
        faces: usize,
    },
}

impl MeshFault {
    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Empty => "empty",
            Self::DegenerateFaces(_) => "degenerate_faces",
            Self::NonManifoldEdges { .. } => "non_manifold_edges",
            Self::OpenEdges(_) => "open_edges",
            Self::NotOrientable { .. } => "not_orientable",
            Self::PinchedVertices(_) => "pinched_vertices",
            Self::Components { .. } => "components",
            Self::Genus { .. } => "genus",
            Self::TooFewFaces { .. } => "too_few_faces",
            Self::TooManyFaces { .. } => "too_many_faces",
        }
    }
}

/// The largest number of faces; a soup with more is refused.
pub const MAX_FACES: usize = 20_000_000;

pub(in crate::mesh) struct Count(usize, &'static str, &'static str);

impl Count {
    pub(in crate::mesh) fn new(count: &usize, one: &'static str, many: &'static str) -> Self {
        Self(*count, one, many)
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.0, if self.0 == 1 { self.1 } else { self.2 })
    }
}

struct List<'a>(&'static str, &'a [usize]);

impl fmt::Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers: Vec<_> = self.1.iter().map(usize::to_string).collect();
        write!(f, "{} {}", self.0, numbers.join(", "))
    }
}

struct Edges<'a>(&'a [[usize; 2]]);

impl fmt::Display for Edges<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pairs: Vec<_> = self.0.iter().map(|[a, b]| format!("{a}-{b}")).collect();
        write!(f, "between vertices {}", pairs.join(", "))
    }
}

struct Parts(usize);

impl fmt::Display for Parts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 > 1 { write!(f, ", where {} separate parts meet", self.0) } else { Ok(()) }
    }
}

struct Sizes<'a>(&'a [usize]);

impl fmt::Display for Sizes<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sizes: Vec<_> = self.0.iter().take(10).map(usize::to_string).collect();
        f.write_str(&sizes.join(", "))
    }
}

//! Why a map file cannot be used.

use crate::landmarks::MeshSide;
use crate::surface_map::correspondence::CorrespondenceFault;

/// Why a map file cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// The file is no map file.
    #[error("this is not a map file: it does not begin with \"CONEMAP\"")]
    NotAMapFile,
    /// The file is too large.
    #[error("the map file holds {bytes} bytes; the limit is {}", crate::io::MAX_BYTES)]
    TooLarge {
        /// The size of the file, or that of its unpacked sections, in bytes.
        bytes: u64,
    },
    /// The file has a version that is not known.
    #[error(
        "the map file has version {major}, but this program reads version {}: use a newer program",
        super::version::MAJOR
    )]
    Version {
        /// The major version of the file.
        major: u16,
    },
    /// Something that this program does not know is needed to read it.
    #[error("the map file needs \"{what}\", which this program does not know: use a newer program")]
    Needs {
        /// The feature that is needed, by its name in the file.
        what: String,
    },
    /// The file is shorter than it says.
    #[error("the map file is cut off: it has {bytes} bytes and should have at least {needed}")]
    CutOff {
        /// The size of the file in bytes.
        bytes: usize,
        /// The size that its header tells.
        needed: u64,
    },
    /// The header is not as it should be.
    #[error("the map file's header: {problem}")]
    Header {
        /// The problem.
        problem: String,
    },
    /// A section is not as it should be.
    #[error("the map file, section \"{section}\"{}: {problem}", At(*.index))]
    Section {
        /// The name of the section.
        section: String,
        /// The element at fault, 0-based; `None` where it is the section as a whole.
        index: Option<usize>,
        /// The problem.
        problem: SectionProblem,
    },
    /// The pieces are no map.
    #[error("the map file: {0}")]
    NoMap(#[from] CorrespondenceFault),
    /// The map file was made with another mesh.
    #[error(
        "this is not the {side} that the map file was made with (the file's SHA-256 is {found}, the map's {wanted})"
    )]
    OtherMesh {
        /// The mesh that is another one.
        side: MeshSide,
        /// The hash of the file that was given.
        found: String,
        /// The hash that the map file tells.
        wanted: String,
    },
}

impl MapFileError {
    /// A stable code for programs and for the page's sentences.
    pub fn code(&self) -> &'static str {
        match self {
            Self::OtherMesh { .. } => "other-meshes",
            Self::Version { .. } | Self::Needs { .. } => "map-version",
            _ => "map-file",
        }
    }
}

struct At(Option<usize>);

impl std::fmt::Display for At {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.map_or(Ok(()), |index| write!(f, ", element {index}"))
    }
}

/// The problem of a section.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionProblem {
    /// The section is not there.
    #[error("it is missing")]
    Missing,
    /// The section is there twice.
    #[error("it is there twice")]
    Twice,
    /// The elements have another type.
    #[error("its elements have the wrong type")]
    Type,
    /// The section does not lie within the file.
    #[error("it does not lie within the file")]
    Outside,
    /// The length does not fit.
    #[error("it has {found} elements and should have {expected}")]
    Count {
        /// The length that was found.
        found: usize,
        /// The length that is expected.
        expected: usize,
    },
    /// The section cannot be unpacked.
    #[error("it cannot be unpacked: the file may be damaged")]
    Packed,
    /// A number is too large.
    #[error("{value} is not below {limit}")]
    Range {
        /// The number.
        value: u64,
        /// The first number that is too large.
        limit: u64,
    },
    /// A vertex is one that no face uses.
    #[error("vertex {vertex} is used by no face")]
    UnusedVertex {
        /// The number of the vertex in the file.
        vertex: u32,
    },
    /// Some numbers are no barycentric weights.
    #[error("its weights are negative or do not sum to 1")]
    Weights,
    /// A number is not finite or not positive.
    #[error("{value} is no usable number")]
    Number {
        /// The number.
        value: f64,
    },
    /// The base domain is no sphere.
    #[error("its triangles are no closed surface without handles")]
    Base,
    /// A piece has no matrix.
    #[error("piece {piece} is too thin to tell its matrix, and none is given")]
    NoMatrix {
        /// The number of the piece.
        piece: usize,
    },
    /// Too many texture triangles lie in faces that have many pieces.
    #[error("triangles and pieces that share faces make {pairs} pairs; the limit is {limit}")]
    Crowded {
        /// Number of pairs of a triangle and a piece.
        pairs: u64,
        /// The largest number of pairs.
        limit: u64,
    },
    /// The section is not the text that it should be.
    #[error("it is not JSON")]
    Json,
}

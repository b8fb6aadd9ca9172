//! Why a map file cannot be used.

use crate::landmarks::MeshSide;
use crate::surface_map::correspondence::CorrespondenceFault;

/// Why a map file cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// No map file.
    #[error("this is not a map file: it does not begin with \"CONEMAP\"")]
    NotAMapFile,
    /// Too large.
    #[error("the map file holds {bytes} bytes; the limit is {}", crate::io::MAX_BYTES)]
    TooLarge {
        /// Its size, or that of its unpacked sections.
        bytes: u64,
    },
    /// A version that is not known.
    #[error(
        "the map file has version {major}, but this program reads version {}: use a newer program",
        super::version::MAJOR
    )]
    Version {
        /// The file's major version.
        major: u16,
    },
    /// Something that this program does not know is needed to read it.
    #[error("the map file needs \"{what}\", which this program does not know: use a newer program")]
    Needs {
        /// What.
        what: String,
    },
    /// Shorter than it says.
    #[error("the map file is cut off: it has {bytes} bytes and should have at least {needed}")]
    CutOff {
        /// Its size.
        bytes: usize,
        /// What its header tells.
        needed: u64,
    },
    /// The header is not as it should be.
    #[error("the map file's header: {problem}")]
    Header {
        /// What is wrong.
        problem: String,
    },
    /// A section is not as it should be.
    #[error("the map file, section \"{section}\"{}: {problem}", At(*.index))]
    Section {
        /// Its name.
        section: String,
        /// The element at fault, 0-based; `None` where it is the section as a whole.
        index: Option<usize>,
        /// What is wrong.
        problem: SectionProblem,
    },
    /// The pieces are no map.
    #[error("the map file: {0}")]
    NoMap(#[from] CorrespondenceFault),
    /// Made with another mesh.
    #[error(
        "this is not the {side} that the map file was made with (the file's SHA-256 is {found}, the map's {wanted})"
    )]
    OtherMesh {
        /// Which mesh.
        side: MeshSide,
        /// Hash of the file that was given.
        found: String,
        /// Hash that the map file tells.
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

/// What is wrong with a section.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionProblem {
    /// It is not there.
    #[error("it is missing")]
    Missing,
    /// It is there twice.
    #[error("it is there twice")]
    Twice,
    /// Elements of another type.
    #[error("its elements have the wrong type")]
    Type,
    /// Not within the file.
    #[error("it does not lie within the file")]
    Outside,
    /// A length that does not fit.
    #[error("it has {found} elements and should have {expected}")]
    Count {
        /// As it is.
        found: usize,
        /// As it should be.
        expected: usize,
    },
    /// It cannot be unpacked.
    #[error("it cannot be unpacked: the file may be damaged")]
    Packed,
    /// A number that is too large.
    #[error("{value} is not below {limit}")]
    Range {
        /// The number.
        value: u64,
        /// The limit.
        limit: u64,
    },
    /// A vertex that no face uses.
    #[error("vertex {vertex} is used by no face")]
    UnusedVertex {
        /// The vertex of the file.
        vertex: u32,
    },
    /// Numbers that are no weights.
    #[error("its weights are negative or do not sum to 1")]
    Weights,
    /// A number that is not finite or not positive.
    #[error("{value} is no usable number")]
    Number {
        /// The number.
        value: f64,
    },
    /// A base domain that is no sphere.
    #[error("its triangles are no closed surface without handles")]
    Base,
    /// A piece without a matrix.
    #[error("piece {piece} is too thin to tell its matrix, and none is given")]
    NoMatrix {
        /// The piece.
        piece: usize,
    },
    /// Too many texture triangles in faces that have many pieces.
    #[error("triangles and pieces that share faces make {pairs} pairs; the limit is {limit}")]
    Crowded {
        /// Pairs of a triangle and a piece.
        pairs: u64,
        /// The limit.
        limit: u64,
    },
    /// Not the text that it should be.
    #[error("it is not JSON")]
    Json,
}

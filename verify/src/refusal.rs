//! The reasons for which a map is not accepted.

use crate::mesh::MeshProblem;
use std::fmt;

/// One of both meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The mesh that the map goes from.
    Source,
    /// The mesh that it goes onto.
    Target,
}

impl Side {
    /// Both sides, the source first.
    pub const BOTH: [Self; 2] = [Self::Source, Self::Target];
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Source => "source",
            Self::Target => "target",
        })
    }
}

/// The first reason why a map is not accepted. Vertices, faces and corners of meshes are the files' own, from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The bytes are no whole map file of a known version.
    #[error("the map file cannot be read: {problem}")]
    File {
        /// What is wrong.
        problem: String,
    },
    /// An array is missing or has another length, type or packing than the format says.
    #[error("section \"{section}\" of the map file: {problem}")]
    Section {
        /// The section's name.
        section: String,
        /// What is wrong.
        problem: String,
    },
    /// A mesh is no sphere.
    #[error("the {side} is no closed surface without handles: {problem}")]
    Mesh {
        /// The mesh at fault.
        side: Side,
        /// The reason.
        problem: MeshProblem,
    },
    /// The map was made with another mesh.
    #[error(
        "the {side} is not the mesh that the map was made with: its SHA-256 is {found}, and the map file says {wanted}"
    )]
    OtherMesh {
        /// The mesh that is another one.
        side: Side,
        /// The hash of its arrays.
        found: String,
        /// The hash that the map file has.
        wanted: String,
    },
    /// A place names a vertex, edge or face that does not exist, or is of no known kind.
    #[error("the place of overlay vertex {vertex} on the {side} names {what}")]
    NoPlace {
        /// The overlay vertex.
        vertex: usize,
        /// The mesh on which the vertex lies.
        side: Side,
        /// What does not exist.
        what: String,
    },
    /// A parameter of a point on an edge is not in [0, 1].
    #[error("overlay vertex {vertex} lies at {along} of an edge of the {side}, not between 0 and 1")]
    BesideEdge {
        /// The overlay vertex.
        vertex: usize,
        /// The mesh on which the vertex lies.
        side: Side,
        /// The parameter.
        along: f64,
    },
    /// Barycentric coordinates are negative or do not sum to 1.
    #[error(
        "overlay vertex {vertex} has the weights {weights:?} on the {side}: negative, or their sum is not 1"
    )]
    Weights {
        /// The overlay vertex.
        vertex: usize,
        /// The mesh on which the vertex lies.
        side: Side,
        /// The weights.
        weights: [f64; 3],
    },
    /// A piece has too few or too many corners, or one of them twice.
    #[error("piece {piece} has {problem}")]
    Corners {
        /// The piece.
        piece: usize,
        /// What is wrong.
        problem: String,
    },
    /// A corner lies elsewhere than its piece.
    #[error("corner {vertex} of piece {piece} does not lie in face {face} of the {side}, as the piece does")]
    Elsewhere {
        /// The piece.
        piece: usize,
        /// The overlay vertex.
        vertex: u32,
        /// The mesh on which the corner lies.
        side: Side,
        /// The face of the piece.
        face: u32,
    },
    /// A side of a piece has no partner.
    #[error("piece {piece} ends at the side from overlay vertex {} to {}: no piece runs it the other way", ends[0], ends[1])]
    Gap {
        /// The piece.
        piece: u32,
        /// The side's start and end.
        ends: [u32; 2],
    },
    /// A side is run twice in the same direction.
    #[error("pieces {} and {} both run the side from overlay vertex {} to {}: they lie over each other", pieces[0], pieces[1], ends[0], ends[1])]
    Overlap {
        /// Both pieces.
        pieces: [u32; 2],
        /// The side's start and end.
        ends: [u32; 2],
    },
    /// A vertex belongs to no piece.
    #[error("overlay vertex {vertex} is a corner of no piece")]
    Unused {
        /// The overlay vertex.
        vertex: usize,
    },
    /// The pieces are several parts.
    #[error("the pieces fall into several parts: {reached} of {pieces} hang together")]
    Parts {
        /// The number of pieces that hang together with the first one.
        reached: usize,
        /// The number of all pieces.
        pieces: usize,
    },
    /// The pieces are no sphere.
    #[error("the pieces are no sphere: V - E + F is {euler} instead of 2")]
    NotASphere {
        /// V - E + F.
        euler: i64,
    },
    /// A piece is turned over, and not by rounding.
    #[error("piece {piece} is turned over on the {side}, by {share:.1e} of its face")]
    Turned {
        /// The piece.
        piece: usize,
        /// The mesh on which the piece is turned over.
        side: Side,
        /// The share of its face that the triangle covers which is turned over.
        share: f64,
    },
    /// A face is covered not at all, or several times.
    #[error("the pieces cover face {face} of the {side} {times} times instead of once")]
    Covered {
        /// The face.
        face: usize,
        /// The mesh of the face.
        side: Side,
        /// The number of times that the face is covered.
        times: i64,
    },
    /// No point was found at which the cover could be counted: all tried ones lie on sides of pieces.
    #[error("how often the pieces cover face {face} of the {side} cannot be told")]
    Uncountable {
        /// The face.
        face: usize,
        /// The mesh of the face.
        side: Side,
    },
    /// A matrix is missing, not invertible, or does not carry its piece's corners.
    #[error("the matrix of piece {piece} {problem}")]
    Matrix {
        /// The piece.
        piece: usize,
        /// What is wrong.
        problem: String,
    },
    /// A landmark pair names what does not exist, or the map does not take one to the other.
    #[error("landmark pair {} (the first is 1) {problem}", pair + 1)]
    Landmark {
        /// The pair, from 0.
        pair: usize,
        /// What is wrong.
        problem: String,
    },
    /// The caller asked to stop.
    #[error("the check was stopped")]
    Stopped,
}

impl Refusal {
    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::File { .. } => "file",
            Self::Section { .. } => "section",
            Self::Mesh { .. } => "mesh",
            Self::OtherMesh { .. } => "other-mesh",
            Self::NoPlace { .. } => "no-place",
            Self::BesideEdge { .. } => "beside-edge",
            Self::Weights { .. } => "weights",
            Self::Corners { .. } => "corners",
            Self::Elsewhere { .. } => "elsewhere",
            Self::Gap { .. } => "gap",
            Self::Overlap { .. } => "overlap",
            Self::Unused { .. } => "unused",
            Self::Parts { .. } => "parts",
            Self::NotASphere { .. } => "not-a-sphere",
            Self::Turned { .. } => "turned",
            Self::Covered { .. } => "covered",
            Self::Uncountable { .. } => "uncountable",
            Self::Matrix { .. } => "matrix",
            Self::Landmark { .. } => "landmark",
            Self::Stopped => "stopped",
        }
    }

    /// The mesh at fault; `None` where it is the map file.
    pub fn mesh_at_fault(&self) -> Option<Side> {
        match self {
            Self::Mesh { side, .. } | Self::OtherMesh { side, .. } => Some(*side),
            _ => None,
        }
    }
}

//! Intrinsic triangulations: a Delta-complex of triangles given by its gluing, with flips and their log.
//!
//! Self-edges and multi-edges occur: an edge is never identified by its two vertices.

mod triangulation;

pub use triangulation::{IntrinsicTriangulation, Move};

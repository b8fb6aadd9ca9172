//! Pairs of vertices of two meshes.

use crate::mesh::VertexId;

/// The origin of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum PairOrigin {
    /// The pair was given, and is in every candidate.
    Given,
    /// Two ends of limbs.
    Tips,
    /// A point far from all tips, and a place of the target with nearly the same distances to the other pairs.
    Between,
}

/// A pair of vertices of the two meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MatchedPair {
    /// Vertex of the source.
    pub source: VertexId,
    /// Vertex of the target.
    pub target: VertexId,
    /// The origin of the pair.
    pub origin: PairOrigin,
}

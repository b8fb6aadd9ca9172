//! Pairs of vertices of two meshes.

use crate::mesh::VertexId;

/// Where a pair comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum PairOrigin {
    /// It was given, and is held.
    Given,
    /// Two ends of limbs.
    Tips,
    /// A point far from all tips, at a place that has the same distances to the other pairs.
    Between,
}

/// A pair of vertices of the two meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MatchedPair {
    /// Vertex of the source.
    pub source: VertexId,
    /// Vertex of the target.
    pub target: VertexId,
    /// Where the pair comes from.
    pub origin: PairOrigin,
}

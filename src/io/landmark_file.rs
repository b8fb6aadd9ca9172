//! Landmark pairs as JSON.

use serde::{Deserialize, Serialize};

/// A landmark file: `{"source", "target", "pairs": [[s, t], ...], "labels"?, "ground_truth"?}`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LandmarkFile {
    /// Path of the source mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// Path of the target mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<String>,
    /// Corresponding source and target vertices, 0-based.
    pub pairs: Vec<[u32; 2]>,
    /// One name per pair.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub labels: Option<Vec<String>>,
    /// Present when vertex i of the source truly corresponds to vertex i of the target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground_truth: Option<String>,
}

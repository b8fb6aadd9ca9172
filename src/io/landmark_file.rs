//! Landmark pairs as JSON.

use crate::mesh::mirror::mirrored_weights;
use serde::{Deserialize, Serialize};

/// More pairs than this are refused.
pub const MAX_PAIRS: usize = 10_000;

/// One side of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "a point must be a vertex number (0 or more) or {\"face\": number, \"barycentric\": [three weights]}"
)]
pub enum LandmarkPoint {
    /// A vertex, 0-based.
    Vertex(u32),
    /// A point of a face.
    OnFace {
        /// The face, 0-based.
        face: u32,
        /// Weights of its corners: not negative, sum 1.
        barycentric: [f64; 3],
    },
}

impl LandmarkPoint {
    /// The same point of the mesh's mirror image ([`crate::mesh::mirror::mirrored`]).
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Vertex(_) => self,
            Self::OnFace { face, barycentric } => {
                Self::OnFace { face, barycentric: mirrored_weights(barycentric) }
            }
        }
    }
}

/// A landmark file: `{"source"?, "target"?, "pairs": [[s, t], ...], "labels"?, "ground_truth"?}`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LandmarkFile {
    /// Path of the source mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// Path of the target mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<String>,
    /// Corresponding points of source and target.
    pub pairs: Vec<[LandmarkPoint; 2]>,
    /// One name per pair.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub labels: Option<Vec<String>>,
    /// Present when vertex i of the source truly corresponds to vertex i of the target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground_truth: Option<String>,
}

/// Why a landmark file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LandmarkFileError {
    /// Not the JSON that was expected.
    #[error(
        "the landmark file, line {line}: {problem}; it should look like \
         {{\"pairs\": [[source vertex, target vertex], ...]}}"
    )]
    Json {
        /// 1-based.
        line: usize,
        /// What the JSON reader says.
        problem: String,
    },
    /// Too many pairs.
    #[error("the landmark file has {count} pairs; the limit is {MAX_PAIRS}")]
    TooMany {
        /// How many.
        count: usize,
    },
}

/// Reads a landmark file.
///
/// # Errors
/// [`LandmarkFileError`] with the line.
pub fn read(bytes: &[u8]) -> Result<LandmarkFile, LandmarkFileError> {
    let json = |e: serde_json::Error| {
        let words = e.to_string();
        let problem = words.split(" at line ").next().unwrap_or_default().to_owned();
        LandmarkFileError::Json { line: e.line(), problem }
    };
    let file: LandmarkFile = serde_json::from_slice(bytes).map_err(json)?;
    if file.pairs.len() > MAX_PAIRS {
        return Err(LandmarkFileError::TooMany { count: file.pairs.len() });
    }
    Ok(file)
}

/// Writes a landmark file.
pub fn write(file: &LandmarkFile) -> Vec<u8> {
    serde_json::to_vec_pretty(file).unwrap_or_default()
}

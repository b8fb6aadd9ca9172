//! Landmark pairs as JSON.

use super::reading;
use crate::mesh::mirror::mirrored_weights;
use crate::mesh_side::MeshSide;
use rustc_hash::FxHashMap;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The largest number of pairs; a file with more is refused.
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
    /// A point inside a face.
    OnFace {
        /// The face, 0-based.
        face: u32,
        /// Weights of its corners: not negative, sum 1.
        barycentric: [f64; 3],
    },
}

impl LandmarkPoint {
    /// Whether the weights of a point of a face are barycentric coordinates, to the digits that files have: none below -1e-6,
    /// and a sum that is 1 to 1e-4.
    pub fn is_sound(self) -> bool {
        match self {
            Self::Vertex(_) => true,
            Self::OnFace { barycentric, .. } => {
                let sum: f64 = barycentric.iter().sum();
                barycentric.iter().all(|w| *w >= -1e-6) && (sum - 1.0).abs() < 1e-4
            }
        }
    }

    /// Equal for points that are written alike.
    fn key(self) -> (Option<u32>, [u64; 3]) {
        match self {
            Self::Vertex(v) => (None, [u64::from(v), 0, 0]),
            // Adding 0 makes -0 and 0 the same bits.
            Self::OnFace { face, barycentric } => (Some(face), barycentric.map(|w| (w + 0.0).to_bits())),
        }
    }

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

/// A landmark may be moved at most so far from where it was given, in units of the root of the target's area: about half the length of a
/// leg.
pub const MAX_RADIUS: f64 = 0.25;

/// A landmark file: `{"source"?, "target"?, "pairs": [[s, t], ...], "radii"?, "labels"?, "ground_truth"?}`.
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
    /// One radius per pair, in units of the root of the target's area: how far the point on the target may be moved from where it is
    /// given; 0 for a landmark that is held.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radii: Option<Vec<f64>>,
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
    /// The file is not the JSON that was expected.
    #[error(
        "the landmark file, line {line}: {problem}; it should look like \
         {{\"pairs\": [[source vertex, target vertex], ...]}}"
    )]
    Json {
        /// The line, 1-based.
        line: usize,
        /// The sentence of the JSON reader.
        problem: String,
    },
    /// There are too many pairs.
    #[error("the landmark file has {count} pairs; the limit is {MAX_PAIRS}")]
    TooMany {
        /// Number of pairs.
        count: usize,
    },
    /// The weights of a point are no barycentric coordinates.
    #[error(
        "landmark pair {} (the first is 1) has barycentric coordinates on the {side} that are negative or do not sum to 1: \
         {weights}",
        pair + 1
    )]
    Barycentric {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
        /// The weights as the file gives them.
        weights: String,
    },
    /// The number of radii is not that of the pairs, nor 0.
    #[error("the landmark file has {count} radii for {pairs} pairs: give one for each pair, or none")]
    RadiusCount {
        /// Number of radii.
        count: usize,
        /// Number of pairs.
        pairs: usize,
    },
    /// A radius is no distance by which a landmark may be moved.
    #[error(
        "landmark pair {} (the first is 1) has the radius {radius}: it must lie between 0 and {MAX_RADIUS} times the root of the target's \
         area",
        pair + 1
    )]
    Radius {
        /// The pair, 0-based.
        pair: usize,
        /// The radius as the file gives it.
        radius: String,
    },
    /// Two pairs have the same point.
    #[error("landmark pairs {} and {} (the first is 1) have the same point of the {side}", pairs[0] + 1, pairs[1] + 1)]
    SharedPoint {
        /// The mesh.
        side: MeshSide,
        /// The two pairs, 0-based.
        pairs: [usize; 2],
    },
}

/// The entries of a landmark file.
const ENTRIES: [&str; 6] = ["source", "target", "pairs", "radii", "labels", "ground_truth"];

/// The names of a landmark file's entries that mean nothing here, in alphabetical order: another program's, or misspelt. None where
/// the bytes are no JSON object.
pub fn unknown_entries(bytes: &[u8]) -> Vec<String> {
    let text = reading::text(bytes).unwrap_or_default();
    let entries: BTreeMap<String, IgnoredAny> = serde_json::from_str(&text).unwrap_or_default();
    entries.into_keys().filter(|name| !ENTRIES.contains(&name.as_str())).collect()
}

/// Reads a landmark file. What can be said without the meshes is checked: weights, and points that two pairs share.
///
/// # Errors
/// [`LandmarkFileError`] with the line or the pairs, the first fault of the file.
pub fn read(bytes: &[u8]) -> Result<LandmarkFile, LandmarkFileError> {
    let json = |e: serde_json::Error| {
        let words = e.to_string();
        let problem = words.split(" at line ").next().unwrap_or_default().to_owned();
        LandmarkFileError::Json { line: e.line(), problem }
    };
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let file: LandmarkFile = serde_json::from_slice(bytes).map_err(json)?;
    check(&file)?;
    Ok(file)
}

/// Checks what can be said without the meshes: the number of pairs, weights, and points that two pairs share.
///
/// # Errors
/// [`LandmarkFileError`] with the pairs, the first fault.
pub fn check(file: &LandmarkFile) -> Result<(), LandmarkFileError> {
    if file.pairs.len() > MAX_PAIRS {
        return Err(LandmarkFileError::TooMany { count: file.pairs.len() });
    }
    check_radii(file)?;
    check_points(&file.pairs)
}

fn check_radii(file: &LandmarkFile) -> Result<(), LandmarkFileError> {
    let Some(radii) = &file.radii else { return Ok(()) };
    let (count, pairs) = (radii.len(), file.pairs.len());
    if count != pairs {
        return Err(LandmarkFileError::RadiusCount { count, pairs });
    }
    let wrong = radii.iter().position(|radius| !(0.0..=MAX_RADIUS).contains(radius));
    match wrong {
        Some(pair) => Err(LandmarkFileError::Radius { pair, radius: radii[pair].to_string() }),
        None => Ok(()),
    }
}

fn check_points(pairs: &[[LandmarkPoint; 2]]) -> Result<(), LandmarkFileError> {
    let mut first: [FxHashMap<_, usize>; 2] = Default::default();
    for (pair, points) in pairs.iter().enumerate() {
        for (side, point) in MeshSide::BOTH.into_iter().zip(points) {
            if let LandmarkPoint::OnFace { barycentric, .. } = point
                && !point.is_sound()
            {
                let weights = format!("{barycentric:?}");
                return Err(LandmarkFileError::Barycentric { side, pair, weights });
            }
            if let Some(other) = first[side].insert(point.key(), pair) {
                return Err(LandmarkFileError::SharedPoint { side, pairs: [other, pair] });
            }
        }
    }
    Ok(())
}

/// Writes a landmark file.
pub fn write(file: &LandmarkFile) -> Vec<u8> {
    serde_json::to_vec_pretty(file).unwrap_or_default()
}

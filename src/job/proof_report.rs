//! What a second program says of a map, stable as JSON.

use super::proof::ProofError;
use conemap_verify::Proof;
use serde::Serialize;

/// What became of the proof of a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(tag = "verdict", rename_all = "kebab-case")]
pub enum ProofReport {
    /// Proved, every piece exactly.
    Proved(ProofFigures),
    /// Proved but for triangles that are doubtful within rounding.
    WithinRounding(ProofFigures),
    /// No map between these meshes, or not told so.
    Refused {
        /// A stable name of the reason.
        kind: String,
        /// The reason in a sentence.
        sentence: String,
    },
}

/// What was found of a map that is not refused.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct ProofFigures {
    /// The verdict in a sentence.
    pub sentence: String,
    /// Faces of both meshes.
    pub faces: FaceCounts,
    /// Overlay vertices.
    pub vertices: usize,
    /// Pieces.
    pub pieces: usize,
    /// Those of them without inside.
    pub segments: usize,
    /// The triangles into which the pieces were cut.
    pub triangles: usize,
    /// Triangles that are not proved to be positive.
    pub doubtful: DoubtfulReport,
    /// Signs of determinants.
    pub signs: SignCounts,
    /// The landmark pairs.
    pub landmarks: LandmarkFigures,
    /// The pieces' matrices.
    pub matrices: MatrixFigures,
    /// Whether the map goes to the mirror image of the target.
    pub mirrored: bool,
}

/// Faces by mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct FaceCounts {
    /// Of the source.
    pub source: usize,
    /// Of the target.
    pub target: usize,
}

/// See [`conemap_verify::Doubtful`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct DoubtfulReport {
    /// How many.
    pub triangles: usize,
    /// The first piece with one of them.
    pub first_piece: Option<usize>,
    /// Their share of the source's area.
    pub source_share: f64,
    /// Their share of the target's area.
    pub target_share: f64,
    /// The largest share of a face that one of them covers the wrong way round.
    pub turned_share: f64,
}

/// Signs of determinants that were found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct SignCounts {
    /// All of them.
    pub all: u64,
    /// Those that took integers.
    pub by_integers: u64,
}

/// Landmark pairs of a proved map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct LandmarkFigures {
    /// How many.
    pub pairs: usize,
    /// How many meet exactly, vertex on vertex.
    pub exact: usize,
    /// The largest distance of the others, in units of the root of the mesh's area.
    pub largest_distance: f64,
}

/// Matrices of a proved map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct MatrixFigures {
    /// Pieces whose matrix is given.
    pub given: usize,
    /// How far images by matrices are off at most, in units of the root of the target's area.
    pub largest_distance: f64,
}

impl ProofReport {
    /// What is told of a proof.
    pub fn of(outcome: &Result<Proof, ProofError>) -> Self {
        match outcome {
            Ok(proof) if proof.is_exact() => Self::Proved(ProofFigures::of(proof)),
            Ok(proof) => Self::WithinRounding(ProofFigures::of(proof)),
            Err(error) => Self::Refused { kind: error.kind().to_owned(), sentence: error.to_string() },
        }
    }
}

impl ProofFigures {
    fn of(proof: &Proof) -> Self {
        let (doubtful, landmarks, matrices) = (&proof.doubtful, &proof.landmarks, &proof.matrices);
        let [source, target] = proof.faces;
        Self {
            sentence: proof.sentence(),
            faces: FaceCounts { source, target },
            vertices: proof.vertices,
            pieces: proof.pieces,
            segments: proof.segments,
            triangles: proof.triangles,
            doubtful: DoubtfulReport {
                triangles: doubtful.triangles,
                first_piece: doubtful.first_piece,
                source_share: doubtful.source_share,
                target_share: doubtful.target_share,
                turned_share: doubtful.turned_share,
            },
            signs: SignCounts { all: proof.signs.signs, by_integers: proof.signs.by_integers },
            landmarks: LandmarkFigures {
                pairs: landmarks.pairs,
                exact: landmarks.exact,
                largest_distance: landmarks.largest_distance,
            },
            matrices: MatrixFigures { given: matrices.given, largest_distance: matrices.largest_distance },
            mirrored: proof.is_mirrored,
        }
    }
}

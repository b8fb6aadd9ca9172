//! The report of the second certificate on a map, stable as JSON.

use super::proof::ProofError;
use conemap_verify::Proof;
use serde::Serialize;

/// The outcome of the proof of a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(tag = "verdict", rename_all = "kebab-case")]
pub enum ProofReport {
    /// The map is proved, every piece exactly.
    Proved(ProofFigures),
    /// The map is proved but for triangles that are doubtful within rounding.
    WithinRounding(ProofFigures),
    /// The files hold no map between these meshes, or do not tell one.
    Refused {
        /// A stable name of the reason.
        kind: String,
        /// The reason in a sentence.
        sentence: String,
    },
}

/// The figures of the proof of a map that is not refused.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct ProofFigures {
    /// The verdict in a sentence.
    pub sentence: String,
    /// Number of faces of both meshes.
    pub faces: FaceCounts,
    /// Number of overlay vertices.
    pub vertices: usize,
    /// Number of pieces.
    pub pieces: usize,
    /// Number of pieces without inside.
    pub segments: usize,
    /// Number of triangles into which the pieces were cut.
    pub triangles: usize,
    /// The triangles that are not proved to be positive.
    pub doubtful: DoubtfulReport,
    /// The signs of determinants that were found.
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
    /// Number of faces of the source.
    pub source: usize,
    /// Number of faces of the target.
    pub target: usize,
}

/// Triangles that are not proved to be positive, see [`conemap_verify::Doubtful`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct DoubtfulReport {
    /// Number of these triangles.
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
    /// Number of all signs.
    pub all: u64,
    /// Number of signs that took integers.
    pub by_integers: u64,
}

/// Landmark pairs of a proved map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct LandmarkFigures {
    /// Number of pairs.
    pub pairs: usize,
    /// Number of pairs that meet exactly, vertex on vertex.
    pub exact: usize,
    /// The largest distance of the others, in units of the root of the mesh's area.
    pub largest_distance: f64,
}

/// Matrices of a proved map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct MatrixFigures {
    /// Number of pieces whose matrix is given.
    pub given: usize,
    /// The largest distance of an image by a matrix from its place, in units of the root of the target's area.
    pub largest_distance: f64,
}

impl ProofReport {
    /// The report on a proof.
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

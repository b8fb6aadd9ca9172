//! Landmarks found by the program for two meshes, in the files' own numbers.

use super::error::JobError;
use crate::io::landmark_file::{LandmarkFile, LandmarkPoint};
use crate::landmark_matching::{
    Candidate, CoarsePicture, DifferenceKind, MatchInput, MatchOptions, MayMark, PairOrigin, Verdict,
    match_landmarks,
};
use crate::landmarks::{MeshSide, check_side, points};
use crate::mesh::check::CheckedMesh;
use crate::mesh::insertion::{Insertion, insert};
use crate::mesh::{FaceId, VertexId};
use crate::monitor::{Monitor, Stage};
use serde::Serialize;
use typed_index_collections::TiVec;

/// The treatment of fewer landmarks than a map needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FewLandmarks {
    /// Fewer landmarks are refused.
    #[default]
    Refused,
    /// The given ones are held, and the program finds others.
    Matched,
}

/// Landmarks that the program found, stable as JSON. Vertices have the numbers of the files.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct MatchReport {
    /// The verdict on the first candidate.
    pub verdict: VerdictReport,
    /// The candidates, the best first; none where fewer than four pairs were found.
    pub candidates: Vec<CandidateReport>,
}

impl MatchReport {
    /// Tells points of the target's mirror image of the target itself: a vertex has the same number on both.
    pub(super) fn mirror_target(&mut self) {
        let pairs = self.candidates.iter_mut().flat_map(|candidate| &mut candidate.pairs);
        pairs.for_each(|[_, point]| *point = point.mirrored());
    }
}

/// The verdict on a match.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct VerdictReport {
    /// `sure`, `doubtful`, `mirrored` or `unknown`.
    #[cfg_attr(
        all(feature = "web", target_arch = "wasm32"),
        tsify(type = "'sure' | 'doubtful' | 'mirrored' | 'unknown'")
    )]
    pub kind: &'static str,
    /// One sentence for the user, with what to do.
    pub sentence: String,
    /// The question that settles a doubtful match.
    pub question: Option<QuestionReport>,
    /// The vertices of the source that should be marked where no match is found to be right.
    pub places: Vec<usize>,
}

/// Whether a vertex of the source belongs here or there.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct QuestionReport {
    /// A vertex of the source.
    pub source: usize,
    /// The target's vertex by the best candidate, and by the rival.
    pub targets: [usize; 2],
    /// The number of the rival among the candidates, 0-based.
    pub rival: usize,
}

/// Pairs with what their coarse map says of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct CandidateReport {
    /// The pairs: the given ones in their order, then the others.
    #[cfg_attr(
        all(feature = "web", target_arch = "wasm32"),
        tsify(
            type = "[number | { face: number; barycentric: [number, number, number] }, number | { face: number; barycentric: [number, number, number] }][]"
        )
    )]
    pub pairs: Vec<[LandmarkPoint; 2]>,
    /// One name per pair.
    pub labels: Vec<String>,
    /// The origin of each pair.
    pub origins: Vec<PairOrigin>,
    /// The score of the pairs: the less, the better.
    pub score: f64,
    /// Mean log density of the coarse map; 0 for an isometry.
    pub mean_log: f64,
    /// The remoteness of the pairs, see [`Candidate::remoteness`].
    pub remoteness: f64,
    /// The relief of the pairs, see [`Candidate::relief`].
    pub relief: f64,
    /// The fit of patches, see [`Candidate::patch_fit`].
    pub patch_fit: f64,
    /// The agreement of the pairs, see [`Candidate::agreement`].
    pub agreement: f64,
    /// Number of ends of limbs without a partner, on the source and on the target.
    pub unmatched: [usize; 2],
    /// The difference from the best candidate; `null` for the best itself.
    pub difference: Option<DifferenceReport>,
}

/// The difference of a candidate from the best one.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct DifferenceReport {
    /// The kind of the difference, as a user would call it.
    pub kind: DifferenceKind,
    /// One sentence for the user.
    pub sentence: String,
    /// Share of the source's area that goes elsewhere.
    pub share: f64,
}

/// Landmarks that the program found.
#[derive(Clone, Debug)]
pub struct Matched {
    /// The report on them.
    pub report: MatchReport,
    /// The coarse map of each candidate, in the coordinates of the two meshes.
    pub pictures: Vec<CoarsePicture>,
}

impl Matched {
    /// The landmark file of a candidate; `None` where there is none of that number.
    pub fn landmarks(&self, candidate: usize) -> Option<LandmarkFile> {
        let CandidateReport { pairs, labels, .. } = self.report.candidates.get(candidate)?;
        let (pairs, labels) = (pairs.clone(), Some(labels.clone()));
        Some(LandmarkFile { pairs, labels, ..LandmarkFile::default() })
    }
}

/// Finds landmarks of two meshes beside given ones, which may be none: with alternatives and a verdict.
///
/// # Errors
/// [`JobError::Landmarks`] where a given landmark does not belong to its mesh, [`JobError::Matching`], or the wish to stop.
pub fn match_meshes(
    meshes: [&CheckedMesh; 2],
    given: &LandmarkFile,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Matched, JobError> {
    let placed = |side: MeshSide| -> Result<Insertion, JobError> {
        let mesh = meshes[side];
        check_side(mesh, side, &given.pairs)?;
        Ok(insert(&mesh.mesh, &points(mesh, side, &given.pairs)?)
            .map_err(crate::landmarks::LandmarkError::from)?)
    };
    let placed = [placed(MeshSide::Source)?, placed(MeshSide::Target)?];
    let ends = placed[0].vertices.iter().zip(&placed[1].vertices);
    let pairs: Vec<[VertexId; 2]> = ends.map(|(s, t)| [*s, *t]).collect();
    let may_mark = [0, 1].map(|k| may_mark(meshes[k], &placed[k]));
    let may_mark = MayMark { source: may_mark[0].as_deref(), target: may_mark[1].as_deref() };
    let input = MatchInput { source: &placed[0].mesh, target: &placed[1].mesh, given: &pairs, may_mark };
    monitor.enter(Stage::Matching);
    let found = match_landmarks(input, options, monitor)?;
    let numbers = meshes.map(CheckedMesh::file_from_vertex);
    let in_file_numbers = InFileNumbers { given, numbers: &numbers };
    let report = MatchReport {
        verdict: in_file_numbers.verdict(&found.verdict),
        candidates: found.candidates.iter().map(|candidate| in_file_numbers.candidate(candidate)).collect(),
    };
    Ok(Matched {
        report,
        pictures: found.candidates.into_iter().map(|candidate| candidate.picture).collect(),
    })
}

/// Which vertices may be landmarks: those of the file that no cap has, none of given points; `None` where all may.
fn may_mark(mesh: &CheckedMesh, placed: &Insertion) -> Option<TiVec<VertexId, bool>> {
    let file = mesh.vertex_from_file.len();
    let numbers = mesh.file_from_vertex();
    let none_inserted = placed.mesh.vertex_count() == numbers.len();
    let all_in_file = none_inserted && numbers.iter().all(|&number| number < file);
    if all_in_file && !mesh.has_caps() {
        return None;
    }
    let on_cap = |v: VertexId| {
        placed.mesh.star(v).any(|h| {
            let face: FaceId = h.face();
            mesh.is_cap(placed.face_origin[face])
        })
    };
    let in_file = |v: VertexId| numbers.get(v.index()).is_some_and(|&number| number < file);
    Some(placed.mesh.vertices().map(|v| in_file(v) && !on_cap(v)).collect())
}

/// A match in the numbers of the files.
struct InFileNumbers<'a> {
    given: &'a LandmarkFile,
    numbers: &'a [Vec<usize>; 2],
}

impl InFileNumbers<'_> {
    /// The file's number of a vertex; given landmarks inside faces, which no file numbers, are named by their pair elsewhere.
    fn number(&self, side: MeshSide, v: VertexId) -> usize {
        self.numbers[side].get(v.index()).copied().unwrap_or(v.index())
    }

    fn verdict(&self, verdict: &Verdict) -> VerdictReport {
        let number = |side, v| self.number(side, v);
        let (question, places) = match verdict {
            Verdict::Sure | Verdict::Mirrored { .. } => (None, Vec::new()),
            Verdict::Doubtful(question) => {
                let targets = question.targets.map(|v| number(MeshSide::Target, v));
                let source = number(MeshSide::Source, question.source);
                (Some(QuestionReport { source, targets, rival: question.rival }), Vec::new())
            }
            Verdict::Unknown { places } => {
                (None, places.iter().map(|&v| number(MeshSide::Source, v)).collect())
            }
        };
        VerdictReport { kind: verdict.word(), sentence: verdict.sentence(number), question, places }
    }

    fn candidate(&self, candidate: &Candidate) -> CandidateReport {
        let number = |side, v| self.number(side, v);
        let point = |side, v| LandmarkPoint::Vertex(u32::try_from(number(side, v)).unwrap_or(u32::MAX));
        let given = self.given.pairs.len();
        let found = candidate.pairs[given..]
            .iter()
            .map(|pair| [point(MeshSide::Source, pair.source), point(MeshSide::Target, pair.target)]);
        let known = |k: usize| self.given.labels.as_ref().and_then(|labels| labels.get(k)).cloned();
        let label = |k: usize| match candidate.pairs[k].origin {
            PairOrigin::Given => known(k).unwrap_or_default(),
            PairOrigin::Tips => format!("end {}", k + 1 - given),
            PairOrigin::Between => format!("between {}", k + 1 - given),
        };
        CandidateReport {
            pairs: self.given.pairs.iter().copied().chain(found).collect(),
            labels: (0..candidate.pairs.len()).map(label).collect(),
            origins: candidate.pairs.iter().map(|pair| pair.origin).collect(),
            score: candidate.score,
            mean_log: candidate.mean_log,
            remoteness: candidate.remoteness,
            relief: candidate.relief,
            patch_fit: candidate.patch_fit,
            agreement: candidate.agreement,
            unmatched: candidate.unmatched,
            difference: candidate.difference.as_ref().map(|difference| DifferenceReport {
                kind: difference.kind,
                sentence: difference.sentence(number),
                share: difference.share,
            }),
        }
    }
}

//! The verdict on a match: its certainty, and the question that settles a doubt.

use super::candidate::Candidate;
use super::input::MatchInput;
use super::options::VerdictLimits;
use super::pair::PairOrigin;
use super::parting::{PartedPlace, Parting};
use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::mesh::VertexId;
use crate::mesh::surface_index::SurfaceIndex;
use glam::DVec3;

/// The certainty of a match.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The best candidate is good, and far better than all whose maps differ from its own.
    Sure,
    /// Another candidate is nearly as good, or the best is not good enough: the answer to one question settles it.
    Doubtful(Question),
    /// The target's mirror image fits far better: one of both meshes is that of a left hand, or was mirrored on its way.
    Mirrored {
        /// The score of the best candidate onto the mirror image.
        score: f64,
    },
    /// No candidate fits well: pairs at these vertices of the source would help.
    Unknown {
        /// Three vertices of the source, far from each other; fewer where no more may be landmarks.
        places: Vec<VertexId>,
    },
}

/// The question whether the best candidate or its rival is right: a landmark pair of the vertex with the right one of both places settles
/// it.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// A vertex of the source.
    pub source: VertexId,
    /// The vertices of the target to which the best candidate and its rival take it.
    pub targets: [VertexId; 2],
    /// The number of the rival among the candidates.
    pub rival: usize,
}

impl Verdict {
    /// The verdict in one word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Sure => "sure",
            Self::Doubtful(_) => "doubtful",
            Self::Mirrored { .. } => "mirrored",
            Self::Unknown { .. } => "unknown",
        }
    }

    /// One sentence for the user, with what to do. `number` gives the number of a vertex in the user's file.
    pub fn sentence(&self, number: impl Fn(MeshSide, VertexId) -> usize) -> String {
        match self {
            Self::Sure => "The landmarks are sure: no other assignment comes near.".to_owned(),
            Self::Doubtful(Question { source, targets: [best, rival], .. }) => {
                let [best, rival] = [best, rival].map(|v| number(MeshSide::Target, *v));
                format!(
                    "The landmarks are doubtful: does vertex {} of the source belong to vertex {best} of the target, as here, or \
                     to vertex {rival}? Give the right one as a landmark.",
                    number(MeshSide::Source, *source)
                )
            }
            Self::Mirrored { score } => format!(
                "The target fits far better as its mirror image (score {score:.3}): map onto that (--mirror-target), or give landmarks."
            ),
            Self::Unknown { places } => {
                let places: Vec<String> =
                    places.iter().map(|&v| number(MeshSide::Source, v).to_string()).collect();
                format!(
                    "No assignment of the limbs fits well: mark the vertices {} of the source and their partners on the target as \
                     landmarks.",
                    places.join(", ")
                )
            }
        }
    }
}

/// What a search has found.
#[derive(Clone, Copy)]
pub(super) struct Found<'a> {
    /// The candidates, the best first.
    pub(super) candidates: &'a [Candidate],
    /// The best candidate onto the target's mirror image.
    pub(super) mirrored: Option<&'a Candidate>,
}

/// The verdict on what was found.
pub(super) fn verdict(
    input: MatchInput<'_>,
    shapes: [&Shape; 2],
    Found { candidates, mirrored }: Found<'_>,
    limits: &VerdictLimits,
) -> Verdict {
    if let (Some(best), Some(image)) = (candidates.first(), mirrored)
        && is_mirrored(best, image, limits)
    {
        return Verdict::Mirrored { score: image.score };
    }
    let unknown = || Verdict::Unknown { places: shapes[0].far_places() };
    let Some(best) = candidates.first().filter(|best| best.score_without_patches() < limits.unknown_score)
    else {
        return unknown();
    };
    let parts = |c: &Candidate| c.difference.as_ref().is_some_and(|d| d.share > limits.parting);
    let rivals = || candidates.iter().enumerate().filter(|(_, candidate)| parts(candidate));
    let first = rivals().next();
    let leads_by = |lead: f64| first.is_some_and(|(_, rival)| rival.score >= best.score + lead);
    let margin = |rival: &Candidate| {
        let exchanges = best.assignment.keeps_sides && !rival.assignment.keeps_sides;
        if exchanges { limits.margin_of_sides } else { limits.margin }
    };
    let near = rivals().find(|(_, rival)| rival.score < best.score + margin(rival));
    let clear = best.pairs.iter().filter(|pair| pair.origin != PairOrigin::Between).count();
    // A given pair settles a doubt that came of the score alone. More of them say no more about the fit.
    let settled = if input.given.is_empty() { 0.0 } else { limits.with_given };
    let scores_well = if leads_by(limits.wide_lead) {
        best.score_without_remoteness() < limits.sure_score_with_wide_lead
    } else if best.assignment.keeps_sides || leads_by(limits.clear_lead) {
        best.score_without_remoteness() < limits.sure_score + settled
    } else {
        best.score_without_patches() < limits.sure_score_without_sides + settled
    };
    let fits = scores_well && best.agreement >= limits.agreement;
    // One pair less is enough for a map that is nearly an isometry, as that of a body with few ends onto another pose of it.
    let isometric = best.score_without_patches() < limits.sure_score_without_sides;
    let enough = clear + usize::from(isometric) >= limits.least_pairs;
    if fits && near.is_none() && enough {
        return Verdict::Sure;
    }
    let question = near.or(first).and_then(|(number, _)| question(input, candidates, number));
    question.map_or_else(unknown, Verdict::Doubtful)
}

/// Whether the best candidate onto the target's mirror image fits far better than the best onto the target. That of a man fits better where
/// he raises the other arm, but with the same distortion.
fn is_mirrored(best: &Candidate, image: &Candidate, limits: &VerdictLimits) -> bool {
    image.score_without_remoteness() < limits.sure_score
        && image.score + limits.margin < best.score
        && image.mean_log < limits.mirror_share * best.mean_log
}

/// The question that decides between the best candidate and a rival; `None` where they differ at no vertices that may be landmarks.
fn question(input: MatchInput<'_>, candidates: &[Candidate], rival: usize) -> Option<Question> {
    let (best, other) = (&candidates[0], &candidates[rival]);
    let may = |question: &Question| {
        let Question { source, targets, .. } = *question;
        input.may(MeshSide::Source, source)
            && targets.iter().all(|&v| input.may(MeshSide::Target, v))
            && targets[0] != targets[1]
    };
    let marks = [best, other].map(|candidate| &candidate.assignment.pairs);
    // Both candidates may have the same tip at slightly different vertices: so marks are compared, not vertices.
    let of_pair = |k: usize| {
        let [source, target] = marks[0][k];
        let other_k = marks[1].iter().position(|mark| mark[0] == source && mark[1] != target)?;
        let targets = [best.pairs[k].target, other.pairs[other_k].target];
        Some(Question { source: best.pairs[k].source, targets, rival }).filter(may)
    };
    // A pair is easier to answer than a place between: the one whose two partners are farthest apart.
    let apart = |question: &Question| {
        let [a, b] = question.targets.map(|v| input.target.positions()[v]);
        a.distance(b)
    };
    let of_pairs = (0..marks[0].len()).filter_map(of_pair);
    if let Some(question) = of_pairs.max_by(|a, b| apart(a).total_cmp(&apart(b))) {
        return Some(question);
    }
    let [source, target] = input.meshes().map(SurfaceIndex::new);
    let of_place = |place: &PartedPlace| Question {
        source: nearest_vertex(&source, place.source),
        targets: place.images.map(|image| nearest_vertex(&target, image)),
        rival,
    };
    Parting::of(best, other).places.iter().map(of_place).find(may)
}

fn nearest_vertex(index: &SurfaceIndex<'_>, place: DVec3) -> VertexId {
    index.nearest(place).point.heaviest_corner(index.mesh())
}

#[cfg(test)]
mod tests {
    use super::super::difference::{Difference, DifferenceKind};
    use super::super::input::MayMark;
    use super::super::pair::MatchedPair;
    use super::super::test_bodies::shape;
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::{SurfaceMesh, SurfacePoint};
    use typed_index_collections::TiVec;

    /// The image of a ball's vertex under half a turn about the last axis: what lies on it stays, what is far from it goes far.
    fn turned(index: &SurfaceIndex<'_>, v: VertexId) -> VertexId {
        nearest_vertex(index, index.mesh().positions()[v] * DVec3::new(-1.0, -1.0, 1.0))
    }

    /// A candidate of five tips that stay where they are, and one that is half a turn, with these scores.
    fn right_and_turned(mesh: &SurfaceMesh, scores: [f64; 2]) -> [Candidate; 2] {
        let index = SurfaceIndex::new(mesh);
        let images = |image: &dyn Fn(VertexId) -> VertexId| {
            mesh.vertices().map(|v| SurfacePoint::at_vertex(mesh, image(v))).collect()
        };
        let [mut right, mut other] =
            [images(&|v| v), images(&|v| turned(&index, v))].map(|images| Candidate::of_images(mesh, images));
        let tip = |v: VertexId| MatchedPair { source: v, target: v, origin: PairOrigin::Tips };
        right.pairs = mesh.vertices().take(5).map(tip).collect();
        [right.score, other.score] = scores;
        other.difference = Some(Difference { kind: DifferenceKind::Places, pairs: Vec::new(), share: 0.8 });
        [right, other]
    }

    #[test]
    fn an_answer_settles_a_doubt_that_came_of_the_score_but_not_one_between_rivals() {
        let mesh = icosphere(2);
        let given = [[VertexId(0); 2]];
        let verdict_with = |mirrored: Option<&Candidate>, scores: [f64; 2], given: &[[VertexId; 2]]| {
            let shape = shape(&mesh);
            let input = MatchInput { given, ..MatchInput::new(&mesh, &mesh) };
            let candidates = right_and_turned(&mesh, scores);
            let found = Found { candidates: &candidates, mirrored };
            super::verdict(input, [&shape; 2], found, &VerdictLimits::default()).word()
        };
        let verdict = |scores: [f64; 2], given: &[[VertexId; 2]]| verdict_with(None, scores, given);
        assert_eq!(verdict([0.40, 1.10], &[]), "sure");
        assert_eq!(verdict([0.62, 0.95], &[]), "doubtful");
        assert_eq!(verdict([0.62, 0.95], &given), "sure");
        assert_eq!(verdict([0.65, 0.95], &given), "doubtful");
        assert_eq!(verdict([0.40, 0.45], &given), "doubtful");
        assert_eq!(verdict([1.10, 1.90], &given), "unknown");
        // The mirror image of a body that is nearly symmetric fits as well; in another pose it may fit better, as distorted.
        let [right, _] = right_and_turned(&mesh, [0.4, 1.1]);
        let image = |score: f64, mean_log: f64| Candidate {
            score,
            mean_log: mean_log * right.mean_log,
            ..right.clone()
        };
        assert_eq!(verdict_with(Some(&image(0.35, 0.5)), [0.40, 1.10], &[]), "sure");
        assert_eq!(verdict_with(Some(&image(0.30, 0.9)), [0.40, 1.10], &[]), "sure");
        assert_eq!(verdict_with(Some(&image(0.30, 0.5)), [0.40, 1.10], &[]), "mirrored");
    }

    #[test]
    fn a_clear_lead_settles_left_and_right() {
        let mesh = icosphere(2);
        let shape = shape(&mesh);
        let verdict = |scores: [f64; 2]| {
            let mut candidates = right_and_turned(&mesh, scores);
            candidates[0].assignment.keeps_sides = false;
            let found = Found { candidates: &candidates, mirrored: None };
            super::verdict(MatchInput::new(&mesh, &mesh), [&shape; 2], found, &VerdictLimits::default())
                .word()
        };
        assert_eq!(verdict([0.45, 0.7]), "sure");
        assert_eq!(verdict([0.55, 0.7]), "doubtful");
        assert_eq!(verdict([0.55, 0.9]), "sure");
        assert_eq!(verdict([0.6, 0.95]), "doubtful");
        // By still more it makes up for a poorer score, as between a rat and a lion.
        assert_eq!(verdict([0.6, 1.05]), "sure");
        assert_eq!(verdict([0.7, 1.9]), "doubtful");
    }

    #[test]
    fn a_rival_that_exchanges_limbs_has_to_come_nearer() {
        let mesh = icosphere(2);
        let shape = shape(&mesh);
        // The second rival keeps left and right, as the best candidate does.
        let verdict = |scores: [f64; 2]| {
            let [best, mut exchanging] = right_and_turned(&mesh, [0.4, scores[0]]);
            let keeping = Candidate { score: scores[1], ..exchanging.clone() };
            exchanging.assignment.keeps_sides = false;
            let candidates = [best, exchanging, keeping];
            let found = Found { candidates: &candidates, mirrored: None };
            super::verdict(MatchInput::new(&mesh, &mesh), [&shape; 2], found, &VerdictLimits::default())
        };
        let rival = |verdict: Verdict| match verdict {
            Verdict::Doubtful(question) => Some(question.rival),
            _ => None,
        };
        assert_eq!(verdict([0.46, 0.6]), Verdict::Sure);
        assert_eq!(rival(verdict([0.44, 0.6])), Some(1));
        assert_eq!(rival(verdict([0.46, 0.47])), Some(2));
    }

    #[test]
    fn a_question_is_about_vertices_that_may_be_marked() {
        let mesh = icosphere(2);
        let at = |v: VertexId| mesh.positions()[v];
        let index = SurfaceIndex::new(&mesh);
        let candidates = right_and_turned(&mesh, [0.7; 2]);
        let free = question(MatchInput::new(&mesh, &mesh), &candidates, 1).unwrap();
        assert_eq!((free.targets, free.rival), ([free.source, turned(&index, free.source)], 1));
        // Neither the source's vertex there nor the target's on one side of the axis.
        let of_source: TiVec<VertexId, bool> = mesh.vertices().map(|v| v != free.source).collect();
        let of_target: TiVec<VertexId, bool> =
            mesh.vertices().map(|v| at(v).truncate().length() < 0.6).collect();
        let may_mark = MayMark { source: Some(&of_source), target: Some(&of_target) };
        let held = MatchInput { may_mark, ..MatchInput::new(&mesh, &mesh) };
        let asked = question(held, &candidates, 1).unwrap();
        assert!(asked.source != free.source && asked.targets.iter().all(|&v| of_target[v]), "{asked:?}");
        assert!(asked.targets[0] != asked.targets[1]);
        // Where nothing may be marked nothing is asked.
        let none: TiVec<VertexId, bool> = mesh.vertices().map(|_| false).collect();
        let may_mark = MayMark { source: None, target: Some(&none) };
        assert_eq!(question(MatchInput { may_mark, ..held }, &candidates, 1), None);
    }
}

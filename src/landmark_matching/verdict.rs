//! How sure a match is, and the question that settles a doubt.

use super::candidate::Candidate;
use super::options::VerdictLimits;
use super::pair::PairOrigin;
use super::parting::Parting;
use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;

/// How sure a match is.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The best candidate is good, and far better than all that differ from it.
    Sure,
    /// Another candidate is nearly as good: the answer to one question settles it.
    Doubtful(Question),
    /// Nothing fits well: pairs at these vertices of the source would help.
    Unknown {
        /// Three vertices of the source, far from each other.
        places: Vec<VertexId>,
    },
}

/// Where the best candidate and its rival part: a pair of the vertex with the right one of both places settles it.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// A vertex of the source.
    pub source: VertexId,
    /// Where the best candidate takes it, and where its rival does: vertices of the target.
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
            Self::Unknown { .. } => "unknown",
        }
    }

    /// One sentence for the user, with what to do. `number` tells how the user's file numbers a vertex of a mesh.
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

/// The verdict on candidates, the best first.
pub(super) fn verdict(
    meshes: [&SurfaceMesh; 2],
    shapes: [&Shape; 2],
    candidates: &[Candidate],
    limits: &VerdictLimits,
) -> Verdict {
    let unknown = || Verdict::Unknown { places: shapes[0].far_places() };
    let Some(best) = candidates.first().filter(|best| best.score < limits.unknown_score) else {
        return unknown();
    };
    let parts = |c: &&Candidate| c.difference.as_ref().is_some_and(|d| d.share > limits.parting);
    let rival = candidates.iter().find(parts);
    let near = rival.is_some_and(|rival| rival.score < best.score + limits.margin);
    let clear = best.pairs.iter().filter(|pair| pair.origin != PairOrigin::Between).count();
    let fits = best.score < limits.sure_score && best.agreement >= limits.agreement;
    if fits && !near && clear >= limits.least_pairs {
        return Verdict::Sure;
    }
    match rival {
        Some(rival) => Verdict::Doubtful(question(meshes, candidates, best, rival)),
        None => unknown(),
    }
}

fn question(
    meshes: [&SurfaceMesh; 2],
    candidates: &[Candidate],
    best: &Candidate,
    rival: &Candidate,
) -> Question {
    let number = candidates.iter().position(|c| std::ptr::eq(c, rival)).unwrap_or(0);
    let place = |v: VertexId| meshes[1].positions()[v];
    let marks = [best, rival].map(|candidate| &candidate.assignment.pairs);
    // Both candidates may have the same end at slightly different vertices: marks tell what is the same.
    let partner = |k: usize| {
        let [source, target] = marks[0][k];
        let other = marks[1].iter().position(|mark| mark[0] == source && mark[1] != target)?;
        Some((best.pairs[k].source, [best.pairs[k].target, rival.pairs[other].target]))
    };
    // A pair is easier to answer than a place between: the one whose two partners are farthest apart.
    let pairs = (0..marks[0].len()).filter_map(partner);
    let apart = |targets: [VertexId; 2]| place(targets[0]).distance(place(targets[1]));
    if let Some((source, targets)) = pairs.max_by(|a, b| apart(a.1).total_cmp(&apart(b.1))) {
        return Question { source, targets, rival: number };
    }
    let parting = Parting::of(best, rival);
    let [source, target] = [0, 1].map(|side: usize| SurfaceIndex::new(meshes[side]));
    let from = best.picture.source.positions()[parting.vertex];
    let targets = parting.images.map(|image| nearest_vertex(&target, image));
    Question { source: nearest_vertex(&source, from), targets, rival: number }
}

fn nearest_vertex(index: &SurfaceIndex<'_>, place: DVec3) -> VertexId {
    let point = index.nearest(place).point;
    let corners = index.mesh().triangles()[point.face];
    let largest = (0..3).max_by(|&a, &b| point.barycentric[a].total_cmp(&point.barycentric[b])).unwrap_or(0);
    corners[largest]
}

//! Candidates: landmark pairs with their coarse map and its score.

use super::difference::Difference;
use super::judge::Judged;
use super::pair::{MatchedPair, PairOrigin};
use super::search::Assignment;
use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::mesh::resampling::resampled;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::MapPreview;
use glam::DVec3;
use typed_index_collections::TiVec;

/// The coarse map of a candidate, in the units of the two meshes.
#[derive(Clone, Debug)]
pub struct CoarsePicture {
    /// The source, coarse.
    pub source: SurfaceMesh,
    /// The target, coarse.
    pub target: SurfaceMesh,
    /// The image of each vertex of the coarse source on the coarse target.
    pub target_from_source: TiVec<VertexId, SurfacePoint>,
}

impl CoarsePicture {
    /// The place of each vertex of the coarse source on the coarse target.
    pub fn images(&self) -> TiVec<VertexId, DVec3> {
        self.target_from_source.iter().map(|image| image.position(&self.target)).collect()
    }
}

/// The coarse map of a candidate on the full source.
pub(super) struct PictureOnMesh<'a> {
    /// The candidate.
    pub(super) candidate: &'a Candidate,
    /// The full source.
    pub(super) source: &'a SurfaceMesh,
}

impl MapPreview for PictureOnMesh<'_> {
    /// The images of the vertices of the source, each by its place on the coarse source; those of the target are not known.
    fn images(&self, of: MeshSide) -> Option<Vec<DVec3>> {
        if of == MeshSide::Target {
            return None;
        }
        let picture = &self.candidate.picture;
        Some(resampled(&picture.images(), &picture.source, self.source, |_| None).raw)
    }

    fn found_pairs(&self) -> Vec<[usize; 2]> {
        let found = self.candidate.pairs.iter().filter(|pair| pair.origin != PairOrigin::Given);
        found.map(|pair| [pair.source.index(), pair.target.index()]).collect()
    }
}

/// Landmark pairs with their coarse map.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The pairs: the given ones in their order, then the others.
    pub pairs: Vec<MatchedPair>,
    /// The weighted sum of the terms below; less is better.
    pub score: f64,
    /// Mean log density of the coarse map; 0 for an isometry.
    pub mean_log: f64,
    /// Mean difference between a point's mean distance to its surface and its image's mean distance to its own, in units of the root of
    /// the area, with both bodies scaled so that these distances have the same mean.
    pub remoteness: f64,
    /// Mean difference between a point's height above its smoothed surface and its image's above its own, in units of the root of the
    /// area.
    pub relief: f64,
    /// Share of the cyclic orders of shortest paths between the pairs that are the same on both meshes, 0 to 1.
    pub agreement: f64,
    /// Ends of limbs without a partner, on the source and on the target.
    pub unmatched: [usize; 2],
    /// Its difference from the best candidate; `None` for the best itself.
    pub difference: Option<Difference>,
    /// The coarse map.
    pub picture: CoarsePicture,
    /// The marks by which it was found, for further search.
    pub(super) assignment: Assignment,
}

/// Weights of the score beside the mean log density, found with a prototype on pairs among eight animals of SHREC07. Over the candidates
/// of 88 matches the best have the same mean error, within 0.2 % of the root of the area, with 0 to 10, 0 to 0.2 and 0 to 0.2.
const REMOTENESS: f64 = 5.0;
/// Weight of the number of main tips without a partner; see [`REMOTENESS`].
const UNMATCHED: f64 = 0.12;
/// Weight of the difference in relief. Of pairs of candidates, one right and one with exchanged limbs, relief alone ranks 99.7 % rightly on
/// men in several poses, where the score without it ranks 91 %, and 99.8 % on animals (98 %). With 10 fewer men had exchanged limbs than
/// with 5.
const RELIEF: f64 = 10.0;
/// Weight of the share of orders that do not agree. With 0.2 the men had more exchanged limbs, and the animals the same.
const ORDERS: f64 = 0.05;
/// The amount that a nose assigned to an ear adds to the score, and that ears assigned to ears subtract from it. With 0.03 and with 0.05
/// the face of 385 lies right on 383, and nothing else changes on the pairs among four animals of SHREC07; 0.05 was taken after another
/// pair (392-397) had been seen.
const ROLES: f64 = 0.05;
/// The amount that a pair adds to the score whose tips are both far more like other tips. Four of ten matches of a dog in two poses had the
/// nose at an ear, with a lead of up to 0.09.
const CROSSED: f64 = 0.1;

impl Candidate {
    /// The candidate of an assignment with its judged map.
    pub(super) fn new(shapes: [&Shape; 2], assignment: Assignment, judged: Judged) -> Self {
        let pair = |&[s, t]: &[usize; 2]| MatchedPair {
            source: shapes[0].on_mesh(shapes[0].marks[s].vertex),
            target: shapes[1].on_mesh(shapes[1].marks[t].vertex),
            origin: shapes[0].origin(s),
        };
        let score = score(&assignment, &judged);
        let Judged { mean_log, remoteness, relief, images } = judged;
        let [source, target] =
            MeshSide::BOTH.map(|side| shapes[side].in_units_of_mesh(&images.levels[side].mesh));
        let picture = CoarsePicture { source, target, target_from_source: images.target_from_source };
        let between = assignment.between.map(|[s, t]| MatchedPair {
            source: shapes[0].on_mesh(s),
            target: shapes[1].on_mesh(t),
            origin: PairOrigin::Between,
        });
        Self {
            pairs: assignment.pairs.iter().map(pair).chain(between).collect(),
            score,
            mean_log,
            remoteness,
            relief,
            agreement: assignment.agreement,
            unmatched: assignment.unmatched,
            difference: None,
            picture,
            assignment,
        }
    }

    /// The score without its remoteness. That tells the better of two candidates, but right maps between bodies of different proportions have
    /// as much of it as wrong ones between like bodies.
    pub(super) fn score_without_remoteness(&self) -> f64 {
        self.score - REMOTENESS * self.remoteness
    }
}

/// The score of an assignment with its map.
pub(super) fn score(assignment: &Assignment, judged: &Judged) -> f64 {
    // A limb that only one of both bodies has costs nothing.
    let unmatched = assignment.unmatched[0].min(assignment.unmatched[1]) as f64;
    judged.mean_log
        + REMOTENESS * judged.remoteness
        + RELIEF * judged.relief
        + UNMATCHED * unmatched
        + ORDERS * (1.0 - assignment.agreement)
        + roles(assignment)
        + CROSSED * assignment.crossed as f64
}

/// The part of the score for noses that go to ears, and ears to ears.
fn roles(assignment: &Assignment) -> f64 {
    ROLES * (assignment.mixed as f64 - assignment.twins.min(1) as f64)
}

#[cfg(test)]
impl Candidate {
    /// A candidate of two same meshes without pairs of marks, with a doubtful score.
    pub(super) fn of_images(mesh: &SurfaceMesh, target_from_source: TiVec<VertexId, SurfacePoint>) -> Self {
        Self {
            pairs: Vec::new(),
            score: 0.7,
            mean_log: 0.7,
            remoteness: 0.0,
            relief: 0.0,
            agreement: 1.0,
            unmatched: [0; 2],
            difference: None,
            picture: CoarsePicture { source: mesh.clone(), target: mesh.clone(), target_from_source },
            assignment: Assignment {
                pairs: Vec::new(),
                cost: 0.0,
                unmatched_cost: 0.0,
                agreement: 1.0,
                unmatched: [0; 2],
                keeps_sides: true,
                twins: 0,
                mixed: 0,
                crossed: 0,
                between: None,
            },
        }
    }
}

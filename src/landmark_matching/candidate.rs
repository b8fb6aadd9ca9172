//! Candidates: landmark pairs with their coarse map and its score.

use super::difference::Difference;
use super::judge::{Judged, Measures};
use super::pair::{MatchedPair, PairOrigin};
use super::search::Assignment;
use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::math::scalar::{ln, max};
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
    /// How well patches of the source fit the target near their images when each is moved rigidly, 0 to 1.
    pub patch_fit: f64,
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
/// Weight of the logarithm of the fit of patches, whose ratio tells a body's front from its back: patches of people fit 1.4 to 2.5 times as well
/// under the best map as under its nearest rival, those of animals 0.9 to 2.1 times. Of the pairs of candidates of animals, people and a
/// dog 89.5, 91.4 and 94.4 % are ranked rightly without it, 91.7, 93.6 and 96.8 % with it, and 92.7, 94.3 and 97.6 % with 0.6, where it would
/// outweigh the other terms.
const PATCHES: f64 = 0.3;
/// Fits below this are the same.
const LEAST_FIT: f64 = 1e-3;

impl Candidate {
    /// The candidate of an assignment with its judged map.
    pub(super) fn new(shapes: [&Shape; 2], assignment: Assignment, judged: Judged) -> Self {
        let pair = |&[s, t]: &[usize; 2]| MatchedPair {
            source: shapes[0].on_mesh(shapes[0].marks[s].vertex),
            target: shapes[1].on_mesh(shapes[1].marks[t].vertex),
            origin: shapes[0].origin(s),
        };
        let Judged { measures, patch_fit, images } = judged;
        let score = score_of_measures(&assignment, &measures) + score_of_patches(patch_fit);
        let Measures { mean_log, remoteness, relief } = measures;
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
            patch_fit,
            agreement: assignment.agreement,
            unmatched: assignment.unmatched,
            difference: None,
            picture,
            assignment,
        }
    }

    /// The score without the fit of patches, which tells the better of two candidates: it depends on how alike both bodies are more than on
    /// whether the map is right.
    pub(super) fn score_without_patches(&self) -> f64 {
        self.score - score_of_patches(self.patch_fit)
    }

    /// The score without the fit of patches and without remoteness. That tells the better of two candidates as well, but right maps between
    /// bodies of different proportions have as much of it as wrong ones between like bodies.
    pub(super) fn score_without_remoteness(&self) -> f64 {
        self.score_without_patches() - REMOTENESS * self.remoteness
    }
}

/// The part of the score for the fit of patches.
fn score_of_patches(fit: f64) -> f64 {
    -PATCHES * ln(max(fit, LEAST_FIT))
}

/// The score of an assignment with its map, without the fit of patches.
pub(super) fn score_of_measures(assignment: &Assignment, measures: &Measures) -> f64 {
    // A limb that only one of both bodies has costs nothing.
    let unmatched = assignment.unmatched[0].min(assignment.unmatched[1]) as f64;
    measures.mean_log
        + REMOTENESS * measures.remoteness
        + RELIEF * measures.relief
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
            patch_fit: 1.0,
            agreement: 1.0,
            unmatched: [0; 2],
            difference: None,
            picture: CoarsePicture { source: mesh.clone(), target: mesh.clone(), target_from_source },
            assignment: no_pairs(),
        }
    }
}

/// An assignment of no marks, which costs nothing.
#[cfg(test)]
fn no_pairs() -> Assignment {
    Assignment {
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
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{four_footed, shape};
    use super::*;
    use crate::landmark_matching::judge::judge;
    use crate::landmark_matching::options::MatchOptions;
    use crate::monitor::Silent;

    #[test]
    fn a_candidate_whose_patches_fit_half_as_well_scores_worse_but_not_in_its_other_terms() {
        let (shape, options) = (shape(&four_footed()), MatchOptions::default());
        let shapes = [&shape; 2];
        let marks = shape.main(&options);
        let pairs: Vec<[VertexId; 2]> = marks.iter().map(|&k| [shape.marks[k].vertex; 2]).collect();
        let assignment = Assignment { pairs: marks.iter().map(|&k| [k; 2]).collect(), ..no_pairs() };
        let with_fit = |share: f64| {
            let judged = judge(shapes, &pairs, &options, |_| true, &mut Silent).unwrap().unwrap();
            let patch_fit = share * judged.patch_fit;
            Candidate::new(shapes, assignment.clone(), Judged { patch_fit, ..judged })
        };
        let [well, badly] = [1.0, 0.5].map(with_fit);
        assert!((badly.score - well.score - PATCHES * ln(2.0)).abs() < 1e-12);
        assert!((badly.score_without_patches() - well.score_without_patches()).abs() < 1e-12);
        assert!((badly.score_without_remoteness() - well.score_without_remoteness()).abs() < 1e-12);
        // No fit at all is bad, but finite.
        assert!(with_fit(0.0).score > badly.score && with_fit(0.0).score.is_finite());
    }
}

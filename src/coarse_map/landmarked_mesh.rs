//! A mesh of area 1 with its landmarks, refined around them so that a layout can be drawn.

use crate::landmarks::LandmarkId;
use crate::layout::PatchedMesh;
use crate::mesh::face_weights::{FaceWeight, FaceWeights};
use crate::mesh::{FaceId, HalfedgeId, MeshError, RefinedMesh, SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use rustc_hash::FxHashSet;
use typed_index_collections::{TiSlice, TiVec};

/// A mesh scaled to area 1, refined so that a layout has room around its landmarks.
#[derive(Clone)]
pub struct LandmarkedMesh {
    /// The refined mesh.
    pub refined: RefinedMesh,
    /// Its vertex of each landmark.
    pub landmarks: TiVec<LandmarkId, VertexId>,
    /// Its vertex of each landmark on coarse levels.
    stand_ins: TiVec<LandmarkId, VertexId>,
    /// The weights of the faces; `None` where all are skin.
    weights: Option<Weights>,
}

/// The weights of faces in an energy of the map.
#[derive(Clone)]
struct Weights {
    /// The weight of each face of the input mesh.
    of_input: TiVec<FaceId, FaceWeight>,
    /// The weight of each face of the refined mesh.
    of_refined: TiVec<FaceId, FaceWeight>,
}

impl Weights {
    fn new(of_input: TiVec<FaceId, FaceWeight>, refined: &RefinedMesh) -> Self {
        let of_refined = refined.face_origin.iter().map(|&f| of_input[f]).collect();
        Self { of_input, of_refined }
    }
}

/// Edges at a landmark, at least. Around a landmark of degree 3, such as one inside a face, no layout's points can be removed again:
/// beside three straight edges there is no room for other paths. 6 was chosen by hand.
const LEAST_DEGREE: usize = 6;

/// Vertices of a level for each landmark, at least: a base domain of n landmarks has 2 n - 4 triangles, and each needs some vertices of
/// its own. With 42 vertices for 16 landmarks and 162 for 60, less than 3 for each, no layout had a map. Chosen by hand above that.
pub const LEAST_PER_LANDMARK: usize = 18;

/// A neighbour stands for a landmark in a face on coarse levels where it is nearer than this, in mean distances of the landmark's other
/// neighbours. On clicked landmarks of two horses the largest density of a piece fell from 7e4 to 9e2 with it; with .06 and .15 to 3e3 and 6e3,
/// and E and processor time were higher.
const NEAR: f64 = 0.02;

/// Least cosine between normals that count as parallel: those of needles are known to fewer digits.
const PARALLEL: f64 = 1.0 - 1e-6;

impl LandmarkedMesh {
    /// A mesh with its landmarks.
    ///
    /// # Errors
    /// [`MeshError`] where a face cannot be bisected.
    pub fn new(mesh: &SurfaceMesh, landmarks: &[VertexId]) -> Result<Self, MeshError> {
        let refined =
            RefinedMesh::unrefined(mesh).with_vertices(mesh, LEAST_PER_LANDMARK * landmarks.len())?;
        let refined = refined.with_degrees(mesh, landmarks.iter().copied(), LEAST_DEGREE)?;
        let stand_ins = stand_ins(&refined.mesh, landmarks);
        Ok(Self { refined, landmarks: landmarks.iter().copied().collect(), stand_ins, weights: None })
    }

    /// A mesh with a drawing of a base domain, and refined along it.
    pub fn patched(side: &PatchedMesh) -> Self {
        let landmarks = side.landmark_vertices.clone();
        Self { refined: side.refined(), stand_ins: landmarks.clone(), landmarks, weights: None }
    }

    /// The same mesh with the weights of the faces of the input mesh; `None` where all are skin.
    #[must_use]
    pub fn with_weights(self, of_input: Option<TiVec<FaceId, FaceWeight>>) -> Self {
        Self { weights: of_input.map(|of_input| Weights::new(of_input, &self.refined)), ..self }
    }

    /// The same mesh, `factor` times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { refined: self.refined.scaled(factor), ..self.clone() }
    }

    /// The weights of the faces of the refined mesh; all 1 where all are skin.
    pub fn weights(&self) -> FaceWeights<'_> {
        FaceWeights::new(self.weights_by_face())
    }

    /// The weights of the faces of the refined mesh; `None` where all are skin.
    pub(super) fn weights_by_face(&self) -> Option<&TiSlice<FaceId, FaceWeight>> {
        self.weights.as_ref().map(|weights| weights.of_refined.as_slice())
    }

    /// The same mesh with further points of the refined mesh as vertices, and the vertex of each; `landmarks` stay as they are.
    ///
    /// # Errors
    /// [`MeshError`] where a point cannot be inserted.
    pub(super) fn with_points(
        &self,
        input: &SurfaceMesh,
        points: &[SurfacePoint],
    ) -> Result<(Self, Vec<VertexId>), MeshError> {
        let (refined, vertices) = self.refined.with_points(input, points)?;
        Ok((self.refined_to(refined), vertices))
    }

    /// The same mesh, refined around further vertices of it so that a layout has room there.
    ///
    /// # Errors
    /// [`MeshError`] where a face cannot be bisected.
    pub(super) fn with_room_around(
        &self,
        input: &SurfaceMesh,
        vertices: &[VertexId],
    ) -> Result<Self, MeshError> {
        Ok(self.refined_to(self.refined.with_degrees(input, vertices.iter().copied(), LEAST_DEGREE)?))
    }

    /// The same mesh, refined further.
    fn refined_to(&self, refined: RefinedMesh) -> Self {
        let weights = self.weights.as_ref().map(|known| Weights::new(known.of_input.clone(), &refined));
        let both = self.landmarks.iter().zip(&self.stand_ins);
        let kept = both.map(|(&v, &w)| if may_go_into(&refined.mesh, v, w) { w } else { v });
        let (landmarks, stand_ins) = (self.landmarks.clone(), kept.collect());
        Self { refined, landmarks, stand_ins, weights }
    }

    /// The vertex that stands for each landmark on coarse levels: the landmark's own, or a neighbour that is much nearer than the others
    /// are on the mean.
    ///
    /// A landmark in a face that is very near an edge makes a needle there, whose long side is straight, while its image has to bend around the
    /// cone. So the landmark's foot on the edge is the cone as long as the needle is much smaller than a level's triangles.
    pub(super) fn stand_ins(&self) -> &TiSlice<LandmarkId, VertexId> {
        &self.stand_ins
    }

    /// Whether a neighbour stands for some landmark on coarse levels.
    pub fn has_stand_ins(&self) -> bool {
        self.stand_ins != self.landmarks
    }

    /// The same mesh, in which every landmark stands for itself on coarse levels.
    #[must_use]
    pub fn without_stand_ins(self) -> Self {
        Self { stand_ins: self.landmarks.clone(), ..self }
    }

    /// Makes a vertex a landmark, after those that there are.
    pub(super) fn push_landmark(&mut self, v: VertexId) {
        self.landmarks.push(v);
        self.stand_ins.push(v);
    }

    /// The mesh with a parametrisation.
    pub fn parametrised<'a>(&'a self, embedding: &'a Embedding) -> Parametrised<'a> {
        let (mesh, weights) = (&self.refined.mesh, self.weights());
        Parametrised { mesh, landmark_vertices: &self.landmarks, embedding, weights }
    }
}

/// The vertex that stands for each landmark on coarse levels. Landmarks whose surroundings have another landmark in them stand for themselves.
fn stand_ins(mesh: &SurfaceMesh, landmarks: &[VertexId]) -> TiVec<LandmarkId, VertexId> {
    let mut taken: FxHashSet<VertexId> = landmarks.iter().copied().collect();
    let around = |v: VertexId| mesh.star(v).map(|h| mesh.head(h));
    let mut stand_in = |&v: &VertexId| {
        let Some(near) = near_neighbour(mesh, v) else { return v };
        let is_free = |w: VertexId| w == v || !taken.contains(&w);
        let is_alone = around(v).chain(around(near)).all(is_free);
        if is_alone && may_go_into(mesh, v, near) && taken.insert(near) { near } else { v }
    };
    landmarks.iter().map(&mut stand_in).collect()
}

/// Whether two vertices are neighbours of which the first may be collapsed into the second (the link condition).
fn may_go_into(mesh: &SurfaceMesh, v: VertexId, into: VertexId) -> bool {
    let around = |v: VertexId| mesh.star(v).map(|h| mesh.head(h));
    let beside: FxHashSet<VertexId> = around(into).collect();
    beside.contains(&v) && around(v).filter(|w| beside.contains(w)).count() == 2
}

/// The neighbour of a vertex inside a plane that is much nearer than the others are on the mean.
fn near_neighbour(mesh: &SurfaceMesh, v: VertexId) -> Option<VertexId> {
    let nearest = mesh.star(v).min_by(|a, b| mesh.length(*a).total_cmp(&mesh.length(*b)))?;
    let others: Vec<f64> = mesh.star(v).filter(|h| *h != nearest).map(|h| mesh.length(h)).collect();
    let mean = others.iter().sum::<f64>() / others.len() as f64;
    (mesh.length(nearest) < NEAR * mean && is_in_a_plane(mesh, v)).then(|| mesh.head(nearest))
}

/// Whether all faces around a vertex lie in one plane, as those into which a landmark in a face divides it.
fn is_in_a_plane(mesh: &SurfaceMesh, v: VertexId) -> bool {
    let normal = |h: HalfedgeId| {
        let [a, b, c] = mesh.corners(h.face());
        (b - a).cross(c - a).normalize_or_zero()
    };
    let first = normal(mesh.outgoing(v));
    mesh.star(v).all(|h| normal(h).dot(first) > PARALLEL)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::insertion::insert;

    /// A ball with landmarks at points of its faces.
    fn with_landmarks(points: &[SurfacePoint]) -> LandmarkedMesh {
        let inserted = insert(&icosphere(2), points).unwrap();
        LandmarkedMesh::new(&inserted.mesh, &inserted.vertices).unwrap()
    }

    #[test]
    fn the_foot_on_an_edge_stands_for_a_landmark_that_is_very_near_it() {
        let at = |face, barycentric| SurfacePoint { face: FaceId(face), barycentric };
        let near_edge = at(10, [0.5, 0.4995, 5e-4]);
        let in_the_middle = at(200, [0.4, 0.3, 0.3]);
        let mesh = with_landmarks(&[near_edge, in_the_middle]);
        let [foot, itself] = [0, 1].map(|l| mesh.stand_ins()[LandmarkId(l)]);
        assert_eq!(itself, mesh.landmarks[LandmarkId(1)]);
        assert_ne!(foot, mesh.landmarks[LandmarkId(0)]);
        let on_edge = mesh.refined.vertex_origin[foot].barycentric;
        assert!(on_edge.iter().any(|w| *w < 1e-9) && on_edge.iter().all(|w| *w < 0.6), "{on_edge:?}");
    }

    #[test]
    fn landmarks_near_each_other_stand_for_themselves() {
        let at = |w: f64| SurfacePoint { face: FaceId(10), barycentric: [0.5 - w, 0.5 - 5e-4, w + 5e-4] };
        let mesh = with_landmarks(&[at(0.0), at(1e-3)]);
        assert_eq!(mesh.stand_ins(), mesh.landmarks.as_slice());
    }
}

//! A mesh with its coarse level.

use super::landmarked_mesh::LandmarkedMesh;
use super::rims::{RimOptions, kept_of_rims};
use super::skin::Skin;
use crate::landmarks::{LandmarkId, Landmarks};
use crate::mesh::coarsening::{Held, Level, coarsen_around};
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A mesh with its coarse level.
pub struct MeshWithCoarse<'a> {
    /// Area 1.
    pub(super) full: &'a SurfaceMesh,
    pub(super) landmarks: &'a TiSlice<LandmarkId, VertexId>,
    pub(super) mesh: CollapsibleMesh,
    /// How much faces count; `None` where all are skin.
    pub(super) skin: Option<Skin<'a>>,
    /// The coarse level.
    pub coarse: Level,
}

impl<'a> MeshWithCoarse<'a> {
    /// Coarsens a mesh to about `goal` vertices, the landmarks among them, and some vertices of the rims of caps.
    pub fn new(landmarked: &'a LandmarkedMesh, goal: usize, rims: RimOptions) -> Self {
        let (full, landmarks) = (&landmarked.refined.mesh, landmarked.landmarks.as_slice());
        let mut is_landmark = ti_vec![false; full.vertex_count()];
        landmarks.iter().for_each(|&v| is_landmark[v] = true);
        let mut is_kept: TiVec<VertexId, bool> = ti_vec![false; full.vertex_count()];
        let on_rims = kept_of_rims(full, landmarked.weights(), rims, goal);
        on_rims.into_iter().for_each(|v| is_kept[v] = true);
        let mut mesh = CollapsibleMesh::new(full);
        coarsen_around(&mut mesh, full.positions(), goal, Held { cones: &is_landmark, others: &is_kept });
        let coarse = Level::of(&mesh, full.positions());
        let skin = landmarked.weights_by_face().map(|weights| Skin::new(full, weights));
        Self { full, landmarks, mesh, skin, coarse }
    }

    /// The coarse level's vertex of each landmark.
    fn coarse_landmarks(&self) -> Vec<VertexId> {
        self.coarse.numbers(self.landmarks).collect()
    }
}

/// The landmarks on both coarse levels.
pub fn coarse_landmarks(meshes: &[MeshWithCoarse<'_>; 2]) -> Landmarks {
    let [source, target] = [0, 1].map(|k| meshes[k].coarse_landmarks());
    Landmarks { source, target }
}

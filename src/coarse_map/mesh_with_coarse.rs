//! A mesh with its coarse level.

use super::landmarked_mesh::LandmarkedMesh;
use super::rims::{RimOptions, kept_of_rims};
use super::skin::Skin;
use crate::landmarks::{LandmarkId, Landmarks};
use crate::mesh::coarsening::{Held, Level, coarsen_around, has_slivers};
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use crate::surface_map::parametrisation::level::Placing;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A mesh with its coarse level.
pub struct MeshWithCoarse<'a> {
    /// The full mesh, of area 1.
    pub(super) full: &'a SurfaceMesh,
    /// The vertex of each landmark on coarse levels.
    pub(super) landmarks: &'a TiSlice<LandmarkId, VertexId>,
    /// The vertex of each landmark on the full mesh.
    pub(super) heirs: &'a TiSlice<LandmarkId, VertexId>,
    pub(super) mesh: CollapsibleMesh,
    /// The weights of the full mesh's faces; `None` where all are skin.
    pub(super) skin: Option<Skin<'a>>,
    /// The coarse level.
    pub coarse: Level,
    /// Where its vertices are put when they return.
    pub(super) placing: Placing,
}

impl<'a> MeshWithCoarse<'a> {
    /// Coarsens a mesh to about `goal` vertices, the landmarks among them, and some vertices of the rims of caps.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        landmarked: &'a LandmarkedMesh,
        goal: usize,
        rims: RimOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let full = &landmarked.refined.mesh;
        let (landmarks, heirs) = (landmarked.stand_ins(), landmarked.landmarks.as_slice());
        let mut is_landmark = ti_vec![false; full.vertex_count()];
        landmarks.iter().for_each(|&v| is_landmark[v] = true);
        let mut is_kept: TiVec<VertexId, bool> = ti_vec![false; full.vertex_count()];
        let on_rims = kept_of_rims(full, landmarked.weights(), rims, goal);
        on_rims.into_iter().for_each(|v| is_kept[v] = true);
        monitor.step(Step::default())?;
        let mut mesh = CollapsibleMesh::new(full);
        for (&heir, &v) in heirs.iter().zip(landmarks).filter(|(heir, v)| heir != v) {
            // The surroundings of such landmarks are apart, so that no collapse changes those of another.
            full.halfedge_between(heir, v).into_iter().for_each(|h| mesh.collapse(h));
        }
        let held = Held { cones: &is_landmark, others: &is_kept };
        let placing = match has_slivers(&mesh, full.positions()) {
            true => Placing::SliversAsMapped,
            false => Placing::LowEnergy,
        };
        coarsen_around(&mut mesh, full.positions(), goal, held, monitor)?;
        let coarse = Level::of(&mesh, full.positions());
        let skin = landmarked.weights_by_face().map(|weights| Skin::new(full, weights));
        Ok(Self { full, landmarks, heirs, mesh, skin, coarse, placing })
    }

    /// The coarse level's vertex of each landmark.
    fn coarse_landmarks(&self) -> TiVec<LandmarkId, VertexId> {
        self.coarse.numbers(self.landmarks).collect()
    }
}

/// Coarsens both meshes.
///
/// # Errors
/// [`Cancelled`].
pub fn both<'a>(
    landmarked: &'a [LandmarkedMesh; 2],
    goal: usize,
    rims: RimOptions,
    monitor: &mut dyn Monitor,
) -> Result<[MeshWithCoarse<'a>; 2], Cancelled> {
    let source = MeshWithCoarse::new(&landmarked[0], goal, rims, &mut Portion::new(monitor, 0.0, 0.5))?;
    let target = MeshWithCoarse::new(&landmarked[1], goal, rims, &mut Portion::new(monitor, 0.5, 1.0))?;
    Ok([source, target])
}

/// The landmarks on both coarse levels.
pub fn coarse_landmarks(meshes: &[MeshWithCoarse<'_>; 2]) -> Landmarks {
    let [source, target] = [0, 1].map(|k| meshes[k].coarse_landmarks());
    Landmarks { source, target }
}

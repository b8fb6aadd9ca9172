//! The base domain drawn on both meshes, and how straight it is.

use super::bounds::detour;
use super::drawing::Drawing;
use super::landmark_distances::LandmarkDistances;
use crate::base_domain::BaseDomain;
use crate::landmarks::LandmarkId;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use typed_index_collections::TiVec;

/// The base domain and its drawing on both meshes.
#[derive(Clone, Debug)]
pub struct BaseLayout {
    /// The base domain, its landmarks at the target's positions.
    pub base: BaseDomain,
    /// The drawing on the source.
    pub source: PatchedMesh,
    /// The drawing on the target.
    pub target: PatchedMesh,
    /// Detours and stretch of the paths.
    pub report: LayoutReport,
}

/// A mesh refined along the paths of the base domain and cut into its patches.
#[derive(Clone, Debug)]
pub struct PatchedMesh {
    /// The refined mesh, scaled to area 1. Its first vertices are the input mesh's vertices in their order.
    pub mesh: SurfaceMesh,
    /// The place of each refined vertex on the input mesh.
    pub vertex_origin: TiVec<VertexId, SurfacePoint>,
    /// The input face that contains each refined face.
    pub face_origin: TiVec<FaceId, FaceId>,
    /// The base face whose patch contains each refined face.
    pub face_patch: TiVec<FaceId, FaceId>,
    /// The refined mesh's vertex of each landmark (= vertex of the base domain).
    pub landmark_vertices: TiVec<LandmarkId, VertexId>,
    /// For each base halfedge the refined vertices of its path, both landmarks included; a twin's path is the reverse.
    /// Consecutive vertices are joined by mesh edges, and the patch of the halfedge's face lies on the left.
    pub paths: TiVec<HalfedgeId, Vec<VertexId>>,
}

/// Detours and stretch of the paths of a layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LayoutReport {
    /// Sum over all paths of both meshes of max(0, length / shortest length - 1.1): 0 for straight layouts.
    pub detour: f64,
    /// The largest length / shortest length of a path.
    pub worst_stretch: f64,
    /// Orders of drawing that were tried.
    pub attempts: usize,
}

impl LayoutReport {
    /// The report of a drawing.
    pub(super) fn of(drawing: &Drawing, distances: &LandmarkDistances) -> Self {
        let mut report = Self { attempts: 1, ..Self::default() };
        for (path, &ends) in drawing.ends.iter().enumerate() {
            for (side, geodesic) in drawing.sides.iter().zip(distances.between(ends)) {
                let stretch = side.lengths[path] / geodesic;
                report.detour += detour(stretch);
                report.worst_stretch = report.worst_stretch.max(stretch);
            }
        }
        report
    }
}

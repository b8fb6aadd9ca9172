//! What a run gives.

use super::Report;
use crate::base_domain::BaseDomain;
use crate::mesh::{SurfacePoint, VertexId};
use crate::surface_map::transfer::CommonMesh;
use glam::DVec3;
use typed_index_collections::TiVec;

/// What a run gives.
#[derive(Clone, Debug)]
pub struct MapResult {
    /// The base domain, its vertices the landmarks at the target's positions.
    pub base: BaseDomain,
    /// Target curvature of each landmark, in radians: the cones.
    pub cone_curvatures: Vec<f64>,
    /// The map as one triangulation on both surfaces, with the target's texture. For the thesis' method: the source's
    /// triangles whose corners all have images.
    pub common: CommonMesh,
    /// The paths between the patches on the source and on the target, as line strips in input coordinates.
    pub patch_lines: [Vec<Vec<DVec3>>; 2],
    /// Image of each source vertex: a point of the target's input mesh. `None` where the thesis' method has none.
    pub target_from_source: TiVec<VertexId, Option<SurfacePoint>>,
    /// Distortion (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 around each source vertex; empty for the thesis' method.
    pub vertex_distortion: TiVec<VertexId, f64>,
    /// The numbers.
    pub report: Report,
}

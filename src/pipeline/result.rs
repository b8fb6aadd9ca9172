//! What a run gives.

use super::Report;
use crate::base_domain::BaseDomain;
use crate::mesh::{SurfacePoint, TexturedMesh, VertexId};
use glam::DVec3;
use typed_index_collections::TiVec;

/// What a run gives.
#[derive(Clone, Debug)]
pub struct MapResult {
    /// The base domain, its vertices the landmarks.
    pub base: BaseDomain,
    /// Target curvature of each landmark, in radians: the cones.
    pub cone_curvatures: Vec<f64>,
    /// The source with the target's texture.
    pub source: Side,
    /// The target with its own texture.
    pub target: Side,
    /// Image of each source vertex: a point of the target's input mesh. `None` where the thesis' method has none.
    pub target_from_source: TiVec<VertexId, Option<SurfacePoint>>,
    /// Distortion (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 around each source vertex; NaN where it has no image.
    pub vertex_distortion: TiVec<VertexId, f64>,
    /// The numbers.
    pub report: Report,
}

/// One surface as it is shown and written: input coordinates, not the scaled ones.
#[derive(Clone, Debug)]
pub struct Side {
    /// The surface with texture coordinates from the target's flat cone metric.
    pub textured: TexturedMesh,
    /// For each vertex of `textured` its position on the other surface, for morphs; NaN where there is none.
    pub other_positions: Vec<DVec3>,
    /// The paths between the patches, as line strips on the surface.
    pub patch_lines: Vec<Vec<DVec3>>,
    /// Positions of the landmarks.
    pub landmarks: Vec<DVec3>,
}

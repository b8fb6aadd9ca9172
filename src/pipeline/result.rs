//! The result of a run.

use super::Report;
use crate::base_domain::BaseDomain;
use crate::mesh::{FaceId, HalfedgeId, SurfacePoint, VertexId};
use crate::surface_map::correspondence::Correspondence;
use crate::surface_map::flat_layout::FlatLayout;
use crate::surface_map::measures::distortion::LocalDistortion;
use crate::surface_map::measures::transfer::CommonMesh;
use glam::{DVec2, DVec3};
use typed_index_collections::TiVec;

/// The result of a run.
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
    /// Image of each source vertex: a point of the target's input mesh. `None` where a method that maps patch by patch has none.
    pub target_from_source: TiVec<VertexId, Option<SurfacePoint>>,
    /// Distortion (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 around each source vertex; empty where there is no certificate.
    pub vertex_distortion: TiVec<VertexId, f64>,
    /// Distortion of each triangle of `common`; empty where there is no certificate, or no overlay.
    pub triangle_distortion: Vec<TriangleDistortion>,
    /// The map's pieces on both input meshes; `None` for all but the relaxed method, and where there is no overlay.
    pub correspondence: Option<Correspondence>,
    /// Both input meshes drawn on the base domain's flat triangles; `None` where there are no pieces, and where rounding keeps a side of the
    /// base domain from arriving.
    pub flat_layout: Option<FlatLayout>,
    /// Texture coordinates by corner of the target's input mesh; `None` where its flow failed.
    pub texture: Option<TiVec<HalfedgeId, DVec2>>,
    /// The numbers.
    pub report: Report,
}

impl MapResult {
    /// Distortion (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 around each vertex of `common`; empty for the thesis' method.
    pub fn common_vertex_distortion(&self) -> Vec<f64> {
        if self.triangle_distortion.is_empty() {
            return Vec::new();
        }
        let densities: Vec<f64> = self.triangle_distortion.iter().map(|t| t.local.density).collect();
        self.common.vertex_averages(&densities)
    }
}

/// Distortion on a triangle of the common subdivision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleDistortion {
    /// The face of the source's input mesh that holds the triangle.
    pub source_face: FaceId,
    /// The face of the target's input mesh that holds its image.
    pub target_face: FaceId,
    /// The measures.
    pub local: LocalDistortion,
}

//! The images of the base's vertices under the map.

use super::input::WrapInput;
use crate::math::scalar::{ln, max};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::mesh_side::MeshSide;
use glam::{DMat3, DVec3};
use typed_index_collections::TiVec;

/// Images of the base's vertices in space.
pub(super) struct Images {
    /// The image of each vertex; the origin for a vertex without one.
    pub positions: TiVec<VertexId, DVec3>,
    /// Whether a vertex belongs to the base's skin.
    pub is_skin: TiVec<VertexId, bool>,
    /// Whether a vertex of the base's skin has its image on the scan's skin.
    pub is_covered: TiVec<VertexId, bool>,
}

impl Images {
    /// Reads them off the map.
    pub fn new(input: &WrapInput<'_>) -> Self {
        let images = input.map.vertex_images([input.base, input.scan], MeshSide::Source);
        let is_skin: TiVec<VertexId, bool> =
            input.base.vertices().map(|v| input.base.star(v).any(|h| input.is_base_skin(h.face()))).collect();
        let is_covered = images
            .iter_enumerated()
            .map(|(v, image)| is_skin[v] && image.is_some_and(|point| input.is_scan_skin(point.face)));
        Self {
            is_covered: is_covered.collect(),
            positions: images
                .iter()
                .map(|image| image.map_or(DVec3::ZERO, |point| point.position(input.scan)))
                .collect(),
            is_skin,
        }
    }
}

/// The rotation and stretch of the surface around a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The rotation of the surface around the vertex.
    pub rotation: DMat3,
    /// The logarithm of the stretch: half that of the ratio of areas.
    pub log_stretch: f64,
}

/// The frames of vertices of the base, from their places in `onto`.
pub(super) fn frame(base: &SurfaceMesh, onto: &TiVec<VertexId, DVec3>, v: VertexId) -> Frame {
    let (mut before, mut after) = ([0.0, 0.0], [DVec3::ZERO; 2]);
    let mut along = [DVec3::ZERO; 2];
    for h in base.star(v) {
        let corners = base.triangles()[h.face()];
        for (k, [p, q, r]) in
            [corners.map(|w| base.positions()[w]), corners.map(|w| onto[w])].into_iter().enumerate()
        {
            let normal = (q - p).cross(r - p);
            after[k] += normal;
            before[k] += normal.length();
        }
        let w = base.head(h);
        let edges = [base.positions()[w] - base.positions()[v], onto[w] - onto[v]];
        if edges[0].length_squared() > along[0].length_squared() {
            along = edges;
        }
    }
    let axes = [0, 1].map(|k| axes(after[k], along[k]));
    let ratio = max(before[1], f64::MIN_POSITIVE) / max(before[0], f64::MIN_POSITIVE);
    Frame { rotation: axes[1] * axes[0].transpose(), log_stretch: 0.5 * ln(ratio) }
}

/// Orthonormal axes: along a normal, and along a direction beside it.
fn axes(normal: DVec3, along: DVec3) -> DMat3 {
    let normal = normal.normalize_or(DVec3::Z);
    let along = (along - normal * along.dot(normal)).normalize_or(normal.any_orthonormal_vector());
    DMat3::from_cols(along, normal.cross(along), normal)
}

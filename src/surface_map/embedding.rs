//! A seamless parametrisation of a refined mesh onto the flat cone surface.

use crate::math::rigid2::Rigid2;
use crate::mesh::{FaceId, HalfedgeId};
use glam::DVec2;
use typed_index_collections::TiVec;

/// A piecewise linear map from a [`crate::layout::PatchedMesh`] to a [`super::ConeSurface`].
///
/// Every mesh face is developed into the (endless) plane of one chart: that of its patch. A vertex may leave its patch:
/// its faces then reach over the chart's triangle in the same plane. Only transitions matter. Landmarks stay at the
/// charts' corners.
#[derive(Clone, Debug)]
pub struct Embedding {
    /// The base face in whose plane each mesh face is developed (its patch).
    pub face_chart: TiVec<FaceId, FaceId>,
    /// For each mesh halfedge the image of its start, in the chart plane of its face.
    pub corners: TiVec<HalfedgeId, DVec2>,
    /// For each mesh halfedge the rigid motion from the chart plane of its face to that of its twin's face: the identity
    /// inside a patch, the base halfedge's transition on a path. Fixed for the life of the embedding.
    pub transitions: TiVec<HalfedgeId, Rigid2>,
}

//! A face of a finer mesh inside a face of the mesh that it refines.

use super::{FaceId, Place, SurfaceMesh, SurfacePoint};
use glam::{DMat2, DVec2};

/// The place of a face in a face of a coarser mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceFrame {
    /// The face that contains it.
    pub face: FaceId,
    /// The weights of its three corners in that face.
    pub corners: [[f64; 3]; 3],
}

impl FaceFrame {
    /// Weights in the containing face of a point that is given by its weights in the face.
    pub fn weights(&self, [u, v, w]: [f64; 3]) -> [f64; 3] {
        let [p, q, r] = &self.corners;
        // Adding 0 makes -0 and 0 the same bits.
        [0, 1, 2].map(|k| p[k] * u + q[k] * v + r[k] * w + 0.0)
    }

    /// The derivative of [`Self::weights`]: from weights 1 and 2 in the face to weights 1 and 2 in the containing face.
    pub fn matrix(&self) -> DMat2 {
        let [p, q, r] = self.corners.map(|w| DVec2::new(w[1], w[2]));
        DMat2::from_cols(q - p, r - p)
    }
}

/// Carries places of a mesh to the mesh that it refines.
#[derive(Clone, Copy)]
pub struct Carrier<'a> {
    /// The finer mesh.
    pub from: &'a SurfaceMesh,
    /// The coarser mesh.
    pub onto: &'a SurfaceMesh,
    /// The place of each face of the finer mesh in the coarser one.
    pub frame: &'a dyn Fn(FaceId) -> FaceFrame,
}

impl Carrier<'_> {
    /// A place of the finer mesh on the coarser one.
    pub fn place(&self, place: Place) -> Place {
        let point = place.surface_point(self.from);
        let frame = (self.frame)(point.face);
        Place::of(self.onto, SurfacePoint { face: frame.face, barycentric: frame.weights(point.barycentric) })
    }
}

//! The common subdivision of source and target: pieces on which the map is affine, and its errors.

use crate::landmarks::MeshSide;
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId};
use crate::monitor::{Cancelled, OrStop};
use crate::surface_map::parametrisation::embedding::triangle;
use glam::DVec2;
use typed_index_collections::TiSlice;

/// Pieces of the common subdivision.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// One convex polygon for each connected part that a source and a target triangle share.
    pub pieces: Vec<Piece>,
    /// Corners of all pieces.
    pub points: Vec<OverlayPoint>,
    /// Number of different corners; every [`OverlayPoint::vertex`] is below it.
    pub vertex_count: usize,
    /// Largest relative difference between a source triangle's area on the cone surface and the sum of its pieces.
    pub source_area_defect: f64,
    /// Largest relative difference between a target triangle's area on the cone surface and the sum of its pieces.
    pub target_area_defect: f64,
    /// Pieces whose area is zero up to rounding. They stay in the list, so that the pieces cover both meshes without gaps.
    pub degenerate: usize,
    /// The number of times that the source was shifted to end coincidences.
    pub shifts: usize,
}

impl Overlay {
    /// Exchanges the roles of source and target.
    pub fn exchange_roles(&mut self) {
        for piece in &mut self.pieces {
            std::mem::swap(&mut piece.source_face, &mut piece.target_face);
            piece.motion = piece.motion.inverse();
        }
        for point in &mut self.points {
            std::mem::swap(&mut point.source, &mut point.target);
            point.edge_of = point.edge_of.other();
        }
        std::mem::swap(&mut self.source_area_defect, &mut self.target_area_defect);
    }
}

/// A convex polygon inside one source triangle and one target triangle.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Face of the refined source.
    pub source_face: FaceId,
    /// Face of the refined target.
    pub target_face: FaceId,
    /// Its corners in [`Overlay::points`], counter-clockwise; two corners only where two edges coincide.
    pub points: std::ops::Range<usize>,
    /// Area on the cone surface, never negative.
    pub area: f64,
    /// From the chart plane of the source face to that of the target face.
    pub motion: Rigid2,
}

/// A corner of a piece: the same point of the cone surface on both meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverlayPoint {
    /// Barycentric coordinates in the source face.
    pub source: [f64; 3],
    /// Barycentric coordinates in the target face.
    pub target: [f64; 3],
    /// Number of the corner, the same in all pieces around it.
    pub vertex: u32,
    /// The mesh on whose edge the piece's edge from this corner to the next lies.
    pub edge_of: MeshSide,
}

/// Why there is no overlay. Certified parametrisations that are not degenerate have one.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OverlayError {
    /// A source edge did not arrive at its end.
    #[error("source edge {}-{} was lost on the target", edge[0], edge[1])]
    Lost {
        /// Its vertices, of the refined source.
        edge: [usize; 2],
    },
    /// The edges around a landmark do not fit together.
    #[error("the source's edges around landmark vertex {vertex} are not in order on the target")]
    Landmark {
        /// The vertex of the refined source.
        vertex: usize,
    },
    /// A cell lies in more than one face of a mesh.
    #[error("a piece of source face {source_face} and target face {target_face} lies in other faces, too")]
    Mixed {
        /// A source face that it touches.
        source_face: usize,
        /// A target face that it touches.
        target_face: usize,
    },
    /// A cell's polygon is clockwise.
    #[error("the piece of source face {source_face} and target face {target_face} has area {area:.1e}")]
    Negative {
        /// Its source face.
        source_face: usize,
        /// Its target face.
        target_face: usize,
        /// Its area on the cone surface.
        area: f64,
    },
    /// The cells are not a sphere.
    #[error("the pieces have Euler characteristic {euler} instead of 2")]
    NotASphere {
        /// V - E + F.
        euler: i64,
    },
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl OrStop for OverlayError {
    fn is_stop(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

/// The signed area of a face in its plane.
pub(super) fn face_area(corners: &TiSlice<HalfedgeId, DVec2>, f: FaceId) -> f64 {
    let [p, q, r] = triangle(corners, f);
    0.5 * signed_double_area(p, q, r)
}

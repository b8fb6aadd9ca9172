//! The overlay: the common subdivision of source and target on the cone surface. It is the map.
//!
//! Every source edge is traced through the target's triangles; crossings are sorted along the target edges; the cells of
//! the planar map so cut out are the pieces, convex polygons on which the map is affine. A cell is found by combinatorics
//! alone, and the result is checked: V - E + F = 2, one source and one target face for every cell, no negative area, and
//! areas that sum to those of all source and all target faces.
//!
//! Where source and target coincide, at a vertex or along an edge, the combinatorics of rounded tests need not fit
//! together. The check finds that, and the overlay is made again with the source's free vertices moved by 1e-10 of their
//! shortest edge.

mod arrangement;
mod cells;
mod measure;
mod seats;
#[cfg(test)]
mod tests;
mod trace;

use super::compose::{Locations, Parametrised};
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId};
use arrangement::Arrangement;
use cells::Cells;
use glam::DVec2;
pub use measure::{Measure, MeasuredPiece, Segment};
use seats::Seats;
use trace::Traces;

/// How often the overlay is tried, all but the first time with the source shifted.
const ATTEMPTS: usize = 6;

/// Pieces of the common subdivision.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// One convex polygon for each connected part that a source and a target triangle share.
    pub pieces: Vec<Piece>,
    /// Corners of all pieces.
    pub points: Vec<OverlayPoint>,
    /// Number of different corners; [`OverlayPoint::vertex`] runs below it.
    pub vertex_count: usize,
    /// Largest relative difference between a source triangle's area on the cone surface and the sum of its pieces.
    pub source_area_defect: f64,
    /// Largest relative difference between a target triangle's area on the cone surface and the sum of its pieces.
    pub target_area_defect: f64,
    /// Pieces whose area is zero up to rounding. They stay in the list, so that the pieces cover both meshes without gaps.
    pub degenerate: usize,
    /// How often the source was shifted to end coincidences.
    pub shifts: usize,
}

impl Overlay {
    /// The same overlay with source and target exchanged.
    pub fn exchange_roles(&mut self) {
        for piece in &mut self.pieces {
            std::mem::swap(&mut piece.source_face, &mut piece.target_face);
            piece.motion = piece.motion.inverse();
        }
        for point in &mut self.points {
            std::mem::swap(&mut point.source, &mut point.target);
            point.side = match point.side {
                SideOf::Source => SideOf::Target,
                SideOf::Target => SideOf::Source,
            };
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

/// Which mesh's edge a side of a piece lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SideOf {
    /// A source edge.
    Source,
    /// A target edge.
    Target,
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
    /// What the side from this corner to the next lies on.
    pub side: SideOf,
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
}

/// Makes overlays; keeps its working memory from one to the next.
#[derive(Clone, Debug, Default)]
pub struct Overlayer {
    seats: Seats,
    traces: Traces,
    arrangement: Arrangement,
    cells: Cells,
}

impl Overlayer {
    /// Intersects source and target; `locations` are those of [`super::compose::locate`] for the same sides.
    ///
    /// Fills `overlay`, whose memory is used again. Time grows linearly with faces and crossings.
    ///
    /// # Errors
    /// [`OverlayError`], with `overlay` left in an unfinished state.
    pub fn fill(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        locations: &Locations,
        overlay: &mut Overlay,
    ) -> Result<(), OverlayError> {
        let mut result = Ok(());
        for attempt in 0..ATTEMPTS {
            result = self.attempt([source, target], locations, (attempt, overlay));
            if result.is_ok() {
                break;
            }
        }
        result
    }

    fn attempt(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        locations: &Locations,
        (attempt, overlay): (usize, &mut Overlay),
    ) -> Result<(), OverlayError> {
        self.seats.fill(source, target, locations, attempt)?;
        self.traces.fill(source, target, &self.seats)?;
        self.arrangement.fill(source, target, (&self.seats, &self.traces))?;
        overlay.shifts = attempt;
        self.arrangement.describe(source, target, (&self.seats, &self.traces));
        let parts = (&self.seats, &self.traces, &self.arrangement);
        self.cells.fill([source, target], parts, overlay)
    }
}

/// Intersects source and target; see [`Overlayer::fill`].
///
/// # Errors
/// [`OverlayError`].
pub fn overlay(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    locations: &Locations,
) -> Result<Overlay, OverlayError> {
    let mut overlay = Overlay::default();
    Overlayer::default().fill([source, target], locations, &mut overlay)?;
    Ok(overlay)
}

fn corners_of(corners: &typed_index_collections::TiSlice<HalfedgeId, DVec2>, f: FaceId) -> [DVec2; 3] {
    [0, 1, 2].map(|k| corners[HalfedgeId::of(f, k)])
}

fn face_area(corners: &typed_index_collections::TiSlice<HalfedgeId, DVec2>, f: FaceId) -> f64 {
    let [p, q, r] = corners_of(corners, f);
    0.5 * signed_double_area(p, q, r)
}

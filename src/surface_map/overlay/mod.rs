//! The overlay: the common subdivision of source and target on the cone surface. It is the map.
//!
//! Every source edge is traced through the target's triangles; crossings are sorted along the target edges; the cells of
//! the planar map so cut out are the pieces, convex polygons on which the map is affine. A cell is found by combinatorics
//! alone, and the result is checked: V - E + F = 2, one source and one target face for every cell, no negative area, and
//! areas that sum to those of all source and all target faces.

mod arrangement;
pub mod base_lines;
mod cells;
mod corner_locations;
pub mod location;
mod measure;
mod overlayer;
mod pieces;
#[cfg(test)]
mod tests;
mod trace;

pub use measure::{Measure, MeasuredPiece, Segment};
pub use overlayer::{Overlayer, overlay};
pub use pieces::{Overlay, OverlayError, OverlayPoint, Piece};

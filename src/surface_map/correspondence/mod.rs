//! The map between the input meshes: its pieces, with the place of every corner on the source and on the target.
//!
//! An overlay refers to refined meshes and a cone surface. A correspondence needs neither: on each piece the map is affine between
//! one face of the source and one of the target. Map files hold it, and all exported results are made from it.

mod by_face;
mod check;
mod locator;
mod measure;
mod pieces;
mod texture;

pub use by_face::PiecesByFace;
pub use check::{CorrespondenceFault, check};
pub use locator::PointLocator;
pub use measure::distortion;
pub(crate) use pieces::share;
pub use pieces::{Correspondence, MappedPiece, matrix_of_corners};
pub use texture::{TextureDrawing, TextureVertex, common_mesh};

//! Suggestions of landmarks on one mesh: ends of limbs, and points far from all others, with their partners under a symmetry; the mirror
//! plane of a mesh, and the partner of a point across it; and limbs without a landmark.

mod farthest;
mod limbs;
mod mirror;
mod partner;
mod suggestion;
mod symmetry;
mod tips;

pub use crate::math::mirror_plane::MirrorPlane;
pub use farthest::{Spread, farthest_points};
pub use limbs::unmarked_limbs;
pub use mirror::{Mirror, best_mirror, mirror_of};
pub use partner::{Partner, partner};
pub use suggestion::{Reason, Suggestion, USUAL_COUNT, kept, suggest};
pub use symmetry::partners;
pub use tips::tips;

//! Cones that the program adds: at ends of limbs without a landmark, and where the user gave few landmarks.
//!
//! Ends of limbs that both bodies have become cones where that lowers the mean log density, or hardly raises it (`limb_ends`).
//!
//! A cone surface with few cones is a poor image of a body with many limbs, and the descent of a map over it ends in a poor
//! minimum. So points are added and carried to the target by the present map; the map is solved again with all as cones.
//! Every round takes fresh points, so that those of the round before are free to move. Between two poses of one body the last rounds place
//! their points by maps that were refined first (`finer_levels`): there patches are registered.

mod best_images;
mod distance_guess;
mod finer_levels;
mod found;
mod limb_ends;
mod options;
mod own_points;
mod owners;
mod rounds;
mod start;

pub use best_images::share_elsewhere;
pub use found::{OwnCones, Refined, on_finer_level};
pub use options::OwnConeOptions;
pub use own_points::OwnPair;
pub use owners::{Owners, Rounds};
pub use rounds::{add, add_at};
pub use start::{OwnConeInput, Start};

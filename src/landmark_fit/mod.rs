//! Doubts about landmark pairs, found before a map is made: mirrored sets, swapped pairs, pairs on the wrong limb.
//!
//! A map of low distortion nearly keeps the distances between landmarks on both (coarse) meshes, areas scaled to 1, up to a
//! common factor: large log ratios point at misplaced pairs (`distances`). It also keeps which of two landmarks the
//! others are nearer to, and the cyclic order in which shortest paths leave them: where both are reversed, two pairs have each
//! other's target (`exchange`). Where orders (`orders`) and volumes in space (`chirality`) are reversed nearly everywhere, the set is
//! mirrored, which distances do not show.
//! A finding is a doubt with numbers and a repair, not an error: the user knows the shapes.

mod chirality;
mod directions;
mod distances;
mod doubts;
mod exchange;
mod finding;
mod orders;

pub use doubts::{LandmarkFit, MOST_COMPARED, landmark_fit};
pub use finding::{Finding, Repair};
pub use orders::order_agreement;

//! The base domain drawn on both meshes: corresponding paths between landmarks, corresponding patches.
//!
//! The edges of the base domain become paths of mesh edges on refined copies of both meshes (edges and faces that a
//! path crosses are split), non-crossing, with the same cyclic order at every landmark on both sides. The patches
//! between them are discs, one per base face (Kraevoy & Sheffer 2004). A spanning tree is drawn first, because a tree
//! never separates; then the shortest and straightest of the pairs not yet adjacent. [`joint()`] tries several orders and
//! keeps the drawing with the least detours; [`search()`] looks for the isotopy class whose map distorts least.

mod allowance;
mod base_layout;
mod bounds;
mod candidates;
mod descent;
mod draw;
mod drawing;
mod drawing_fault;
mod error;
mod isotopy;
mod joint;
mod landmark_distances;
mod patches;
mod path_search;
mod refinable;
mod search;
mod thinning;
mod twists;
mod variants;

pub use base_layout::{BaseLayout, LayoutReport, PatchedMesh};
pub use bounds::{MOST_DISTANCES, worst};
pub use candidates::{Candidate, Candidates};
pub use draw::{LayoutOptions, from_base, joint};
pub use error::LayoutError;
pub use isotopy::same_class;
pub use landmark_distances::LandmarkDistances;
pub use patches::PatchFault;
pub use search::{Judge, Judged, Origin, SearchOptions, SearchReport, neighbours, search, untwist};
pub use variants::TreeOrder;

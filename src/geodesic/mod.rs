//! Approximate geodesic distances: a front that settles each vertex once.
//!
//! Vertices are settled in the order of their distances, as in Dijkstra's algorithm. An edge whose ends are both settled sends
//! the front on as a circle about a point in the plane of the face beyond (Novotni & Klein 2002, section 3), to the far corner
//! and, where that will be settled later than what lies behind it, through further faces unfolded into the same plane (after
//! Kimmel & Sethian 1998, section 4).
//!
//! It ends by construction: an offer is never less than the distance of the vertex that was settled last, so a settled distance
//! never changes, whatever rounding does on slivers. Distances are exact on flat meshes. On coarse levels of real meshes they are 0.3 to
//! 0.6 % off in the mean; the worst are 10 % too large, or 20 % too small where fronts from two sides meet over long edges.

mod distance;
mod front;
mod many;
mod unfolding;

pub use distance::{distances, distances_within, shorten};
pub use many::ManyDistances;

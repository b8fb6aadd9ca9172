//! Handles are cut: along the shortest loop that leaves the surface in one piece, both rims closed by the same wall seen from its
//! two sides, again and again until none is left.
//!
//! A loop separates a closed surface exactly if it crosses every loop an even number of times. A shortest path tree and a spanning
//! tree of the faces beside it (tree and cotree; Eppstein 2003; Erickson & Whittlesey 2005, "Greedy optimal homotopy and homology
//! generators") leave two edges for each handle. The loops that these close cross every loop that does not separate, so that the
//! shortest of all is found from their vertices alone, each by the shortest paths of a ball around it (Erickson & Har-Peled 2004,
//! "Optimally cutting a surface into a disk").
//!
//! Limits: loops run along edges. Both walls are at one place: a body that is joined by places again, as from STL, has its handle back.

mod crossings;
mod cutting;
mod graph;
mod shortest;

pub(super) use crossings::MOST_HANDLES;
pub(super) use cutting::{WithoutHandles, without_handles};

//! Holes are closed by caps: a loop is filled with triangles (Barequet & Sharir 1995; Liepa 2003, "Filling holes in meshes"), these are
//! refined to the lengths at the rim, larger away from it, and faired.

mod capping;
mod fairing;
mod filling;
mod loops;
mod patch;
mod refinement;
mod wall;

pub(super) use capping::{Capped, capped};
pub(super) use wall::{CutRims, add_wall};

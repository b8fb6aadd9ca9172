//! A cut is closed by a wall without thickness.

use super::super::draft::Draft;
use super::capping::{add, rim_lengths};
use super::fairing::{Fairness, fair};
use super::filling::{Rim, filled};
use super::patch::Patch;
use super::refinement::refine;
use crate::monitor::{Cancelled, Monitor};
use glam::DVec3;
use rustc_hash::FxHashSet;

/// The two rims of a surface that was cut along a loop. Both follow the loop: equal places in them are at one place.
pub(in crate::mesh::repair) struct CutRims {
    /// The rim along which the faces beside it run as the loop does.
    pub along: Vec<u32>,
    /// The rim along which the faces beside it run against the loop.
    pub against: Vec<u32>,
}

/// Closes both rims by one membrane, seen from its two sides: two caps of their own could not but cross each other. `taken` are the
/// edges that the surface has between vertices of either rim, by their places along it.
///
/// # Errors
/// [`Cancelled`].
pub(in crate::mesh::repair) fn add_wall(
    draft: &mut Draft,
    rims: &CutRims,
    taken: FxHashSet<[u32; 2]>,
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    let places: Vec<DVec3> = rims.against.iter().map(|&v| draft.positions[v as usize]).collect();
    let beyond = vec![DVec3::ZERO; places.len()];
    let filling = filled(&Rim { places: &places, beyond: &beyond, taken: &taken });
    let points = places.iter().copied().chain(filling.middle).collect();
    let mut patch = Patch::new(points, places.len(), filling.triangles, taken);
    refine(&mut patch, &rim_lengths(&places), monitor)?;
    fair(&mut patch, &[], Fairness::Membrane, monitor)?;
    let inside = &patch.points[patch.rim..];
    add(draft, &rims.against, inside, patch.triangles.iter().copied());
    add(draft, &rims.along, inside, patch.triangles.iter().map(|&[a, b, c]| [a, c, b]));
    Ok(())
}

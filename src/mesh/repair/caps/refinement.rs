//! A cap gets vertices, as dense as at its rim and sparser away from it (Liepa 2003, section 4).

use super::patch::Patch;
use crate::monitor::{Cancelled, Monitor};
use glam::DVec3;

/// The growth of edge lengths with each unit of way from the rim: a wide hole needs few vertices in its middle. Chosen by hand.
const GROWTH: f64 = 0.12;

/// The divisor of the lengths at a triangle's corners: a triangle whose middle is farther from them than the quotient is divided.
const DENSITY: f64 = std::f64::consts::SQRT_2;

/// The largest number of rounds. Each divides every triangle that is too large in three. Chosen by hand.
const ROUNDS: usize = 40;

/// The largest number of vertices for each one of the rim: a limit that caps of sound rims do not reach.
const VERTICES: usize = 40;

/// Divides the triangles of a cap and makes them Delaunay; `lengths` are the means of both edges of the rim at each of
/// its vertices.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn refine(patch: &mut Patch, lengths: &[f64], monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
    let mut lengths = lengths.to_vec();
    // A vertex in the middle is as far from the rim as it is.
    for v in patch.rim..patch.points.len() {
        let near = patch.points[..patch.rim].iter().enumerate();
        let nearest = near.map(|(k, p)| (p.distance(patch.points[v]), lengths[k]));
        let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, 0.0));
        lengths.push(nearest.1 + GROWTH * nearest.0);
    }
    patch.flip_to_delaunay(monitor)?;
    let most = VERTICES * patch.rim + 100;
    for _ in 0..ROUNDS {
        let before = patch.points.len();
        for t in 0..patch.triangles.len() {
            if patch.points.len() >= most {
                break;
            }
            let corners = patch.corners(t);
            let middle: DVec3 = corners.iter().sum::<DVec3>() / 3.0;
            let away = corners.map(|p| p.distance(middle));
            let there = patch.triangles[t].map(|v| lengths[v as usize]);
            let length = (0..3).map(|k| there[k] + GROWTH * away[k]).sum::<f64>() / 3.0;
            if (0..3).all(|k| DENSITY * away[k] > length && DENSITY * away[k] > there[k]) {
                patch.split(t, middle);
                lengths.push(length);
            }
        }
        if patch.points.len() == before {
            break;
        }
        patch.flip_to_delaunay(monitor)?;
    }
    Ok(())
}

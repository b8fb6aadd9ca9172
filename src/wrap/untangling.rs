//! Faces that look the wrong way are turned back by sliding their corners.
//!
//! A face should have some of its wanted area, seen along the normal that it should have. What it lacks is given by the least motion
//! of its corners; all of them move across that normal, so along the surface. Faces are taken in turn until none lacks anything
//! (projections onto half-spaces; as position-based dynamics does it, Müller, Heidelberger, Hennix & Ratcliff 2007).

use super::orientation::Orientation;
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec3;
use typed_index_collections::{TiVec, ti_vec};

/// The largest number of rounds; each takes the faces around what moved in the one before. Chosen by hand.
const ROUNDS: usize = 300;

/// The least share of its wanted area that a face should have. Chosen by hand.
const LEAST: f64 = 0.1;

/// The share that is given of what a face lacks: a little more than all, so that rounding leaves nothing.
const GIVEN: f64 = 1.05;

/// Slides the corners of faces that look the wrong way; some may stay so.
pub(super) fn untangle(
    base: &SurfaceMesh,
    orientation: &Orientation,
    is_asked: impl Fn(FaceId) -> bool,
    positions: &mut TiVec<VertexId, DVec3>,
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    let mut active: Vec<FaceId> = base.faces().filter(|&f| is_asked(f)).collect();
    let mut is_active: TiVec<FaceId, bool> = ti_vec![false; base.face_count()];
    for round in 0..ROUNDS {
        monitor.step(Step { fraction: round as f64 / ROUNDS as f64, residual: None })?;
        let mut next = Vec::new();
        for f in active {
            is_active[f] = false;
            let wanted = orientation.wanted(f, base, positions, &is_asked);
            if !give(base, f, wanted, positions) {
                continue;
            }
            for v in base.triangles()[f] {
                for around in base.star(v).map(|h| h.face()).filter(|&f| is_asked(f)) {
                    if !std::mem::replace(&mut is_active[around], true) {
                        next.push(around);
                    }
                }
            }
        }
        if next.is_empty() {
            break;
        }
        next.sort_unstable();
        active = next;
    }
    Ok(())
}

/// Gives a face what it lacks of its area along the normal of `wanted`, twice its wanted area vector; `false` where it lacks nothing.
fn give(base: &SurfaceMesh, f: FaceId, wanted: DVec3, positions: &mut TiVec<VertexId, DVec3>) -> bool {
    let corners = base.triangles()[f];
    let [p, q, r] = corners.map(|v| positions[v]);
    let (normal, size) = (wanted.normalize_or_zero(), wanted.length());
    let lack = LEAST * size - normal.dot((q - p).cross(r - p));
    let slopes = [normal.cross(r - q), normal.cross(p - r), normal.cross(q - p)];
    let square: f64 = slopes.iter().map(|slope| slope.length_squared()).sum();
    // A face whose corners are one point cannot tell where they should go.
    if lack <= 0.0 || square <= 1e-12 * size || !lack.is_finite() {
        return false;
    }
    let step = GIVEN * lack / square;
    corners.iter().zip(slopes).for_each(|(&v, slope)| positions[v] += slope * step);
    true
}

//! The parts of the base without an image on the scan are laid beside those that have one, as rigidly as possible.

use super::images::{Frame, Images, frame};
use super::rigid_energy::{Anchor, RigidEnergy};
use crate::geodesic::distances_within;
use crate::math::scalar::max;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor};
use glam::DVec3;
use typed_index_collections::{TiVec, ti_vec};

/// The distance from what has no image within which images are held softly, in mean edges; the larger one of this and
/// [`SOFT_SHARE`] counts.
const SOFT_EDGES: f64 = 4.0;

/// That distance as a share of the root of the base's area. Chosen by hand.
const SOFT_SHARE: f64 = 0.02;

/// The weight of an image where softness ends, beside edges that count about 1. Chosen by hand.
const HOLD: f64 = 4.0;

/// The number of rounds in which stretches are evened out. Chosen by hand.
const SMOOTHINGS: usize = 10;

/// The places of the base's vertices: images on the scan, and what has none laid on as rigidly as it can be.
pub(super) fn extended(
    base: &SurfaceMesh,
    weights: &TiVec<HalfedgeId, f64>,
    images: &Images,
    monitor: &mut dyn Monitor,
) -> Result<TiVec<VertexId, DVec3>, Cancelled> {
    let hold = hold(base, images);
    let mut frames: TiVec<VertexId, Frame> =
        base.vertices().map(|v| frame(base, &images.positions, v)).collect();
    let mut positions = images.positions.clone();
    let moving: Vec<VertexId> = base.vertices().filter(|&v| hold[v] < 1.0).collect();
    if moving.is_empty() {
        return Ok(positions);
    }
    // What has an image all around tells how the base is turned and stretched.
    let is_solid =
        |&v: &VertexId| images.is_covered[v] && base.star(v).all(|h| images.is_covered[base.head(h)]);
    let (solid, torn): (Vec<VertexId>, Vec<VertexId>) = base.vertices().partition(is_solid);
    smooth_stretch(base, &solid, &mut frames);
    RigidEnergy::new(base, weights, torn, |_| None).spread_frames(&mut frames);
    // The free vertices are ordered from the rim on, so that what is missing as a whole begins whole.
    let free: Vec<VertexId> = moving.iter().copied().filter(|&v| !images.is_covered[v]).collect();
    RigidEnergy::new(base, weights, free, |_| None).place(&frames, &mut positions);
    let anchor = |v: VertexId| {
        let weight = HOLD * hold[v] * hold[v];
        (weight > 0.0).then_some(Anchor { weight, place: images.positions[v] })
    };
    RigidEnergy::new(base, weights, moving, anchor).relax(&mut frames, &mut positions, monitor)?;
    Ok(positions)
}

/// The weight with which each image holds.
fn hold(base: &SurfaceMesh, images: &Images) -> TiVec<VertexId, f64> {
    let is_lost = |&v: &VertexId| images.is_skin[v] && !images.is_covered[v];
    let lost: Vec<VertexId> = base.vertices().filter(is_lost).collect();
    let mean_edge = base.edges().map(|h| base.length(h)).sum::<f64>() / base.edge_count() as f64;
    let reach = max(SOFT_EDGES * mean_edge, SOFT_SHARE * base.area().sqrt());
    let far = distances_within(base, &lost, reach);
    let hold = |v: VertexId| if images.is_covered[v] { (far[v] / reach).min(1.0) } else { 0.0 };
    base.vertices().map(hold).collect()
}

/// Evens the stretches of some vertices out: a single one says little.
fn smooth_stretch(base: &SurfaceMesh, vertices: &[VertexId], frames: &mut TiVec<VertexId, Frame>) {
    let mut is_one: TiVec<VertexId, bool> = ti_vec![false; base.vertex_count()];
    vertices.iter().for_each(|&v| is_one[v] = true);
    for _ in 0..SMOOTHINGS {
        let before: TiVec<VertexId, f64> = frames.iter().map(|frame| frame.log_stretch).collect();
        for &v in vertices {
            let around = base.star(v).map(|h| base.head(h)).filter(|&w| is_one[w]);
            let (mut sum, mut count) = (before[v], 1.0);
            around.for_each(|w| (sum, count) = (sum + before[w], count + 1.0));
            frames[v].log_stretch = sum / count;
        }
    }
}

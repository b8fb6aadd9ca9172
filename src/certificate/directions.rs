//! Angles around a landmark.

use super::judged::{Judged, Start};
use crate::math::scalar::max;
use crate::math::triangle::turn;
use crate::mesh::{HalfedgeId, VertexId};
use glam::DVec2;
use std::f64::consts::PI;

/// Largest error of the direction of a line, in radians: its ends are known up to rounding, which turns short lines by more. Chosen by
/// hand.
pub(super) const ANGLE_TOLERANCE: f64 = 1e-5;

/// Largest difference of a direction's length from 1: above rounding, and far below what lengths of lines are held to.
const UNIT_TOLERANCE: f64 = 1e-9;

/// The corners around a vertex, counter-clockwise, each with the angle at which it begins.
pub(super) struct Around {
    corners: Vec<(HalfedgeId, f64)>,
    /// The angle around the vertex, in radians.
    pub(super) total: f64,
}

impl Around {
    pub(super) fn new(judged: &Judged<'_>, v: VertexId) -> Self {
        let (mut corners, mut total) = (Vec::new(), 0.0);
        for h in judged.mesh.star(v) {
            corners.push((h, total));
            total += corner_angle(judged, h);
        }
        Self { corners, total }
    }

    /// The angle of a direction, in radians from the first corner's side; NaN where it does not start here, lies outside of its
    /// corner, or is no unit vector.
    pub(super) fn angle(&self, judged: &Judged<'_>, start: &Start) -> f64 {
        let Some((_, begin)) = self.corners.iter().find(|(corner, _)| *corner == start.corner) else {
            return f64::NAN;
        };
        let along = judged.corners[start.corner.next()] - judged.corners[start.corner];
        let turn = signed_angle(along, start.direction);
        let excess = max(-turn, turn - corner_angle(judged, start.corner));
        let is_unit = (start.direction.length() - 1.0).abs() <= UNIT_TOLERANCE;
        if is_unit && excess <= ANGLE_TOLERANCE { begin + turn } else { f64::NAN }
    }

    /// The difference of two angles around the vertex, at most half of the total.
    pub(super) fn difference(&self, a: f64, b: f64) -> f64 {
        let turned = (a - b).rem_euclid(self.total);
        turned.min(self.total - turned)
    }
}

/// The angle of the corner at which a halfedge starts, in radians.
fn corner_angle(judged: &Judged<'_>, h: HalfedgeId) -> f64 {
    let [p, q, r] = [h, h.next(), h.prev()].map(|c| judged.corners[c]);
    signed_angle(q - p, r - p)
}

/// The angle from one direction to another, counter-clockwise, above -pi and at most pi.
fn signed_angle(from: DVec2, to: DVec2) -> f64 {
    let angle = turn(from, to);
    if angle <= -PI { PI } else { angle }
}

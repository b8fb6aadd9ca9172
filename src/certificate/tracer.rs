//! The tracer of straight lines over the triangles of a parametrised mesh.

use super::judged::{Judged, Start};
use crate::math::predicates::orient2d;
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use glam::DVec2;

/// A straight line from vertex to vertex.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// The corner at which it begins.
    pub begin: HalfedgeId,
    /// The halfedges by which it leaves faces, each with the place where it crosses: 0 at the halfedge's start, 1 at its end.
    pub crossings: Vec<(HalfedgeId, f64)>,
    /// Its end; `None` where it misses its goal.
    pub end: Option<End>,
}

/// The end of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// The corner at which it arrives, with the direction back.
    pub back: Start,
    /// The distance between the end of the line and the corner, in units of sqrt(area).
    pub error: f64,
}

/// The prescribed end of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    /// The vertex.
    pub vertex: VertexId,
    /// The length of the line, in units of sqrt(area).
    pub length: f64,
    /// The largest distance between the end of the line and a corner of the vertex at which the line has arrived.
    pub tolerance: f64,
}

/// Follows the line from `start` towards its goal.
pub(super) fn trace(judged: &Judged<'_>, start: &Start, goal: &Goal) -> Line {
    let mut line = Line { begin: start.corner, crossings: Vec::new(), end: None };
    let origin = judged.corners[start.corner];
    let ends = [origin, origin + start.direction * goal.length];
    let (mut face, mut motion) = (start.corner.face(), Rigid2::IDENTITY);
    let mut exit = start.corner.next();
    // A line crosses a triangle more than once only where the surface is thin.
    for _ in 0..4 * judged.mesh.face_count() {
        let [p, q] = ends.map(|end| motion.apply(end));
        if let Some(corner) = corner_near(judged, face, goal, q) {
            let back = Start { corner, direction: (p - q).normalize_or_zero() };
            line.end = Some(End { back, error: judged.corners[corner].distance(q) });
            return line;
        }
        let [a, b] = [judged.corners[exit], judged.corners[exit.next()]];
        // Beyond the end there is nothing to follow.
        if (q - a).dot((b - a).perp()) > 0.0 {
            return line;
        }
        line.crossings.push((exit, place([p, q], [a, b])));
        motion = judged.transitions[exit].after(&motion);
        let entered = judged.mesh.twin(exit);
        face = entered.face();
        let [p, q] = ends.map(|end| motion.apply(end));
        let opposite = judged.corners[entered.prev()];
        // A line that passes the opposite corner on its right leaves by the edge before it.
        exit = if is_left(p, q, opposite) { entered.next() } else { entered.prev() };
    }
    line
}

/// The corner of a face at which a line that ends at a point has arrived.
fn corner_near(judged: &Judged<'_>, face: FaceId, goal: &Goal, end: DVec2) -> Option<HalfedgeId> {
    let corners = [0, 1, 2].map(|k| HalfedgeId::of(face, k));
    let is_near = |c: &HalfedgeId| {
        judged.mesh.tail(*c) == goal.vertex && judged.corners[*c].distance(end) <= goal.tolerance
    };
    corners.into_iter().find(is_near)
}

/// Whether a point lies to the left of the line from p to q.
fn is_left(p: DVec2, q: DVec2, point: DVec2) -> bool {
    orient2d(p, q, point) > 0.0
}

/// The place, from 0 to 1, at which the line through p and q crosses the segment a b.
fn place([p, q]: [DVec2; 2], [a, b]: [DVec2; 2]) -> f64 {
    let [from_a, from_b] = [a, b].map(|end| signed_double_area(p, q, end));
    let share = from_a / (from_a - from_b);
    if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) }
}

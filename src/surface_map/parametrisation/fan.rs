//! The base faces around a landmark: angles of directions around the cone, and motions from chart to chart.

use super::cone_surface::ConeSurface;
use super::embedding::{Anchor, Embedding, Parametrised};
use crate::landmarks::LandmarkId;
use crate::math::rigid2::{Rigid2, complex_mul};
use crate::math::scalar::{cos, sin};
use crate::math::triangle::{angle_from_lengths, turn};
use crate::mesh::HalfedgeId;
use glam::DVec2;
use std::sync::Arc;

/// The base faces around a landmark, counter-clockwise. Angles, in radians, are counted from the first base halfedge, and go on growing
/// with each turn around the cone.
pub struct Fan<'a> {
    surface: &'a ConeSurface,
    /// Base halfedges that start at the landmark.
    spokes: Vec<Spoke>,
    /// Angle of the whole cone.
    pub total: f64,
}

/// A base halfedge that starts at a landmark.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    halfedge: HalfedgeId,
    angle: f64,
}

/// A face of a mesh at a landmark with the angles that it covers.
#[derive(Clone, Copy, Debug)]
pub struct Wedge {
    /// The halfedge that starts at the landmark.
    pub corner: HalfedgeId,
    /// Angle of that halfedge.
    pub begin: f64,
    /// Angle of the face.
    pub width: f64,
    /// From the plane of the anchor's face to that of this face.
    pub motion: Rigid2,
}

/// Whole turns around a cone, at most: more occur only where rounding has left a cone angle without meaning. Chosen by hand.
const MOST_TURNS: i64 = 10_000;

impl<'a> Fan<'a> {
    /// The fan of a landmark.
    pub fn new(surface: &'a ConeSurface, landmark: LandmarkId) -> Self {
        let mut total = 0.0;
        let mut spokes = Vec::new();
        for h in surface.base.star(landmark) {
            spokes.push(Spoke { halfedge: h, angle: total });
            let lengths = [h, h.prev()].map(|x| surface.lengths[x]);
            total += angle_from_lengths(surface.lengths[h.next()], lengths);
        }
        Self { surface, spokes, total }
    }

    /// The angle of a base halfedge; `None` where it does not start at the landmark.
    pub fn angle_of(&self, h: HalfedgeId) -> Option<f64> {
        self.spokes.iter().find(|spoke| spoke.halfedge == h).map(|spoke| spoke.angle)
    }

    /// The number in the fan of an anchor's chart.
    fn place(&self, anchor: &Anchor) -> usize {
        self.spokes.iter().position(|spoke| spoke.halfedge.face() == anchor.chart).unwrap_or(0)
    }

    /// The angle of a direction given in the plane of the anchor's face; within half a turn of the middle of its chart.
    pub fn angle(&self, anchor: &Anchor, direction: DVec2) -> f64 {
        let place = self.place(anchor);
        let Spoke { halfedge: base, angle: begin } = self.spokes[place];
        let end = self.spokes.get(place + 1).map_or(self.total, |next| next.angle);
        let half = 0.5 * (end - begin);
        let corners = self.surface.charts[anchor.chart];
        let axis = anchor.motion.rotate(corners[base.next().corner()] - corners[base.corner()]);
        let middle = complex_mul(axis, DVec2::new(cos(half), sin(half)));
        begin + half + turn(middle, direction)
    }

    /// The faces around the landmark, counter-clockwise from the anchor.
    pub fn wedges<'s>(
        &self,
        side: Parametrised<'s>,
        anchor: &Anchor,
    ) -> impl Iterator<Item = Wedge> + use<'s> {
        let corners = &side.embedding.corners;
        let first = anchor.corner;
        let mut begin = self.angle(anchor, corners[first.next()] - corners[first]);
        let mut motion = Rigid2::IDENTITY;
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let corner = next?;
            let [p, q, r] = [corner, corner.next(), corner.prev()].map(|h| corners[h]);
            let width = turn(q - p, r - p);
            let wedge = Wedge { corner, begin, width, motion };
            begin += width;
            motion = side.embedding.transitions[corner.prev()].after(&motion);
            next = Some(side.mesh.twin(corner.prev())).filter(|&h| h != first);
            Some(wedge)
        })
    }

    /// The motion from the chart at `place` to the chart at `to`, a number that goes on growing around the cone.
    fn around(&self, place: usize, to: i64) -> Rigid2 {
        let n = self.spokes.len() as i64;
        let transitions = &self.surface.transitions;
        let mut motion = Rigid2::IDENTITY;
        let mut at = place as i64;
        let to = to.clamp(at - MOST_TURNS * n, at + MOST_TURNS * n);
        while at < to {
            // Counter-clockwise: out through the edge that ends at the landmark.
            motion = transitions[self.spokes[at.rem_euclid(n) as usize].halfedge.prev()].after(&motion);
            at += 1;
        }
        while at > to {
            motion = transitions[self.spokes[at.rem_euclid(n) as usize].halfedge].after(&motion);
            at -= 1;
        }
        motion
    }

    /// The motion from the plane of one anchor's face to that of another's, `turns` whole turns back around the cone.
    pub fn between(&self, from: &Anchor, to: &Anchor, turns: i64) -> Rigid2 {
        let goal = (self.place(to) as i64).saturating_sub(turns.saturating_mul(self.spokes.len() as i64));
        let charts = self.around(self.place(from), goal);
        to.motion.after(&charts).after(&from.motion.inverse())
    }

    /// The same anchor with the chart that contains an angle, that of its halfedge.
    pub fn recharted(&self, anchor: &Anchor, angle: f64) -> Anchor {
        let n = self.spokes.len() as i64;
        let turns = (angle / self.total).floor();
        let rest = angle - turns * self.total;
        let inside = self.spokes.iter().rposition(|spoke| spoke.angle <= rest).unwrap_or(0);
        let to = (turns as i64).saturating_mul(n).saturating_add(inside as i64);
        let motion = anchor.motion.after(&self.around(self.place(anchor), to).inverse());
        Anchor { corner: anchor.corner, chart: self.spokes[inside].halfedge.face(), motion }
    }
}

impl Embedding {
    /// Moves every anchor to the chart that contains its halfedge: relaxations turn the planes around the cones, and angles are known only
    /// within half a turn of the anchor's chart.
    pub fn normalise_anchors(&mut self, surface: &ConeSurface) {
        let normalised = |(landmark, anchor): (LandmarkId, &Anchor)| {
            let edge = self.corners[anchor.corner.next()] - self.corners[anchor.corner];
            let fan = Fan::new(surface, landmark);
            fan.recharted(anchor, fan.angle(anchor, edge))
        };
        self.anchors = Arc::new(self.anchors.iter_enumerated().map(normalised).collect());
    }
}

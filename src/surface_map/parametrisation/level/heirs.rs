//! Landmarks that pass from a vertex of coarse levels to its neighbour at full resolution.

use super::{Anchor, Fan, NoPlace, ParametrisedLevel, Restored};
use crate::landmarks::LandmarkId;
use crate::math::rigid2::{Rigid2, complex_mul};
use crate::math::scalar::{cos, sin};
use crate::math::triangle::{angle_at, turn};
use crate::mesh::{HalfedgeId, VertexId};
use glam::DVec2;
use std::f64::consts::{PI, TAU};

impl ParametrisedLevel<'_> {
    /// Makes a vertex that was restored without a place the landmark that its neighbour was, into which it had been collapsed: it takes the
    /// neighbour's place at the cone, and the neighbour moves aside.
    ///
    /// # Errors
    /// [`NoPlace`] where the star of the neighbour has no kernel then; the vertex is removed again.
    pub(super) fn hand_over(&mut self, restored: Restored) -> Result<VertexId, NoPlace> {
        let h = self.mesh.outgoing(restored.vertex);
        let (t, heir, former) = (self.mesh.twin(h), self.mesh.tail(h), self.mesh.head(h));
        let Some(landmark) = self.landmark_at(former) else {
            self.remove_again(restored);
            return Err(NoPlace);
        };
        let anchor = self.anchor_of_heir(landmark, h);
        // The cone's holonomy was around the neighbour; the way around it becomes that across the edge.
        let mut motion = Rigid2::IDENTITY;
        let mut g = h.next();
        while g != t {
            motion = self.transitions[g].after(&motion);
            g = self.mesh.twin(g).next();
        }
        self.transitions[h] = motion;
        self.transitions[t] = motion.inverse();
        // In the vertex' other faces its corner is at the cone already.
        self.corners[h] = self.corners[h.next()];
        self.corners[t.next()] = self.corners[t];
        self.look_around(h.next());
        let Some(place) = self.place_aside(h) else {
            self.remove_again(restored);
            return Err(NoPlace);
        };
        for (g, motion) in self.star.halfedges.iter().zip(&self.star.motions) {
            self.corners[*g] = motion.apply(place);
        }
        self.is_landmark[former] = false;
        self.is_landmark[heir] = true;
        self.is_heir[heir] = false;
        self.anchors[landmark] = anchor;
        Ok(heir)
    }

    /// The anchor of the landmark at the end of `h`, moved around it to the first face beside `h` and there over to the start.
    fn anchor_of_heir(&self, landmark: LandmarkId, h: HalfedgeId) -> Anchor {
        let mut anchor = self.anchors[landmark];
        let mut angle = self.angle(landmark, &anchor);
        while anchor.corner != h.next() {
            angle += self.width(anchor.corner);
            let across = anchor.corner.prev();
            anchor.corner = self.mesh.twin(across);
            anchor.motion = self.transitions[across].after(&anchor.motion);
        }
        // The face across lies in the same plane, and its halfedge from the start has the same direction from the cone.
        anchor.corner = self.mesh.twin(h.prev());
        Fan::new(&self.surface, landmark).recharted(&anchor, angle)
    }

    /// A place beside the cone for the end of `h`, whose star is filled from the halfedge after `h` on; `None` where the star has no kernel.
    ///
    /// Energies weigh triangles by their areas, and hardly see the needles beside it, which would hinder the relaxation: the least of the
    /// worst distortion is taken.
    fn place_aside(&mut self, h: HalfedgeId) -> Option<DVec2> {
        let low = self.place(self.mesh.head(h));
        let step = self.step_aside(h);
        let aside = ASIDE.map(|factor| self.star.ring[1] + step * factor);
        let all = aside.into_iter().chain(low).filter(|z| self.star.turns_once(*z));
        all.min_by(|a, b| self.star.worst(*a).total_cmp(&self.star.worst(*b)))
    }

    /// The way from the cone, at the start of `h`, to the end of `h` as on the mesh, with angles and lengths scaled to those that their common
    /// neighbours have at the cone.
    fn step_aside(&self, h: HalfedgeId) -> DVec2 {
        let ring = &self.star.ring;
        let (left, right) = (ring[0] - ring[1], ring[2 % ring.len()] - ring[1]);
        let t = self.mesh.twin(h);
        let corners =
            [self.mesh.tail(h), self.mesh.head(h), self.mesh.tail(h.prev()), self.mesh.tail(t.prev())];
        let [start, end, on_left, on_right] = corners.map(|v| self.positions[v]);
        let (after, before) = (angle_at(start, on_right, end), angle_at(start, end, on_left));
        let free = turn(right, left).rem_euclid(TAU);
        let share = after / (after + before);
        // Triangles on both sides have angles below half a turn.
        let is_possible = free * share.max(1.0 - share) < 0.99 * PI;
        let angle = free * if is_possible { share } else { 0.5 };
        let scale = left.length() * right.length() / (start.distance(on_left) * start.distance(on_right));
        let length = scale.sqrt() * start.distance(end);
        complex_mul(right.normalize_or_zero(), DVec2::new(cos(angle), sin(angle))) * length
    }
}

/// The lengths at which the former landmark is tried beside the cone, in units of that of the mesh. Chosen by hand.
const ASIDE: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];

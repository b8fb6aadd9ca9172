//! Edges are flipped towards six neighbours a vertex.

use super::working::{Fit, Working};
use crate::math::triangle::angle_at;
use crate::mesh::HalfedgeId;
use crate::monitor::{Cancelled, Pulse};
use std::f64::consts::PI;

/// The least excess over pi of the angles across an edge that is flipped, so that rounding decides nothing.
const CLEARLY: f64 = 1e-6;

impl Working<'_> {
    /// Flips every edge whose other diagonal brings the vertices nearer to six neighbours, or as near and is Delaunay.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn flip_towards_six(&mut self, pulse: &mut Pulse<'_>) -> Result<(), Cancelled> {
        let edges: Vec<_> = self.edges().collect();
        for h in edges {
            pulse.beat()?;
            if !self.is_sharp(h) && self.is_worth_flipping(h) {
                self.mesh.flip(h);
            }
        }
        Ok(())
    }

    fn is_worth_flipping(&self, h: HalfedgeId) -> bool {
        let t = self.mesh.twin(h);
        let [i, j, k, l] = [h, t, h.prev(), t.prev()].map(|h| self.mesh.tail(h));
        let excess = |v, change: i64| {
            let excess = self.mesh.star(v).count() as i64 + change - 6;
            excess * excess
        };
        let sum =
            |at_edge, across| excess(i, at_edge) + excess(j, at_edge) + excess(k, across) + excess(l, across);
        let gain = sum(0, 0) - sum(-1, 1);
        if gain < 0 {
            return false;
        }
        let [p, q, r, s] = [i, j, k, l].map(|v| self.places[v]);
        let before = Fit::of([p, q, r]).worse(Fit::of([q, p, s]));
        let after = Fit::of([s, r, p]).worse(Fit::of([r, s, q]));
        let (a, b, c, d) = (p.position, q.position, r.position, s.position);
        let is_delaunay = || angle_at(c, a, b) + angle_at(d, a, b) <= PI + CLEARLY;
        after.may_replace(before) && (gain > 0 || !is_delaunay())
    }
}

//! Long edges are split, short ones collapsed.

use super::creases::Kind;
use super::working::{Fit, Place, Working, distance};
use crate::math::scalar::min;
use crate::mesh::{HalfedgeId, VertexId};
use crate::monitor::{Cancelled, Pulse};

/// The largest distance from the surface, as a share of the longest allowed edge, within which a vertex may be collapsed: the ends
/// of limbs stay. Chosen by hand.
const DEVIATION: f64 = 0.25;
/// The largest number of neighbours that a vertex gets. Chosen by hand.
const MOST_NEIGHBOURS: usize = 12;

impl Working<'_> {
    /// Splits the edges that are longer at their midpoints, the longest first, until there is none.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn split_longer_than(&mut self, limit: f64, pulse: &mut Pulse<'_>) -> Result<(), Cancelled> {
        loop {
            let mut long: Vec<_> =
                self.edges().map(|h| (self.length(h), h)).filter(|(length, _)| *length > limit).collect();
            if long.is_empty() {
                return Ok(());
            }
            long.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for (_, h) in long {
                pulse.beat()?;
                // An earlier split may have put another edge in its place.
                if self.length(h) > limit {
                    self.split(h);
                }
            }
        }
    }

    fn split(&mut self, h: HalfedgeId) {
        let ends = [self.mesh.tail(h), self.mesh.head(h)];
        let [a, b] = ends.map(|v| self.places[v]);
        let across = [h, self.mesh.twin(h)].map(|h| self.places[self.mesh.tail(h.prev())].position);
        let normal = (b.position - a.position).cross(across[0] - across[1]).normalize_or_zero();
        let normal = if (a.normal + b.normal).dot(normal) > 0.0 { normal } else { a.normal };
        let middle = self.mesh.split(h);
        self.places.push(Place { position: a.position.midpoint(b.position), normal, near: a.near });
        self.creases.split(ends, middle);
    }

    /// Collapses edges that are shorter, the shortest first, into one of their ends: where no edge gets longer than `longest`, no
    /// triangle turns over, and the surface is kept.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn collapse_shorter_than(
        &mut self,
        limit: f64,
        longest: f64,
        pulse: &mut Pulse<'_>,
    ) -> Result<(), Cancelled> {
        loop {
            let mut short: Vec<_> =
                self.edges().map(|h| (self.length(h), h)).filter(|(length, _)| *length < limit).collect();
            short.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let before = self.mesh.live_vertices();
            for (_, h) in short {
                pulse.beat()?;
                // Faces vanish, and with them halfedges.
                if self.mesh.is_face_alive(h.face()) && self.length(h) < limit {
                    self.collapse_either_way(h, longest);
                }
            }
            // Where many went, many more may go.
            if 50 * (before - self.mesh.live_vertices()) < before {
                return Ok(());
            }
        }
    }

    /// Collapses an edge in the direction that changes the surface less, if any is allowed.
    fn collapse_either_way(&mut self, h: HalfedgeId, longest: f64) {
        let ways = [h, self.mesh.twin(h)].map(|h| (self.deviation(h, longest), h));
        let best = if ways[1].0 < ways[0].0 { ways[1] } else { ways[0] };
        if best.0 < DEVIATION * longest {
            let h = best.1;
            let (removed, kept) = (self.mesh.tail(h), self.mesh.head(h));
            let neighbours: Vec<_> = self.mesh.star(removed).map(|g| self.mesh.head(g)).collect();
            self.mesh.collapse(h);
            self.creases.collapse(removed, kept, &neighbours);
        }
    }

    /// Distance of the start of `h` from the surface after it has gone into the end; infinite where it must not go.
    fn deviation(&self, h: HalfedgeId, longest: f64) -> f64 {
        let (v, into) = (self.mesh.tail(h), self.mesh.head(h));
        if !self.keeps_creases(h) || !self.mesh.link_condition(h) {
            return f64::INFINITY;
        }
        let (from, place) = (self.places[v].position, self.places[into]);
        let (mut fit, mut deviation) = (Fit::BEST, f64::INFINITY);
        for g in self.mesh.star(v) {
            let corners = [self.mesh.head(g), self.mesh.tail(g.prev())];
            if corners.contains(&into) {
                continue;
            }
            let [p, q] = corners.map(|w| self.places[w]);
            if p.position.distance(place.position) > longest {
                return f64::INFINITY;
            }
            fit = fit.worse(Fit::of([place, p, q]));
            deviation = min(deviation, distance(from, [place.position, p.position, q.position]));
        }
        let neighbours = self.mesh.star(v).count() + self.mesh.star(into).count() - 4;
        let allowed = neighbours <= MOST_NEIGHBOURS && fit.may_replace(self.fit_around(v, self.places[v]));
        if allowed { deviation } else { f64::INFINITY }
    }

    /// Whether the vertex at the start of `h` may go into the end without harm to a sharp edge.
    fn keeps_creases(&self, h: HalfedgeId) -> bool {
        let (v, into) = (self.mesh.tail(h), self.mesh.head(h));
        let neighbours = || self.mesh.star(v).map(|g| self.mesh.head(g));
        match self.creases.kind(v) {
            Kind::Free => true,
            Kind::Corner => false,
            // The vertex goes along its edge, unless that is part of a closed chain of three.
            Kind::Along(_) => {
                self.is_sharp(h)
                    && neighbours()
                        .filter(|&w| w != into && self.creases.chain([v, w]).is_some())
                        .all(|w: VertexId| self.creases.chain([w, into]).is_none())
            }
        }
    }
}

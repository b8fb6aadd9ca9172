//! Vertices move in their tangent planes, and back onto the surface.

use super::creases::{ChainPoint, Kind};
use super::working::{Place, Working, distance};
use crate::math::scalar::min;
use crate::math::triangle;
use crate::mesh::{HalfedgeId, VertexId};
use crate::monitor::{Cancelled, Pulse};
use glam::DVec3;
use typed_index_collections::{TiVec, ti_vec};

/// The largest distance of a vertex's old place from the new triangles, as a share of an edge: rims and valleys stay. Chosen by
/// hand.
const DEVIATION: f64 = 0.1;
/// A search for the nearest point of the surface takes about as long as so many looks at an edge.
pub(super) const SEARCH: usize = 8;

impl Working<'_> {
    /// Moves every vertex once towards the mean of its neighbours by area, or of its two neighbours along a sharp edge; as far
    /// as no triangle turns over and the surface, of edges of about the given length, stays where it is.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn smooth(&mut self, length: f64, pulse: &mut Pulse<'_>) -> Result<(), Cancelled> {
        let areas = self.areas();
        let vertices: Vec<_> = self.mesh.vertices().collect();
        for v in vertices {
            pulse.beat_by(SEARCH)?;
            let goal = match self.creases.kind(v) {
                Kind::Corner => continue,
                Kind::Along(_) => self.mean_along(v),
                Kind::Free => self.mean_by_area(v, &areas),
            };
            let before = self.fit_around(v, self.places[v]);
            for share in [1.0, 0.5, 0.0] {
                let place = self.moved(v, goal, share);
                let stays = share == 0.0 || self.distance_around(v, place) < DEVIATION * length;
                if stays && self.fit_around(v, place).may_replace(before) {
                    self.places[v] = place;
                    break;
                }
            }
        }
        Ok(())
    }

    /// Puts every vertex onto the surface, also those few new ones that smoothing left where they were because a triangle would
    /// have become worse.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn put_onto_surface(&mut self, pulse: &mut Pulse<'_>) -> Result<(), Cancelled> {
        let vertices: Vec<_> =
            self.mesh.vertices().filter(|&v| self.creases.kind(v) != Kind::Corner).collect();
        for v in vertices {
            pulse.beat_by(SEARCH)?;
            self.places[v] = self.moved(v, self.places[v].position, 0.0);
        }
        Ok(())
    }

    /// Distance of a vertex' present place from the triangles around it, were it moved.
    fn distance_around(&self, v: VertexId, place: Place) -> f64 {
        let away = |h: HalfedgeId| {
            let across = [self.mesh.head(h), self.mesh.tail(h.prev())].map(|w| self.places[w].position);
            distance(self.places[v].position, [place.position, across[0], across[1]])
        };
        self.mesh.star(v).map(away).fold(f64::INFINITY, min)
    }

    /// A vertex on the surface, moved by a share of the way to a goal.
    fn moved(&self, v: VertexId, goal: DVec3, share: f64) -> Place {
        let Place { position, normal, near } = self.places[v];
        let step = goal - position;
        if let Kind::Along(chain) = self.creases.kind(v) {
            let ChainPoint { position, face } = self.creases.nearest(position + share * step, chain);
            let normal = self.original.nearest_facing(position, normal, face);
            return Place { position, normal: self.original.normal(normal.point), near: face };
        }
        let tangential = step - normal * step.dot(normal);
        let nearest = self.original.nearest_facing(position + share * tangential, normal, near);
        let point = nearest.point;
        Place {
            position: point.position(self.original.mesh()),
            normal: self.original.normal(point),
            near: point.face,
        }
    }

    fn mean_by_area(&self, v: VertexId, areas: &TiVec<VertexId, f64>) -> DVec3 {
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for h in self.mesh.star(v) {
            let w = self.mesh.head(h);
            sum += areas[w] * self.places[w].position;
            weight += areas[w];
        }
        if weight > 0.0 { sum / weight } else { self.places[v].position }
    }

    fn mean_along(&self, v: VertexId) -> DVec3 {
        let along = self.mesh.star(v).filter(|&h| self.is_sharp(h)).map(|h| self.mesh.head(h));
        let (sum, count) =
            along.fold((DVec3::ZERO, 0.0), |(sum, count), w| (sum + self.places[w].position, count + 1.0));
        if count > 0.0 { sum / count } else { self.places[v].position }
    }

    /// The area of the triangles around each vertex.
    fn areas(&self) -> TiVec<VertexId, f64> {
        let mut areas = ti_vec![0.0; self.places.len()];
        for f in self.mesh.faces() {
            let corners = self.mesh.corners(f);
            let [p, q, r] = corners.map(|v| self.places[v].position);
            corners.iter().for_each(|&v| areas[v] += triangle::area(p, q, r));
        }
        areas
    }
}

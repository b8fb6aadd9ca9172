//! The front of the distances: settled vertices offer distances to their neighbours, which wait in a queue to be settled.

use super::unfolding::{Window, apex, source_below};
use crate::math::min_queue::{MinQueue, Queued};
use crate::math::scalar::max;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec2;
use std::cmp::Reverse;
use typed_index_collections::TiVec;

/// Faces through which the front is unfolded from every settled edge, whatever lies beyond: fewer lose accuracy, since each edge
/// computes the front's centre anew; more take time. Chosen by hand.
const FREE_FACES: u32 = 2;

/// Faces through which the front is unfolded in fans of slivers, at most: a bound on the time of one edge. Chosen by hand.
const MOST_FACES: u32 = 16;

/// An edge shorter than this, relative to its distance from the centre, may have lost its direction to rounding. Chosen by hand.
const SHORT: f64 = 1e-5;

/// Bound on the relative error of lengths in the plane, far above rounding (1e-16) and far below any error that matters.
const ROUNDING: f64 = 1e-9;

/// The distances of a mesh while they are computed, with the queue of the vertices whose distances may still fall.
pub(super) struct Front<'a, L> {
    mesh: &'a SurfaceMesh,
    /// The length of each halfedge.
    length: L,
    /// For each vertex its distance, where that is at most `here` (then the vertex is settled), or else the least offer so far or the
    /// distance to the seeds of an earlier front.
    distance: &'a mut TiVec<VertexId, f64>,
    queue: MinQueue<Reverse<VertexId>>,
    /// The distance of the vertex that was settled last. It never falls.
    here: f64,
}

/// An edge seen in the plane, from `a` on the left to `b` on the right, by the halfedge of the face beyond it.
#[derive(Clone, Copy)]
struct Edge {
    beyond: HalfedgeId,
    a: DVec2,
    b: DVec2,
}

/// The extent to which the front has been unfolded from a settled edge.
#[derive(Clone, Copy)]
struct Unfolded {
    /// Number of faces, counting the one beyond the present edge.
    faces: u32,
    /// The least distance at which an edge on the way will be settled.
    bound: f64,
}

impl<'a, L: Fn(HalfedgeId) -> f64> Front<'a, L> {
    /// A front that starts from seeds where they are not seeds already.
    pub(super) fn new(
        mesh: &'a SurfaceMesh,
        length: L,
        seeds: &[VertexId],
        distance: &'a mut TiVec<VertexId, f64>,
    ) -> Self {
        let mut front = Self { mesh, length, distance, queue: MinQueue::default(), here: 0.0 };
        seeds.iter().for_each(|&v| front.offer(v, 0.0));
        front
    }

    /// Settles all vertices within a radius and returns how many those are.
    ///
    /// Ends after one turn for each time that a vertex was offered less, which happens only before it is settled.
    pub(super) fn advance(&mut self, radius: f64) -> usize {
        let mut settled = 0;
        while let Some(Queued { cost: here, key: Reverse(v), .. }) = self.queue.pop() {
            if here > radius {
                break;
            }
            if here > self.distance[v] {
                continue;
            }
            self.here = here;
            self.settle(v);
            settled += 1;
        }
        settled
    }

    /// Lowers the distance of a vertex to `through`, but not below that of the front, so that no settled one falls.
    fn offer(&mut self, v: VertexId, through: f64) {
        let through = max(self.here, through);
        if through < self.distance[v] {
            self.distance[v] = through;
            self.queue.push(through, Reverse(v), ());
        }
    }

    fn is_settled(&self, v: VertexId) -> bool {
        self.distance[v] <= self.here
    }

    fn settle(&mut self, v: VertexId) {
        let mesh = self.mesh;
        for h in mesh.star(v) {
            self.offer(mesh.head(h), self.here + (self.length)(h));
        }
        for h in mesh.star(v) {
            if self.is_settled(mesh.head(h)) {
                self.cross(h);
                self.cross(mesh.twin(h));
            }
        }
    }

    /// Sends the front through a settled edge into the face of a halfedge.
    fn cross(&mut self, h: HalfedgeId) {
        let mesh = self.mesh;
        if self.is_settled(mesh.tail(h.prev())) {
            return;
        }
        let [at_a, at_b] = [mesh.tail(h), mesh.head(h)].map(|v| self.distance[v]);
        let length = (self.length)(h);
        let Some(source) = source_below(length, [at_a, at_b]) else { return };
        let edge = Edge { beyond: h, a: DVec2::ZERO, b: DVec2::new(length, 0.0) };
        let window = Window { source, left: edge.a, right: edge.b };
        self.follow(edge, window, Unfolded { faces: 1, bound: f64::INFINITY });
    }

    /// Offers the corner beyond an edge its distance and goes on through the face's other sides. After the first faces it goes on
    /// only to corners nearer than the bound: farther ones are reached from the edge that is settled there.
    fn follow(&mut self, edge: Edge, window: Window, Unfolded { faces, bound }: Unfolded) {
        let (mesh, h) = (self.mesh, edge.beyond);
        let corner = mesh.tail(h.prev());
        if self.is_settled(corner) {
            return;
        }
        let [ab, bc, ca] = [h, h.next(), h.prev()].map(|x| (self.length)(x));
        let place = apex([edge.a, edge.b], [ab, bc, ca]);
        let through = place.distance(window.source);
        if through.is_nan() || (faces > FREE_FACES && through >= bound) {
            return;
        }
        // A line through the edge is no shorter than this: else rounding has turned an edge too short for the plane.
        let least = || edge.a.distance(window.source) + ca - 2.0 * ab;
        if ab < SHORT * (through + ca) && through < (1.0 - ROUNDING) * least() {
            return;
        }
        let [left, right] = window.split(place);
        if left.is_some() && right.is_some() {
            self.offer(corner, through);
        }
        if faces == MOST_FACES {
            return;
        }
        let at_corner = self.distance[corner];
        let onwards = |end: f64| Unfolded { faces: faces + 1, bound: bound.min(max(end, at_corner)) };
        let ends = [mesh.tail(h), mesh.head(h)].map(|v| self.distance[v]);
        if let Some(window) = left {
            let edge = Edge { beyond: mesh.twin(h.prev()), a: edge.a, b: place };
            self.follow(edge, window, onwards(ends[0]));
        }
        if let Some(window) = right {
            let edge = Edge { beyond: mesh.twin(h.next()), a: place, b: edge.b };
            self.follow(edge, window, onwards(ends[1]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{icosphere, octahedron};
    use typed_index_collections::ti_vec;

    /// Flat needles, with heights down to 1e-13 of their lengths.
    fn squeezed(mesh: &SurfaceMesh, by: f64) -> SurfaceMesh {
        let place = |p: &glam::DVec3| *p * glam::DVec3::new(1.0, by, by * by);
        mesh.with_positions(mesh.positions().iter().map(place).collect())
    }

    #[test]
    fn every_vertex_is_settled_once_and_in_order() {
        for mesh in
            [octahedron(), icosphere(4), squeezed(&icosphere(3), 1e-6), squeezed(&icosphere(3), 1e-13)]
        {
            for seed in [0, 3, mesh.vertex_count() as u32 - 1].map(VertexId) {
                let mut distance = ti_vec![f64::INFINITY; mesh.vertex_count()];
                let mut front = Front::new(&mesh, |h| mesh.length(h), &[seed, seed], &mut distance);
                assert_eq!(front.advance(f64::INFINITY), mesh.vertex_count());
                let last = front.here;
                assert_eq!(last, distance.iter().copied().fold(0.0, f64::max));
            }
        }
    }

    #[test]
    fn seeds_that_are_seeds_already_change_nothing() {
        let ball = icosphere(3);
        let mut distance = ti_vec![f64::INFINITY; ball.vertex_count()];
        let length = |h| ball.length(h);
        Front::new(&ball, length, &[VertexId(9)], &mut distance).advance(f64::INFINITY);
        let before = distance.clone();
        assert_eq!(Front::new(&ball, length, &[VertexId(9)], &mut distance).advance(f64::INFINITY), 0);
        assert_eq!(before, distance);
    }
}

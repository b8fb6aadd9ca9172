//! Exact geodesic distances on small meshes, to judge the approximate ones. Windows are carried from face to face, the nearest first (Chen
//! & Han 1990); a window is dropped where a path through a vertex is shorter (Xin & Wang 2009).

use crate::distance_bounds::along_edges;
use conemap::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec2;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// The rays through a part of an edge into the face of its halfedge. The edge runs from (0, 0) to (length, 0), and the face lies above it.
#[derive(Clone, Copy)]
struct Window {
    edge: HalfedgeId,
    /// The point below the edge from which the rays come, and its distance from the seed.
    source: DVec2,
    at_source: f64,
    part: [f64; 2],
}

#[derive(Clone, Copy)]
enum Event {
    Window(Window),
    Vertex(VertexId),
}

struct Entry(Reverse<u64>, u64, Event);

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Entry {}
impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.0, self.1).cmp(&(other.0, other.1))
    }
}

struct Search<'a> {
    mesh: &'a SurfaceMesh,
    distance: Vec<f64>,
    queue: BinaryHeap<Entry>,
    pushed: u64,
}

/// The largest number of windows. More of them come from a fault in the coordinates of the mesh, not from its size.
const MOST_WINDOWS: u64 = 5_000_000;

/// The distances of all vertices from a seed, exact but for rounding.
pub fn exact_distances(mesh: &SurfaceMesh, seed: VertexId) -> Vec<f64> {
    let distance = along_edges(mesh, &[seed]);
    let mut search = Search { mesh, distance, queue: BinaryHeap::new(), pushed: 0 };
    for v in mesh.vertices() {
        search.push(search.distance[v.index()], Event::Vertex(v));
    }
    while let Some(Entry(Reverse(bits), _, event)) = search.queue.pop() {
        match event {
            Event::Vertex(v) if f64::from_bits(bits) > search.distance[v.index()] => {}
            Event::Vertex(v) => search.leave(v),
            Event::Window(window) => search.carry(window),
        }
    }
    search.distance
}

impl Search<'_> {
    fn push(&mut self, key: f64, event: Event) {
        self.pushed += 1;
        assert!(self.pushed < MOST_WINDOWS, "windows without end");
        self.queue.push(Entry(Reverse(key.to_bits()), self.pushed, event));
    }

    /// Sends rays from a vertex through the opposite sides of its faces.
    fn leave(&mut self, v: VertexId) {
        let mesh = self.mesh;
        let sides: Vec<HalfedgeId> = mesh.star(v).map(|h| mesh.twin(h.next())).collect();
        for edge in sides {
            let length = mesh.length(edge);
            // The twin of the edge has the vertex above itself; on this side it lies below the edge.
            let twin = mesh.twin(edge);
            let at = apex(length, [mesh.length(twin.next()), mesh.length(twin.prev())]);
            let source = DVec2::new(length - at.x, -at.y);
            let at_source = self.distance[v.index()];
            self.offer(Window { edge, source, at_source, part: [0.0, length] });
        }
    }

    /// Keeps a window unless a path through an end of its edge is shorter for all of the window.
    fn offer(&mut self, w: Window) {
        let length = self.mesh.length(w.edge);
        let [left, right] = w.part;
        if right - left <= 1e-13 * length {
            return;
        }
        let to = |x: f64| w.at_source + w.source.distance(DVec2::new(x, 0.0));
        let [a, b] = [self.mesh.tail(w.edge), self.mesh.head(w.edge)].map(|v| self.distance[v.index()]);
        let slack = 1e-13 * (to(left) + to(right));
        if a + right < to(right) - slack || b + (length - left) < to(left) - slack {
            return;
        }
        let nearest = w.source.x.clamp(left, right);
        self.push(to(nearest), Event::Window(w));
    }

    /// Carries a window over the face of its edge: to the opposite corner where rays reach it, and onto the other two sides.
    fn carry(&mut self, w: Window) {
        let (mesh, h) = (self.mesh, w.edge);
        let length = mesh.length(h);
        let place = apex(length, [mesh.length(h.next()), mesh.length(h.prev())]);
        let [left, right] = w.part.map(|x| DVec2::new(x, 0.0) - w.source);
        let direction = place - w.source;
        let (sees_left, sees_right) = (direction.perp_dot(left) >= 0.0, right.perp_dot(direction) >= 0.0);
        let corner = mesh.tail(h.prev());
        let through = w.at_source + direction.length();
        if sees_left && sees_right && through < self.distance[corner.index()] {
            self.distance[corner.index()] = through;
            self.push(through, Event::Vertex(corner));
        }
        // The sides from the corner to a and from b to the corner, each with its own length and ends.
        let (a, b) = (DVec2::ZERO, DVec2::new(length, 0.0));
        if sees_left {
            self.onto(w, mesh.twin(h.prev()), [a, place], [left, if sees_right { direction } else { right }]);
        }
        if sees_right {
            self.onto(w, mesh.twin(h.next()), [place, b], [if sees_left { direction } else { left }, right]);
        }
    }

    fn onto(&mut self, w: Window, edge: HalfedgeId, [from, to]: [DVec2; 2], rays: [DVec2; 2]) {
        let length = self.mesh.length(edge);
        let along = (to - from) / from.distance(to);
        // The place where a ray crosses the edge.
        let crossing = |ray: DVec2| {
            let sine = ray.perp_dot(along);
            let x = (w.source - from).perp_dot(ray) / -sine;
            if x.is_nan() { 0.0 } else { x.clamp(0.0, length) }
        };
        let [left, right] = rays.map(crossing);
        let offset = w.source - from;
        let source = DVec2::new(offset.dot(along), along.perp_dot(offset));
        self.offer(Window { edge, source, part: [left, right], ..w });
    }
}

/// The third corner c of a triangle above its side from a = (0, 0) to b = (length, 0), from the lengths of b c and c a.
fn apex(length: f64, [bc, ca]: [f64; 2]) -> DVec2 {
    let x = 0.5 * (length + (ca - bc) * (ca + bc) / length);
    DVec2::new(x, ((ca - x) * (ca + x)).max(0.0).sqrt())
}

//! A patched mesh coarsened down to its base domain by half-edge collapses, and back again one vertex at a time.
//!
//! Faces keep their patch: an interior vertex collapses into any neighbour, a path vertex only along its own path, a
//! landmark never (Hoppe 1996, restricted to the patches). Element numbers never change, so that undoing the collapses in
//! reverse order restores every intermediate mesh exactly.

use crate::layout::PatchedMesh;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use glam::{DMat3, DVec3};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use typed_index_collections::{TiVec, ti_vec};

/// What holds a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Stays: landmark `.0`, a vertex of the base domain.
    Landmark(VertexId),
    /// On the path of base halfedge `.0` (the smaller of its two).
    Path(HalfedgeId),
    /// Inside patch `.0`.
    Interior(FaceId),
}

/// What holds each vertex of a patched mesh.
pub fn holds(patched: &PatchedMesh, base: &crate::base_domain::BaseDomain) -> TiVec<VertexId, Hold> {
    let mesh = &patched.mesh;
    let patch = |v: VertexId| Hold::Interior(patched.face_patch[mesh.outgoing(v).face()]);
    let mut holds: TiVec<VertexId, Hold> = mesh.vertices().map(patch).collect();
    for h in base.mesh.edges() {
        patched.paths[h].iter().for_each(|&v| holds[v] = Hold::Path(h));
    }
    for (landmark, &v) in patched.landmark_vertices.iter_enumerated() {
        holds[v] = Hold::Landmark(landmark);
    }
    holds
}

/// One collapse: `removed` went into `kept`.
#[derive(Clone, Copy, Debug)]
pub struct Collapse {
    /// The vertex that vanished.
    pub removed: VertexId,
    /// The halfedge from it to the vertex it went into, in a face that vanished.
    halfedge: HalfedgeId,
}

/// The mesh at some level between the base domain and its full resolution.
pub struct ProgressiveMesh<'a> {
    patched: &'a PatchedMesh,
    holds: &'a TiVec<VertexId, Hold>,
    /// Vertex at the start of each halfedge.
    tails: TiVec<HalfedgeId, VertexId>,
    twins: TiVec<HalfedgeId, HalfedgeId>,
    outgoing: TiVec<VertexId, HalfedgeId>,
    face_alive: TiVec<FaceId, bool>,
    vertex_alive: TiVec<VertexId, bool>,
    live_vertices: usize,
    collapses: Vec<Collapse>,
    last_restored: Option<Collapse>,
}

impl<'a> ProgressiveMesh<'a> {
    /// The full resolution.
    pub fn new(patched: &'a PatchedMesh, holds: &'a TiVec<VertexId, Hold>) -> Self {
        let mesh = &patched.mesh;
        Self {
            patched,
            holds,
            tails: mesh.halfedges().map(|h| mesh.tail(h)).collect(),
            twins: mesh.halfedges().map(|h| mesh.twin(h)).collect(),
            outgoing: mesh.vertices().map(|v| mesh.outgoing(v)).collect(),
            face_alive: ti_vec![true; mesh.face_count()],
            vertex_alive: ti_vec![true; mesh.vertex_count()],
            live_vertices: mesh.vertex_count(),
            collapses: Vec::new(),
            last_restored: None,
        }
    }

    /// Number of vertices of the present level.
    pub fn live_vertices(&self) -> usize {
        self.live_vertices
    }

    /// The vertices of the present level.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.vertex_alive.iter_enumerated().filter(|(_, alive)| **alive).map(|(v, _)| v)
    }

    /// The faces of the present level.
    pub fn faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        self.face_alive.iter_enumerated().filter(|(_, alive)| **alive).map(|(f, _)| f)
    }

    /// Corners of a face.
    pub fn corners(&self, f: FaceId) -> [VertexId; 3] {
        [0, 1, 2].map(|k| self.tails[HalfedgeId::of(f, k)])
    }

    /// The patch of a face.
    pub fn patch(&self, f: FaceId) -> FaceId {
        self.patched.face_patch[f]
    }

    /// What holds a vertex.
    pub fn hold(&self, v: VertexId) -> Hold {
        self.holds[v]
    }

    /// Position in space, area 1.
    pub fn position(&self, v: VertexId) -> DVec3 {
        self.patched.mesh.positions()[v]
    }

    fn head(&self, h: HalfedgeId) -> VertexId {
        self.tails[h.next()]
    }

    /// The outgoing halfedges of a vertex of the present level, counter-clockwise.
    pub fn star(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let first = self.outgoing[v];
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let h = next?;
            let following = self.twins[h.prev()];
            next = (following != first).then_some(following);
            Some(h)
        })
    }

    /// Start vertex of a halfedge of the present level.
    pub fn tail(&self, h: HalfedgeId) -> VertexId {
        self.tails[h]
    }

    /// Coarsens until the landmarks are left. Returns how many other vertices could not be removed.
    pub fn coarsen(&mut self) -> usize {
        let mut quadrics = self.quadrics();
        for round in 0..6 {
            let strictness = if round < 3 { Strictness::Shape } else { Strictness::LinkOnly };
            self.coarsen_round(&mut quadrics, strictness);
            if self.live_vertices == self.patched.landmark_vertices.len() {
                return 0;
            }
        }
        self.live_vertices - self.patched.landmark_vertices.len()
    }

    fn coarsen_round(&mut self, quadrics: &mut TiVec<VertexId, Quadric>, strictness: Strictness) {
        let mut queue = BinaryHeap::new();
        let mut version: TiVec<VertexId, u32> = ti_vec![0; self.outgoing.len()];
        let vertices: Vec<_> = self.vertices().collect();
        for v in vertices {
            self.push_best(v, quadrics, strictness, &version, &mut queue);
        }
        let mut touched = Vec::new();
        while let Some(Entry { vertex, version: seen, halfedge, .. }) = queue.pop() {
            if !self.vertex_alive[vertex] || version[vertex] != seen {
                continue;
            }
            let kept = self.head(halfedge);
            let absorbed = quadrics[vertex];
            quadrics[kept].add(&absorbed);
            self.collapse(halfedge);
            touched.clear();
            touched.push(kept);
            touched.extend(self.star(kept).map(|h| self.head(h)));
            for &v in &touched {
                version[v] += 1;
                self.push_best(v, quadrics, strictness, &version, &mut queue);
            }
        }
    }

    fn quadrics(&self) -> TiVec<VertexId, Quadric> {
        let mut quadrics = ti_vec![Quadric::default(); self.outgoing.len()];
        for f in self.faces() {
            let corners = self.corners(f);
            let plane = Quadric::of_triangle(corners.map(|v| self.position(v)));
            corners.iter().for_each(|&v| quadrics[v].add(&plane));
        }
        quadrics
    }

    fn push_best(
        &self,
        v: VertexId,
        quadrics: &TiVec<VertexId, Quadric>,
        strictness: Strictness,
        version: &TiVec<VertexId, u32>,
        queue: &mut BinaryHeap<Entry>,
    ) {
        if matches!(self.holds[v], Hold::Landmark(_)) {
            return;
        }
        let mut best: Option<(f64, HalfedgeId)> = None;
        for h in self.star(v) {
            let cost = self.cost(h, &quadrics[v]);
            if best.is_none_or(|(least, _)| cost < least) && self.allowed(h, strictness) {
                best = Some((cost, h));
            }
        }
        if let Some((cost, halfedge)) = best {
            queue.push(Entry { cost, vertex: v, version: version[v], halfedge });
        }
    }

    fn cost(&self, h: HalfedgeId, quadric: &Quadric) -> f64 {
        let (a, b) = (self.position(self.tails[h]), self.position(self.head(h)));
        quadric.at(b) + 0.01 * quadric.area * a.distance_squared(b)
    }

    fn is_border(&self, h: HalfedgeId) -> bool {
        self.patch(h.face()) != self.patch(self.twins[h].face())
    }

    /// Whether the start of `h` may go into its end.
    fn allowed(&self, h: HalfedgeId, strictness: Strictness) -> bool {
        if matches!(self.holds[self.tails[h]], Hold::Path(_)) && !self.is_border(h) {
            return false;
        }
        self.link_condition(h) && (strictness == Strictness::LinkOnly || self.keeps_shape(h))
    }

    /// Exactly two common neighbours, and more than four faces left.
    fn link_condition(&self, h: HalfedgeId) -> bool {
        let (a, b) = (self.tails[h], self.head(h));
        let common = self.star(a).filter(|&g| self.star(b).any(|k| self.head(k) == self.head(g))).count();
        common == 2 && self.live_vertices > 4
    }

    /// Normals turn little and no new triangle is a needle.
    fn keeps_shape(&self, h: HalfedgeId) -> bool {
        let (a, b) = (self.tails[h], self.head(h));
        let (at_a, at_b) = (self.position(a), self.position(b));
        self.star(a).all(|g| {
            let (p, q) = (self.head(g), self.tails[g.prev()]);
            if p == b || q == b {
                return true;
            }
            let (p, q) = (self.position(p), self.position(q));
            let (before, after) = ((p - at_a).cross(q - at_a), (p - at_b).cross(q - at_b));
            let longest =
                (p - at_b).length_squared().max((q - at_b).length_squared()).max((p - q).length_squared());
            let double_area = after.length();
            before.dot(after) > 0.2 * before.length() * double_area && double_area > 0.05 * longest
        })
    }

    /// Removes the start of `h` and the two faces beside `h`.
    fn collapse(&mut self, h: HalfedgeId) {
        let t = self.twins[h];
        let (a, b) = (self.tails[h], self.head(h));
        let mut g = self.outgoing[a];
        let first = g;
        loop {
            let following = self.twins[g.prev()];
            self.tails[g] = b;
            g = following;
            if g == first {
                break;
            }
        }
        // The records of the vanished faces stay as they are but for their corner at a, which `restore` puts back.
        let (c, d) = (self.tails[h.prev()], self.tails[t.prev()]);
        let [left_out, left_in] = [self.twins[h.next()], self.twins[h.prev()]];
        let [right_out, right_in] = [self.twins[t.next()], self.twins[t.prev()]];
        self.link(left_out, left_in);
        self.link(right_out, right_in);
        // left_out runs c -> b, left_in a -> c (now b -> c); right_out d -> a (now d -> b), right_in b -> d.
        self.outgoing[c] = left_out;
        self.outgoing[d] = right_out;
        self.outgoing[b] = right_in;
        self.face_alive[h.face()] = false;
        self.face_alive[t.face()] = false;
        self.vertex_alive[a] = false;
        self.live_vertices -= 1;
        self.collapses.push(Collapse { removed: a, halfedge: h });
    }

    fn link(&mut self, h: HalfedgeId, t: HalfedgeId) {
        self.twins[h] = t;
        self.twins[t] = h;
    }

    /// Undoes the last collapse; `None` when the mesh has its full resolution again.
    pub fn restore(&mut self) -> Option<Collapse> {
        let collapse = self.collapses.pop()?;
        let (a, h) = (collapse.removed, collapse.halfedge);
        let t = self.twins[h];
        for far in [h.next(), h.prev(), t.next(), t.prev()] {
            let twin = self.twins[far];
            self.twins[twin] = far;
        }
        self.face_alive[h.face()] = true;
        self.face_alive[t.face()] = true;
        self.vertex_alive[a] = true;
        self.live_vertices += 1;
        // Turn around a from h, all of whose outgoing halfedges belong to it again.
        let mut g = h;
        loop {
            self.tails[g] = a;
            g = self.twins[g.prev()];
            if g == h {
                break;
            }
        }
        self.outgoing[a] = h;
        self.outgoing[self.tails[h.next()]] = t;
        self.outgoing[self.tails[h.prev()]] = h.prev();
        self.outgoing[self.tails[t.prev()]] = t.prev();
        self.last_restored = Some(collapse);
        Some(collapse)
    }

    /// Repeats the collapse that was just undone; returns its vertex.
    pub fn collapse_again(&mut self) -> Option<VertexId> {
        let collapse = self.last_restored.take()?;
        self.collapse(collapse.halfedge);
        Some(collapse.removed)
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Strictness {
    Shape,
    LinkOnly,
}

struct Entry {
    cost: f64,
    vertex: VertexId,
    version: u32,
    halfedge: HalfedgeId,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .cost
            .total_cmp(&self.cost)
            .then(other.vertex.cmp(&self.vertex))
            .then(other.version.cmp(&self.version))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Area-weighted sum of squared distances to planes (Garland & Heckbert 1997).
#[derive(Clone, Copy, Debug, Default)]
struct Quadric {
    second: DMat3,
    first: DVec3,
    constant: f64,
    area: f64,
}

impl Quadric {
    fn of_triangle([p, q, r]: [DVec3; 3]) -> Self {
        let cross = (q - p).cross(r - p);
        let area = 0.5 * cross.length();
        let n = cross.normalize_or_zero();
        let d = -n.dot(p);
        let second = DMat3::from_cols(n * n.x, n * n.y, n * n.z) * area;
        Self { second, first: n * (d * area), constant: d * d * area, area: area / 3.0 }
    }

    fn add(&mut self, other: &Self) {
        self.second += other.second;
        self.first += other.first;
        self.constant += other.constant;
        self.area += other.area;
    }

    fn at(&self, p: DVec3) -> f64 {
        (p.dot(self.second * p) + 2.0 * self.first.dot(p) + self.constant).max(0.0)
    }
}

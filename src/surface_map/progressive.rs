//! A patched mesh coarsened down to its base domain by half-edge collapses, and back again one vertex at a time.
//!
//! Faces keep their patch: an interior vertex collapses into any neighbour, a path vertex only along its own path, a
//! landmark never (Hoppe 1996, restricted to the patches). Element numbers never change, so that undoing the collapses in
//! reverse order restores every intermediate mesh exactly.

use crate::layout::PatchedMesh;
use crate::math::quadric::Quadric;
use crate::mesh::collapsible::{Collapse, CollapsibleMesh, ShapeLimits};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use glam::DVec3;
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

/// The mesh at some level between the base domain and its full resolution.
pub struct ProgressiveMesh<'a> {
    patched: &'a PatchedMesh,
    holds: &'a TiVec<VertexId, Hold>,
    mesh: CollapsibleMesh,
    last_restored: Option<Collapse>,
}

impl<'a> ProgressiveMesh<'a> {
    /// The full resolution.
    pub fn new(patched: &'a PatchedMesh, holds: &'a TiVec<VertexId, Hold>) -> Self {
        Self { patched, holds, mesh: CollapsibleMesh::new(&patched.mesh), last_restored: None }
    }

    /// The connectivity of the present level.
    pub fn mesh(&self) -> &CollapsibleMesh {
        &self.mesh
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

    /// Coarsens until the landmarks are left. Returns how many other vertices could not be removed.
    pub fn coarsen(&mut self) -> usize {
        let mut quadrics = self.quadrics();
        for round in 0..6 {
            let strictness = if round < 3 { Strictness::Shape } else { Strictness::LinkOnly };
            self.coarsen_round(&mut quadrics, strictness);
            if self.mesh.live_vertices() == self.patched.landmark_vertices.len() {
                return 0;
            }
        }
        self.mesh.live_vertices() - self.patched.landmark_vertices.len()
    }

    fn coarsen_round(&mut self, quadrics: &mut TiVec<VertexId, Quadric>, strictness: Strictness) {
        let mut queue = BinaryHeap::new();
        let mut version: TiVec<VertexId, u32> = ti_vec![0; self.patched.mesh.vertex_count()];
        let vertices: Vec<_> = self.mesh.vertices().collect();
        for v in vertices {
            self.push_best(v, quadrics, strictness, &version, &mut queue);
        }
        let mut touched = Vec::new();
        while let Some(Entry { vertex, version: seen, halfedge, .. }) = queue.pop() {
            if !self.mesh.is_alive(vertex) || version[vertex] != seen {
                continue;
            }
            let kept = self.mesh.head(halfedge);
            let absorbed = quadrics[vertex];
            quadrics[kept].add(&absorbed);
            self.mesh.collapse(halfedge);
            touched.clear();
            touched.push(kept);
            touched.extend(self.mesh.star(kept).map(|h| self.mesh.head(h)));
            for &v in &touched {
                version[v] += 1;
                self.push_best(v, quadrics, strictness, &version, &mut queue);
            }
        }
    }

    fn quadrics(&self) -> TiVec<VertexId, Quadric> {
        let mut quadrics = ti_vec![Quadric::ZERO; self.patched.mesh.vertex_count()];
        for f in self.mesh.faces() {
            let corners = self.mesh.corners(f);
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
        for h in self.mesh.star(v) {
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
        let (a, b) = (self.position(self.mesh.tail(h)), self.position(self.mesh.head(h)));
        quadric.at(b) + 0.01 * quadric.area * a.distance_squared(b)
    }

    fn is_border(&self, h: HalfedgeId) -> bool {
        self.patch(h.face()) != self.patch(self.mesh.twin(h).face())
    }

    /// Whether the start of `h` may go into its end.
    fn allowed(&self, h: HalfedgeId, strictness: Strictness) -> bool {
        if matches!(self.holds[self.mesh.tail(h)], Hold::Path(_)) && !self.is_border(h) {
            return false;
        }
        self.mesh.link_condition(h)
            && (strictness == Strictness::LinkOnly
                || self.mesh.keeps_shape(h, self.patched.mesh.positions(), &SHAPE))
    }

    /// Undoes the last collapse and returns its vertex; `None` when the mesh has its full resolution again.
    pub fn restore(&mut self) -> Option<VertexId> {
        let collapse = self.mesh.restore()?;
        self.last_restored = Some(collapse);
        Some(collapse.removed)
    }

    /// Repeats the collapse that was just undone.
    pub fn collapse_again(&mut self) {
        if let Some(collapse) = self.last_restored.take() {
            self.mesh.collapse(collapse.halfedge);
        }
    }
}

/// Normals turn by less than 78 degrees and no new triangle is a needle.
const SHAPE: ShapeLimits = ShapeLimits { normal_cosine: 0.2, double_area: 0.05 };

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

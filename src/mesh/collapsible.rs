//! A closed triangle mesh under half-edge collapses that can be undone, edge flips and edge splits.
//!
//! Element numbers never change, and new elements get the next ones: a collapse moves corners from the vertex that vanishes to the one that is kept, and
//! undoing collapses in reverse order restores every intermediate mesh exactly. The mesh stays simple: the link condition
//! is the caller's to ask for.

use super::ids::star;
use super::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::math::scalar::{max, min};
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// One collapse.
#[derive(Clone, Copy, Debug)]
pub struct Collapse {
    /// The vertex that vanished.
    pub removed: VertexId,
    /// The halfedge from it to the vertex it went into, in a face that vanished.
    pub halfedge: HalfedgeId,
}

/// The limits for the shapes of the triangles that a collapse moves.
#[derive(Clone, Copy, Debug)]
pub struct ShapeLimits {
    /// Least cosine between a triangle's normals before and after.
    pub normal_cosine: f64,
    /// Least double area in units of the longest edge squared.
    pub double_area: f64,
}

/// The mesh at some level of coarseness.
#[derive(Clone, Debug)]
pub struct CollapsibleMesh {
    tails: TiVec<HalfedgeId, VertexId>,
    twins: TiVec<HalfedgeId, HalfedgeId>,
    outgoing: TiVec<VertexId, HalfedgeId>,
    face_alive: TiVec<FaceId, bool>,
    vertex_alive: TiVec<VertexId, bool>,
    live_vertices: usize,
    collapses: Vec<Collapse>,
}

impl CollapsibleMesh {
    /// The full resolution.
    pub fn new(mesh: &SurfaceMesh) -> Self {
        let tails = mesh.halfedges().map(|h| mesh.tail(h)).collect();
        let twins = mesh.halfedges().map(|h| mesh.twin(h)).collect();
        Self::from_halfedges(tails, twins, mesh.vertices().map(|v| mesh.outgoing(v)).collect())
    }

    /// The mesh with these halfedges: by halfedge its tail and its twin, by vertex an outgoing halfedge. It must be closed and simple.
    pub fn from_halfedges(
        tails: TiVec<HalfedgeId, VertexId>,
        twins: TiVec<HalfedgeId, HalfedgeId>,
        outgoing: TiVec<VertexId, HalfedgeId>,
    ) -> Self {
        let (faces, vertices) = (tails.len() / 3, outgoing.len());
        Self {
            tails,
            twins,
            outgoing,
            face_alive: ti_vec![true; faces],
            vertex_alive: ti_vec![true; vertices],
            live_vertices: vertices,
            collapses: Vec::new(),
        }
    }

    /// Number of vertices of the present level.
    pub fn live_vertices(&self) -> usize {
        self.live_vertices
    }

    /// Number of faces of the full resolution and of splits: every face number is below.
    pub fn face_slots(&self) -> usize {
        self.face_alive.len()
    }

    /// Whether a vertex is in the present level.
    pub fn is_alive(&self, v: VertexId) -> bool {
        self.vertex_alive[v]
    }

    /// The vertices of the present level.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.vertex_alive.iter_enumerated().filter(|(_, alive)| **alive).map(|(v, _)| v)
    }

    /// Whether a face is in the present level.
    pub fn is_face_alive(&self, f: FaceId) -> bool {
        self.face_alive[f]
    }

    /// The faces of the present level.
    pub fn faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        self.face_alive.iter_enumerated().filter(|(_, alive)| **alive).map(|(f, _)| f)
    }

    /// Corners of a face.
    pub fn corners(&self, f: FaceId) -> [VertexId; 3] {
        f.halfedges().map(|h| self.tails[h])
    }

    /// Start vertex of a halfedge.
    #[inline]
    pub fn tail(&self, h: HalfedgeId) -> VertexId {
        self.tails[h]
    }

    /// End vertex of a halfedge.
    #[inline]
    pub fn head(&self, h: HalfedgeId) -> VertexId {
        self.tails[h.next()]
    }

    /// The opposite halfedge.
    #[inline]
    pub fn twin(&self, h: HalfedgeId) -> HalfedgeId {
        self.twins[h]
    }

    /// One halfedge that starts at the vertex.
    #[inline]
    pub fn outgoing(&self, v: VertexId) -> HalfedgeId {
        self.outgoing[v]
    }

    /// The outgoing halfedges of a vertex, counter-clockwise.
    pub fn star(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        star(self.outgoing[v], |h| self.twins[h])
    }

    /// Whether the ends of `h` have exactly two common neighbours, and more than four vertices are left.
    pub fn link_condition(&self, h: HalfedgeId) -> bool {
        let (a, b) = (self.tails[h], self.head(h));
        // The second star in parts that stay in near memory, instead of once for every neighbour.
        let (mut common, mut around) = (0, self.star(b));
        loop {
            let mut part = [VertexId(u32::MAX); 16];
            let mut filled = 0;
            for (slot, k) in part.iter_mut().zip(&mut around) {
                *slot = self.head(k);
                filled += 1;
            }
            common += self.star(a).filter(|&g| part[..filled].contains(&self.head(g))).count();
            if filled < part.len() {
                return common == 2 && self.live_vertices > 4;
            }
        }
    }

    /// Whether the triangles that move when the start of `h` goes into its end stay within the limits.
    pub fn keeps_shape(
        &self,
        h: HalfedgeId,
        positions: &TiSlice<VertexId, DVec3>,
        limits: &ShapeLimits,
    ) -> bool {
        let (a, b) = (self.tails[h], self.head(h));
        let (at_a, at_b) = (positions[a], positions[b]);
        self.star(a).all(|g| {
            let (p, q) = (self.head(g), self.tails[g.prev()]);
            if p == b || q == b {
                return true;
            }
            let (p, q) = (positions[p], positions[q]);
            let (before, after) = ((p - at_a).cross(q - at_a), (p - at_b).cross(q - at_b));
            let double_area = after.length();
            before.dot(after) > limits.normal_cosine * before.length() * double_area
                && double_area > limits.double_area * longest_squared([at_b, p, q])
        })
    }

    /// The double area of a triangle in units of its longest edge squared: 0.87 for equilateral ones.
    pub fn shape(&self, f: FaceId, positions: &TiSlice<VertexId, DVec3>) -> f64 {
        let [p, q, r] = self.corners(f).map(|corner| positions[corner]);
        (q - p).cross(r - p).length() / longest_squared([p, q, r])
    }

    /// The least [`Self::shape`] of the triangles around a vertex.
    pub fn worst_shape(&self, v: VertexId, positions: &TiSlice<VertexId, DVec3>) -> f64 {
        self.star(v).map(|h| self.shape(h.face(), positions)).fold(f64::INFINITY, min)
    }

    /// Moves the start of `h` into its end; the two faces beside `h` vanish.
    pub fn collapse(&mut self, h: HalfedgeId) {
        let t = self.twins[h];
        let (a, b) = (self.tails[h], self.head(h));
        let first = self.outgoing[a];
        let mut g = first;
        loop {
            self.tails[g] = b;
            g = self.twins[g.prev()];
            if g == first {
                break;
            }
        }
        // The vanished faces keep their twins, so that `restore` can glue them back in.
        let (c, d) = (self.tails[h.prev()], self.tails[t.prev()]);
        let (left_out, left_in) = (self.twins[h.next()], self.twins[h.prev()]);
        let (right_out, right_in) = (self.twins[t.next()], self.twins[t.prev()]);
        self.link(left_out, left_in);
        self.link(right_out, right_in);
        // left_out runs c -> b and right_out d -> b now; right_in runs b -> d.
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

    /// Puts a vertex on the edge of `h` and joins it to the corners across. The start of `h` stays, its end is the new vertex,
    /// which has the next number. Vertex and faces are new: no [`Self::restore`] of a collapse before.
    pub fn split(&mut self, h: HalfedgeId) -> VertexId {
        let t = self.twins[h];
        let (b, c, d) = (self.tails[t], self.tails[h.prev()], self.tails[t.prev()]);
        let m = VertexId::from(self.outgoing.len());
        let [left, right] = [0, 1].map(|k| FaceId::from(self.face_alive.len() + k));
        // abc becomes amc and mbc, bad becomes mad and bmd.
        let (left_outer, right_outer) = (self.twins[h.next()], self.twins[t.prev()]);
        self.tails.extend([m, b, c, b, m, d]);
        self.twins.extend([HalfedgeId(u32::MAX); 6]);
        self.face_alive.extend([true; 2]);
        self.tails[h.next()] = m;
        self.tails[t] = m;
        self.link(HalfedgeId::of(left, 0), HalfedgeId::of(right, 0));
        self.link(HalfedgeId::of(left, 1), left_outer);
        self.link(HalfedgeId::of(left, 2), h.next());
        self.link(HalfedgeId::of(right, 1), t.prev());
        self.link(HalfedgeId::of(right, 2), right_outer);
        self.outgoing[b] = HalfedgeId::of(left, 1);
        self.outgoing.push(HalfedgeId::of(left, 0));
        self.vertex_alive.push(true);
        self.live_vertices += 1;
        m
    }

    /// Undoes the last collapse; `None` when the mesh has its full resolution again. Not after [`Self::flip`] or
    /// [`Self::split`].
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
        let mut g = h;
        loop {
            self.tails[g] = a;
            g = self.twins[g.prev()];
            if g == h {
                break;
            }
        }
        self.outgoing[a] = h;
        let (b, c, d) = (self.tails[h.next()], self.tails[h.prev()], self.tails[t.prev()]);
        self.outgoing[b] = t;
        self.outgoing[c] = h.prev();
        self.outgoing[d] = t.prev();
        Some(collapse)
    }

    /// Replaces the edge of `h` by the other diagonal of its two faces; `false`, unchanged, where that edge exists already.
    pub fn flip(&mut self, h: HalfedgeId) -> bool {
        let t = self.twins[h];
        let (hn, hp, tn, tp) = (h.next(), h.prev(), t.next(), t.prev());
        let (i, j, k, l) = (self.tails[h], self.tails[t], self.tails[hp], self.tails[tp]);
        if self.star(k).any(|g| self.head(g) == l) {
            return false;
        }
        // ijk and jil become lki in the face of h and klj in that of t.
        let outer = [hp, tn, tp, hn].map(|g| self.twins[g]);
        for (slot, (twin, tail)) in [hn, hp, tn, tp].into_iter().zip(outer.into_iter().zip([k, i, l, j])) {
            self.link(slot, twin);
            self.tails[slot] = tail;
            self.outgoing[tail] = slot;
        }
        self.tails[h] = l;
        self.tails[t] = k;
        true
    }
}

/// The square of a triangle's longest edge.
fn longest_squared([p, q, r]: [DVec3; 3]) -> f64 {
    max(max(p.distance_squared(q), p.distance_squared(r)), q.distance_squared(r))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    fn triangles(mesh: &CollapsibleMesh) -> Vec<[VertexId; 3]> {
        mesh.faces().map(|f| mesh.corners(f)).collect()
    }

    fn is_closed_manifold(mesh: &CollapsibleMesh) -> bool {
        mesh.faces().all(|f| {
            (0..3).all(|k| {
                let h = HalfedgeId::of(f, k);
                let t = mesh.twin(h);
                mesh.twin(t) == h && mesh.tail(t) == mesh.head(h) && mesh.face_alive[t.face()]
            })
        }) && mesh.vertices().map(|v| mesh.star(v).count()).sum::<usize>() == 3 * mesh.faces().count()
            && mesh.faces().count() == 2 * mesh.live_vertices() - 4
    }

    #[test]
    fn collapses_keep_a_sphere_and_undo_exactly() {
        let sphere = icosphere(2);
        let mut mesh = CollapsibleMesh::new(&sphere);
        let mut levels = vec![triangles(&mesh)];
        for k in (0..sphere.face_count() * 3).map(HalfedgeId::from) {
            if mesh.face_alive[k.face()] && mesh.link_condition(k) {
                mesh.collapse(k);
                assert!(is_closed_manifold(&mesh));
                levels.push(triangles(&mesh));
            }
        }
        assert!(mesh.live_vertices() < 20);
        while let Some(level) = levels.pop() {
            assert_eq!(triangles(&mesh), level);
            assert!(is_closed_manifold(&mesh));
            mesh.restore();
        }
    }

    #[test]
    fn flips_keep_a_sphere() {
        let sphere = icosphere(1);
        let mut mesh = CollapsibleMesh::new(&sphere);
        let mut flipped = 0;
        for k in 0..200_u32 {
            flipped += usize::from(mesh.flip(HalfedgeId(k * 7919 % 240)));
            assert!(is_closed_manifold(&mesh), "after flip {k}");
        }
        assert!(flipped > 50);
    }

    #[test]
    fn splits_keep_a_sphere() {
        let sphere = icosphere(1);
        let mut mesh = CollapsibleMesh::new(&sphere);
        for k in 0..200_u32 {
            let h = HalfedgeId(k * 7919 % (240 + 6 * k));
            let ends = [mesh.tail(h), mesh.head(h)];
            let middle = mesh.split(h);
            assert!(is_closed_manifold(&mesh), "after split {k}");
            assert_eq!([mesh.tail(h), mesh.head(h)], [ends[0], middle]);
            assert_eq!(mesh.star(middle).count(), 4);
            assert!(mesh.star(middle).any(|h| mesh.head(h) == ends[1]));
        }
        assert_eq!(mesh.live_vertices(), sphere.vertex_count() + 200);
    }
}

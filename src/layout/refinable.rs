//! A triangle mesh whose edges can be split, with marks for the vertices and edges of drawn paths.

use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId, star};
use glam::DVec3;
use typed_index_collections::{TiVec, ti_vec};

/// Sparse barycentric coordinates on the input mesh: up to three input vertices with weights that sum to 1.
pub(super) type InputWeights = [(VertexId, f64); 3];

/// A mesh under refinement. Vertices keep their numbers; halfedges of a split face move.
#[derive(Clone, Debug)]
pub(super) struct RefinableMesh {
    pub positions: TiVec<VertexId, DVec3>,
    pub weights: TiVec<VertexId, InputWeights>,
    pub faces: TiVec<FaceId, [VertexId; 3]>,
    pub face_origin: TiVec<FaceId, FaceId>,
    pub twins: TiVec<HalfedgeId, HalfedgeId>,
    pub outgoing: TiVec<VertexId, HalfedgeId>,
    /// Whether the edge belongs to a path; twins agree.
    pub on_path: TiVec<HalfedgeId, bool>,
    /// Whether the vertex is a landmark or lies on a path.
    pub used: TiVec<VertexId, bool>,
}

impl RefinableMesh {
    /// The mesh scaled to area 1, with the landmarks marked as used.
    pub fn new(mesh: &SurfaceMesh, landmarks: &[VertexId]) -> Self {
        let scale = 1.0 / mesh.area().sqrt();
        let mut used = ti_vec![false; mesh.vertex_count()];
        landmarks.iter().for_each(|&v| used[v] = true);
        Self {
            positions: mesh.positions().iter().map(|&p| p * scale).collect(),
            weights: mesh.vertices().map(|v| [(v, 1.0), (v, 0.0), (v, 0.0)]).collect(),
            faces: mesh.triangles().iter().copied().collect(),
            face_origin: mesh.faces().collect(),
            twins: mesh.halfedges().map(|h| mesh.twin(h)).collect(),
            outgoing: mesh.vertices().map(|v| mesh.outgoing(v)).collect(),
            on_path: ti_vec![false; mesh.face_count() * 3],
            used,
        }
    }

    #[inline]
    pub fn tail(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }

    #[inline]
    pub fn head(&self, h: HalfedgeId) -> VertexId {
        self.tail(h.next())
    }

    /// The vertex opposite a halfedge in its face.
    #[inline]
    pub fn apex(&self, h: HalfedgeId) -> VertexId {
        self.tail(h.prev())
    }

    /// The next outgoing halfedge counter-clockwise.
    #[inline]
    pub fn turn(&self, h: HalfedgeId) -> HalfedgeId {
        self.twins[h.prev()]
    }

    /// The outgoing halfedges of a vertex, counter-clockwise.
    pub fn star(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        star(self.outgoing[v], |h| self.twins[h])
    }

    pub fn halfedge_between(&self, tail: VertexId, head: VertexId) -> Option<HalfedgeId> {
        self.star(tail).find(|&h| self.head(h) == head)
    }

    #[inline]
    pub fn midpoint(&self, h: HalfedgeId) -> DVec3 {
        0.5 * (self.positions[self.tail(h)] + self.positions[self.head(h)])
    }

    /// Splits the edge of `h` at its midpoint and joins the new vertex to both apexes.
    ///
    /// `h` then goes from its old start to the new vertex.
    pub fn split_edge(&mut self, h: HalfedgeId) -> VertexId {
        let (a, b) = (self.tail(h), self.head(h));
        let w = self.positions.push_and_get_key(self.midpoint(h));
        self.weights.push(average(&self.weights[a], &self.weights[b]));
        self.used.push(false);
        let t = self.twins[h];
        // The face of h = (a, b, c) keeps (a, w, c); its new half is (w, b, c). Likewise t = (b, a, d) keeps (w, a, d).
        let new_h = self.cut_face_ahead(h, w);
        let new_t = self.cut_face_behind(t, w);
        self.link(new_h, new_t);
        self.link(h, t);
        self.outgoing.push(new_h);
        self.outgoing[a] = h;
        self.outgoing[b] = new_t;
        w
    }

    /// Cuts the face (a, b, c) of `h` = ab along wc; the face keeps (a, w, c). Returns the halfedge wb of the new face.
    fn cut_face_ahead(&mut self, h: HalfedgeId, w: VertexId) -> HalfedgeId {
        let (b, c) = (self.head(h), self.apex(h));
        let new = self.push_face(h.face(), [w, b, c]);
        let far = h.next();
        self.move_edge(far, new.next());
        self.faces[h.face()][far.corner()] = w;
        self.link(far, new.prev());
        self.on_path[far] = false;
        self.outgoing[c] = new.prev();
        new
    }

    /// Cuts the face (b, a, d) of `t` = ba along wd; the face keeps (w, a, d). Returns the halfedge bw of the new face.
    fn cut_face_behind(&mut self, t: HalfedgeId, w: VertexId) -> HalfedgeId {
        let (b, d) = (self.tail(t), self.apex(t));
        let new = self.push_face(t.face(), [b, w, d]);
        let far = t.prev();
        self.move_edge(far, new.prev());
        self.faces[t.face()][t.corner()] = w;
        self.link(far, new.next());
        self.on_path[far] = false;
        self.outgoing[d] = far;
        new
    }

    fn push_face(&mut self, parent: FaceId, corners: [VertexId; 3]) -> HalfedgeId {
        let f = self.faces.push_and_get_key(corners);
        self.face_origin.push(self.face_origin[parent]);
        for _ in 0..3 {
            self.twins.push(HalfedgeId(u32::MAX));
            self.on_path.push(false);
        }
        HalfedgeId::of(f, 0)
    }

    /// Hands an edge's twin and mark over to another halfedge.
    fn move_edge(&mut self, from: HalfedgeId, to: HalfedgeId) {
        let twin = self.twins[from];
        self.link(to, twin);
        self.on_path[to] = self.on_path[from];
    }

    fn link(&mut self, h: HalfedgeId, t: HalfedgeId) {
        self.twins[h] = t;
        self.twins[t] = h;
    }

    /// Marks both halfedges of an edge as part of a path.
    pub fn mark_path(&mut self, h: HalfedgeId) {
        let t = self.twins[h];
        self.on_path[h] = true;
        self.on_path[t] = true;
    }

    /// Takes the mark of [`Self::mark_path`] away.
    pub fn unmark_path(&mut self, h: HalfedgeId) {
        let t = self.twins[h];
        self.on_path[h] = false;
        self.on_path[t] = false;
    }

    /// Splits every edge off the paths whose two ends lie on paths, so that no patch is bridged by one edge.
    pub fn split_bridges(&mut self) {
        let mut h = HalfedgeId(0);
        while h.index() < self.twins.len() {
            if !self.on_path[h] && self.used[self.tail(h)] && self.used[self.head(h)] {
                self.split_edge(h);
            }
            h.0 += 1;
        }
    }

    /// The point of the input mesh where a refined vertex lies, as a point of an input face around it.
    pub fn origin(&self, v: VertexId, input: &SurfaceMesh) -> SurfacePoint {
        let face = self.face_origin[self.outgoing[v].face()];
        let corners = input.triangles()[face];
        let weight = |corner: VertexId| self.weights[v].iter().filter(|w| w.0 == corner).map(|w| w.1).sum();
        SurfacePoint { face, barycentric: corners.map(weight) }
    }
}

/// The midpoint of two points of one closed input face.
fn average(a: &InputWeights, b: &InputWeights) -> InputWeights {
    let filler = a[0].0;
    let mut mean: InputWeights = [(filler, 0.0); 3];
    let mut count = 0;
    for &(v, w) in a.iter().chain(b).filter(|(_, w)| *w > 0.0) {
        match mean[..count].iter_mut().find(|m| m.0 == v) {
            Some(entry) => entry.1 += 0.5 * w,
            None => {
                mean[count] = (v, 0.5 * w);
                count += 1;
            }
        }
    }
    mean
}

/// Checks of invariants of every refined mesh, for the tests of layouts.
#[cfg(test)]
pub(super) mod testing {
    use super::*;

    /// Checks that a mesh is a closed manifold of genus 0 and area 1 whose arrays agree; returns it.
    pub(in crate::layout) fn assert_consistent(mesh: &RefinableMesh) -> SurfaceMesh {
        let refined = SurfaceMesh::from_triangles(mesh.positions.clone(), mesh.faces.clone()).unwrap();
        assert_eq!(refined.euler_characteristic(), 2);
        assert!((refined.area() - 1.0).abs() < 1e-12);
        refined.halfedges().for_each(|h| assert_eq!(refined.twin(h), mesh.twins[h]));
        refined.halfedges().for_each(|h| assert_eq!(mesh.on_path[h], mesh.on_path[mesh.twins[h]]));
        refined.vertices().for_each(|v| assert_eq!(mesh.tail(mesh.outgoing[v]), v));
        refined
    }
}

#[cfg(test)]
mod tests {
    use super::testing::assert_consistent;
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn splits_keep_a_closed_manifold_of_the_same_area() {
        let input = icosphere(1);
        let mut mesh = RefinableMesh::new(&input, &[]);
        for k in 0..200_u32 {
            mesh.split_edge(HalfedgeId(k * 7919 % mesh.twins.len() as u32));
        }
        let refined = assert_consistent(&mesh);
        for v in refined.vertices() {
            let scale = input.area().sqrt();
            let p = mesh.origin(v, &input).position(&input) / scale;
            assert!(p.distance(mesh.positions[v]) < 1e-12);
        }
    }
}

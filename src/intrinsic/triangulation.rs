//! A triangulation by its gluing, with flips and their log.

use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// A closed triangulation as a gluing of triangles; halfedge 3 f + k is the k-th of face f.
#[derive(Clone, Debug, PartialEq)]
pub struct IntrinsicTriangulation {
    vertices: usize,
    tails: TiVec<HalfedgeId, VertexId>,
    twins: TiVec<HalfedgeId, HalfedgeId>,
    /// The flips made so far, oldest first.
    flips: Vec<HalfedgeId>,
}

/// The move of the data of one halfedge in a flip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Move {
    /// The halfedge that has the data before the flip.
    pub from: HalfedgeId,
    /// The halfedge that has the data after the flip.
    pub to: HalfedgeId,
}

impl IntrinsicTriangulation {
    /// The connectivity of a mesh.
    pub fn of_mesh(mesh: &SurfaceMesh) -> Self {
        Self {
            vertices: mesh.vertex_count(),
            tails: mesh.halfedges().map(|h| mesh.tail(h)).collect(),
            twins: mesh.halfedges().map(|h| mesh.twin(h)).collect(),
            flips: Vec::new(),
        }
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.tails.len() / 3
    }

    /// All halfedges.
    pub fn halfedges(&self) -> impl ExactSizeIterator<Item = HalfedgeId> + use<> {
        (0..self.tails.len()).map(HalfedgeId::from)
    }

    /// All faces.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count()).map(FaceId::from)
    }

    /// Start vertex of a halfedge.
    #[inline]
    pub fn tail(&self, h: HalfedgeId) -> VertexId {
        self.tails[h]
    }

    /// The opposite halfedge.
    #[inline]
    pub fn twin(&self, h: HalfedgeId) -> HalfedgeId {
        self.twins[h]
    }

    /// The flips made so far, oldest first.
    pub fn flips(&self) -> &[HalfedgeId] {
        &self.flips
    }

    /// Whether the edge has two different faces, so that it can be flipped.
    #[inline]
    pub fn is_flippable(&self, h: HalfedgeId) -> bool {
        h.face() != self.twins[h].face()
    }

    /// Replaces the diagonal of the diamond around `h` by the other one.
    ///
    /// `h` = ij in ijk and its twin ji in jil become lk in lki and kl in klj. Returns where per-halfedge data of the four
    /// sides goes: all reads come before all writes.
    ///
    /// # Panics
    /// When the edge is not flippable.
    pub fn flip(&mut self, h: HalfedgeId) -> [Move; 4] {
        assert!(self.is_flippable(h));
        self.flips.push(h);
        let moves = self.flip_moves(h);
        self.glue(h, &moves);
        moves
    }

    /// Undoes the last flip; returns its halfedge and where per-halfedge data of the four sides goes.
    pub fn unflip(&mut self) -> Option<(HalfedgeId, [Move; 4])> {
        let h = self.flips.pop()?;
        let moves = self.flip_moves(h).map(|Move { from, to }| Move { from: to, to: from });
        self.glue(h, &moves);
        Some((h, moves))
    }

    fn flip_moves(&self, h: HalfedgeId) -> [Move; 4] {
        let t = self.twins[h];
        let (hn, hp, tn, tp) = (h.next(), h.prev(), t.next(), t.prev());
        [(hp, hn), (tn, hp), (tp, tn), (hn, tp)].map(|(from, to)| Move { from, to })
    }

    fn glue(&mut self, h: HalfedgeId, moves: &[Move; 4]) {
        let t = self.twins[h];
        let old = moves.map(|m| (self.tails[m.from], self.twins[m.from]));
        let moved = |g: HalfedgeId| moves.iter().find(|m| m.from == g).map_or(g, |m| m.to);
        for (Move { to, .. }, (tail, twin)) in moves.iter().zip(old) {
            let twin = moved(twin);
            self.tails[*to] = tail;
            self.twins[*to] = twin;
            self.twins[twin] = *to;
        }
        self.tails[h] = self.tails[t.next()];
        self.tails[t] = self.tails[h.next()];
    }

    /// Checks the gluing: twins pair up and agree on their vertices, every vertex has one fan, and V - E + F is kept.
    pub fn is_consistent(&self) -> bool {
        let paired = self.halfedges().all(|h| {
            let t = self.twins[h];
            t != h && self.twins[t] == h && self.tails[t] == self.tails[h.next()]
        });
        paired && self.fans() == self.vertices
    }

    /// Number of fans of corners around vertices.
    fn fans(&self) -> usize {
        let mut seen = vec![false; self.tails.len()];
        let mut fans = 0;
        for h in self.halfedges() {
            if seen[h.index()] {
                continue;
            }
            fans += 1;
            let mut g = h;
            while !std::mem::replace(&mut seen[g.index()], true) {
                g = self.twins[g.prev()];
            }
        }
        fans
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{icosphere, tetrahedron};

    #[test]
    fn flips_keep_the_gluing_and_unflips_restore_it() {
        for mesh in [tetrahedron(), icosphere(1)] {
            let original = IntrinsicTriangulation::of_mesh(&mesh);
            let mut complex = original.clone();
            for k in 0..500_u32 {
                let h = HalfedgeId(k * 7919 % (mesh.face_count() as u32 * 3));
                if complex.is_flippable(h) {
                    complex.flip(h);
                    assert!(complex.is_consistent(), "after flip {k}");
                }
            }
            while complex.unflip().is_some() {}
            assert_eq!(complex, original);
        }
    }
}

//! An exact test whether two layouts define maps of the same isotopy class.
//!
//! A layout fixes the map up to isotopy that keeps the landmarks: its paths on the source go onto those on the target. A
//! path between landmarks is determined up to isotopy by the edges that it crosses in a triangulation by other paths, once
//! immediate returns over an edge and turns round its own ends are left out (normal form of arcs on a punctured sphere). So a second
//! layout is of the same class when every path of it crosses the same base edges of the first, in the same order, on both
//! meshes. Paths are pushed to their left, which decides all coincidences.

use super::base_layout::{BaseLayout, PatchedMesh};
use crate::landmarks::{LandmarkId, MeshSide};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use std::collections::VecDeque;
use typed_index_collections::{TiVec, ti_vec};

/// Whether both layouts, drawn on the same two meshes with the same landmarks, define maps of the same isotopy class.
pub fn same_class(first: &BaseLayout, second: &BaseLayout) -> bool {
    Class::new(first.clone()).contains(second)
}

/// An isotopy class, given by a layout that is prepared for comparisons.
#[derive(Clone, Debug)]
pub(super) struct Class {
    layout: BaseLayout,
    /// The smaller base halfedge of the path that each refined halfedge lies on, on each mesh.
    on_path: [TiVec<HalfedgeId, Option<HalfedgeId>>; 2],
    /// One refined face of each input face, on each mesh.
    some_face: [Vec<Option<FaceId>>; 2],
}

impl Class {
    pub fn new(layout: BaseLayout) -> Self {
        let on_path = [&layout.source, &layout.target].map(|side| {
            let mut marks = ti_vec![None; side.mesh.face_count() * 3];
            for h in layout.base.mesh.edges() {
                for pair in side.paths[h].windows(2) {
                    if let Some(g) = side.mesh.halfedge_between(pair[0], pair[1]) {
                        marks[g] = Some(h);
                        marks[side.mesh.twin(g)] = Some(h);
                    }
                }
            }
            marks
        });
        let some_face = [&layout.source, &layout.target].map(|side| {
            let inputs = side.face_origin.iter().map(|f| f.index() + 1).max().unwrap_or(0);
            let mut faces = vec![None; inputs];
            side.face_origin.iter_enumerated().for_each(|(f, origin)| faces[origin.index()] = Some(f));
            faces
        });
        Self { layout, on_path, some_face }
    }

    /// Whether another layout on the same meshes and landmarks is of this class.
    pub fn contains(&self, other: &BaseLayout) -> bool {
        let base = &other.base;
        base.mesh.edges().all(|h| {
            let ends = [base.tail(h), base.head(h)];
            let words = [(MeshSide::Source, &other.source), (MeshSide::Target, &other.target)]
                .map(|(side, patched)| self.word(side, &faces_beside(patched, &patched.paths[h]), ends));
            words[0].is_some() && words[0] == words[1]
        })
    }

    /// The base edges that a strip of input faces from one landmark to another crosses, as a reduced word.
    fn word(&self, side: MeshSide, strip: &[FaceId], ends: [LandmarkId; 2]) -> Option<Vec<HalfedgeId>> {
        let patched = [&self.layout.source, &self.layout.target][side];
        let [start, end] = ends.map(|l| patched.landmark_vertices[l]);
        let mut walk = Walk { patched, on_path: &self.on_path[side], crossed: Vec::new() };
        let seed = self.some_face[side][strip[0].index()]?;
        let at_start = |f: FaceId| patched.mesh.triangles()[f].contains(&start);
        let mut at = walk.go(seed, |h| at_start(h.face()))?.face();
        walk.crossed.clear();
        for next in &strip[1..] {
            let exit = walk.go(at, |h| patched.face_origin[patched.mesh.twin(h).face()] == *next)?;
            walk.cross(exit);
            at = patched.mesh.twin(exit).face();
        }
        walk.go(at, |h| patched.mesh.triangles()[h.face()].contains(&end))?;
        Some(self.without_turns_at_ends(walk.crossed, ends))
    }

    fn without_turns_at_ends(&self, word: Vec<HalfedgeId>, [start, end]: [LandmarkId; 2]) -> Vec<HalfedgeId> {
        let base = &self.layout.base;
        let touches = |h: HalfedgeId, l: LandmarkId| base.tail(h) == l || base.head(h) == l;
        let first = word.iter().position(|&h| !touches(h, start)).unwrap_or(word.len());
        let last = word.iter().rposition(|&h| !touches(h, end)).map_or(first, |k| k + 1);
        word[first..last.max(first)].to_vec()
    }
}

/// A walk over refined faces that notes the paths it crosses.
struct Walk<'a> {
    patched: &'a PatchedMesh,
    on_path: &'a TiVec<HalfedgeId, Option<HalfedgeId>>,
    crossed: Vec<HalfedgeId>,
}

impl Walk<'_> {
    /// Goes inside one input face to the nearest refined face with a halfedge that is wanted.
    fn go(&mut self, from: FaceId, wanted: impl Fn(HalfedgeId) -> bool) -> Option<HalfedgeId> {
        let mesh = &self.patched.mesh;
        let origin = self.patched.face_origin[from];
        // Few refined faces lie in an input face: a list of those reached and the halfedge by which they were entered will do.
        let mut reached: Vec<(FaceId, Option<HalfedgeId>)> = vec![(from, None)];
        let mut queue = VecDeque::from([from]);
        while let Some(face) = queue.pop_front() {
            if let Some(h) = face.halfedges().into_iter().find(|&h| wanted(h)) {
                self.cross_all(&reached, face);
                return Some(h);
            }
            for h in face.halfedges() {
                let next = mesh.twin(h).face();
                if self.patched.face_origin[next] == origin && reached.iter().all(|r| r.0 != next) {
                    reached.push((next, Some(h)));
                    queue.push_back(next);
                }
            }
        }
        None
    }

    fn cross_all(&mut self, reached: &[(FaceId, Option<HalfedgeId>)], to: FaceId) {
        let mut way = Vec::new();
        let mut at = to;
        while let Some(&(_, Some(h))) = reached.iter().find(|r| r.0 == at) {
            way.push(h);
            at = h.face();
        }
        way.into_iter().rev().for_each(|h| self.cross(h));
    }

    fn cross(&mut self, h: HalfedgeId) {
        let Some(edge) = self.on_path[h] else { return };
        if self.crossed.last() == Some(&edge) {
            self.crossed.pop();
        } else {
            self.crossed.push(edge);
        }
    }
}

/// The input faces on the left of a path, from its first edge to its last, each adjacent to the one before.
fn faces_beside(patched: &PatchedMesh, path: &[VertexId]) -> Vec<FaceId> {
    let mesh = &patched.mesh;
    let mut faces: Vec<FaceId> = Vec::new();
    let mut push = |f: FaceId| {
        let origin = patched.face_origin[f];
        if faces.last() != Some(&origin) {
            faces.push(origin);
        }
    };
    let Some(mut incoming) = mesh.halfedge_between(path[0], path[1]) else { return faces };
    push(incoming.face());
    for &next in &path[2..] {
        let (mut out, back) = (incoming.next(), mesh.twin(incoming));
        // Ends at the path's last edge at the latest.
        while mesh.head(out) != next && out != back {
            out = mesh.twin(out).next();
            push(out.face());
        }
        incoming = out;
    }
    faces
}

//! A closed, oriented, manifold triangle mesh with positions.

use super::ids::star;
use super::{FaceId, HalfedgeId, VertexId};
use crate::math::triangle;
use glam::DVec3;
use std::ops::Range;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A closed, oriented, manifold triangle mesh: every halfedge has a twin and every vertex one fan of triangles.
///
/// It may have any genus and number of components; [`crate::mesh::check`] asks for one component of genus 0.
/// Immutable: algorithms that refine build a new one.
#[derive(Clone, Debug)]
pub struct SurfaceMesh {
    positions: TiVec<VertexId, DVec3>,
    faces: TiVec<FaceId, [VertexId; 3]>,
    twins: TiVec<HalfedgeId, HalfedgeId>,
    outgoing: TiVec<VertexId, HalfedgeId>,
}

/// Why triangles do not make a closed manifold mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are {vertices} vertices")]
    MissingVertex {
        /// The face, 0-based.
        face: usize,
        /// The vertex number it names.
        vertex: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// A halfedge occurs twice or has no twin.
    #[error("edge {}-{} does not have exactly two oppositely oriented faces", edge[0], edge[1])]
    Edge {
        /// The vertex numbers of its ends.
        edge: [usize; 2],
    },
    /// A vertex has no face or more than one fan of faces.
    #[error("vertex {vertex} does not have exactly one fan of faces")]
    Vertex {
        /// The vertex, 0-based.
        vertex: usize,
    },
}

impl SurfaceMesh {
    /// Builds the connectivity of triangles given as counter-clockwise vertex triples.
    ///
    /// # Errors
    /// [`MeshError`] with the first element that is not manifold, closed or consistently oriented.
    pub fn from_triangles(
        positions: TiVec<VertexId, DVec3>,
        faces: TiVec<FaceId, [VertexId; 3]>,
    ) -> Result<Self, MeshError> {
        check_vertex_numbers(positions.len(), &faces)?;
        let twins = twins(positions.len(), &faces)?;
        let outgoing = outgoing(positions.len(), &faces, &twins)?;
        Ok(Self { positions, faces, twins, outgoing })
    }

    /// A mesh whose twins are known: they are checked, which is quicker than to find them.
    ///
    /// # Errors
    /// As [`Self::from_triangles`].
    pub(super) fn from_twins(
        positions: TiVec<VertexId, DVec3>,
        faces: TiVec<FaceId, [VertexId; 3]>,
        twins: TiVec<HalfedgeId, HalfedgeId>,
    ) -> Result<Self, MeshError> {
        check_vertex_numbers(positions.len(), &faces)?;
        check_twins(&faces, &twins)?;
        let outgoing = outgoing(positions.len(), &faces, &twins)?;
        Ok(Self { positions, faces, twins, outgoing })
    }

    /// A mesh whose connectivity is known to be closed and manifold; every vertex has a face.
    pub(super) fn from_parts(
        positions: TiVec<VertexId, DVec3>,
        faces: TiVec<FaceId, [VertexId; 3]>,
        twins: TiVec<HalfedgeId, HalfedgeId>,
    ) -> Self {
        let mut outgoing = ti_vec![HalfedgeId(u32::MAX); positions.len()];
        for (f, corners) in faces.iter_enumerated().rev() {
            (0..3).for_each(|k| outgoing[corners[k]] = HalfedgeId::of(f, k));
        }
        Self { positions, faces, twins, outgoing }
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of triangles.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// Number of edges, 3/2 of the number of triangles.
    pub fn edge_count(&self) -> usize {
        self.faces.len() * 3 / 2
    }

    /// V - E + F; 2 for one component of genus 0.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// All vertex numbers.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count()).map(VertexId::from)
    }

    /// All face numbers.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count()).map(FaceId::from)
    }

    /// The halfedge of a face that starts at a vertex; `None` where the vertex is none of the face's corners.
    pub fn corner_at(&self, face: FaceId, v: VertexId) -> Option<HalfedgeId> {
        face.halfedges().into_iter().find(|&h| self.tail(h) == v)
    }

    /// All halfedge numbers.
    pub fn halfedges(&self) -> impl ExactSizeIterator<Item = HalfedgeId> + use<> {
        (0..self.face_count() * 3).map(HalfedgeId::from)
    }

    /// The halfedges `h < twin(h)`: each edge once.
    pub fn edges(&self) -> impl Iterator<Item = HalfedgeId> + '_ {
        self.halfedges().filter(|&h| h < self.twins[h])
    }

    /// Corner positions by vertex.
    pub fn positions(&self) -> &TiSlice<VertexId, DVec3> {
        &self.positions
    }

    /// Vertex triples by face, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &TiSlice<FaceId, [VertexId; 3]> {
        &self.faces
    }

    /// The opposite halfedge of the neighbouring face.
    #[inline]
    pub fn twin(&self, h: HalfedgeId) -> HalfedgeId {
        self.twins[h]
    }

    /// Start vertex of a halfedge.
    #[inline]
    pub fn tail(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }

    /// End vertex of a halfedge.
    #[inline]
    pub fn head(&self, h: HalfedgeId) -> VertexId {
        self.tail(h.next())
    }

    /// One halfedge that starts at the vertex.
    #[inline]
    pub fn outgoing(&self, v: VertexId) -> HalfedgeId {
        self.outgoing[v]
    }

    /// The halfedges that start at the vertex, counter-clockwise.
    pub fn star(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        star(self.outgoing[v], |h| self.twins[h])
    }

    /// The halfedge from one vertex to another, if they are neighbours.
    pub fn halfedge_between(&self, tail: VertexId, head: VertexId) -> Option<HalfedgeId> {
        self.star(tail).find(|&h| self.head(h) == head)
    }

    /// Corner positions of a face.
    #[inline]
    pub fn corners(&self, f: FaceId) -> [DVec3; 3] {
        self.faces[f].map(|v| self.positions[v])
    }

    /// Length of an edge.
    pub fn length(&self, h: HalfedgeId) -> f64 {
        self.positions[self.tail(h)].distance(self.positions[self.head(h)])
    }

    /// The cotangent of the angle opposite a halfedge in its face; infinite or not a number where the face has no area.
    pub fn cotangent(&self, h: HalfedgeId) -> f64 {
        let [tail, head, apex] = [h, h.next(), h.prev()].map(|corner| self.positions[self.tail(corner)]);
        triangle::cotangent_between(tail - apex, head - apex)
    }

    /// Area of a face.
    pub fn face_area(&self, f: FaceId) -> f64 {
        let [p, q, r] = self.corners(f);
        triangle::area(p, q, r)
    }

    /// The area that belongs to each vertex: a third of the faces around it.
    pub fn vertex_areas(&self) -> TiVec<VertexId, f64> {
        let mut areas = ti_vec![0.0; self.vertex_count()];
        for f in self.faces() {
            let third = self.face_area(f) / 3.0;
            self.triangles()[f].iter().for_each(|&v| areas[v] += third);
        }
        areas
    }

    /// Area of the whole surface.
    pub fn area(&self) -> f64 {
        self.faces().map(|f| self.face_area(f)).sum()
    }

    /// The middle of its area; `None` for a surface without area.
    pub fn centre(&self) -> Option<DVec3> {
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for [a, b, c] in self.faces().map(|f| self.corners(f)) {
            let area = (b - a).cross(c - a).length();
            sum += area * (a + b + c) / 3.0;
            total += area;
        }
        (total > 0.0).then(|| sum / total)
    }

    /// The same connectivity with other positions.
    ///
    /// # Panics
    /// When the number of positions differs.
    pub fn with_positions(&self, positions: TiVec<VertexId, DVec3>) -> Self {
        assert_eq!(positions.len(), self.positions.len());
        Self { positions, ..self.clone() }
    }
}

fn check_vertex_numbers(vertices: usize, faces: &TiSlice<FaceId, [VertexId; 3]>) -> Result<(), MeshError> {
    for (f, corners) in faces.iter_enumerated() {
        if let Some(v) = corners.iter().find(|v| v.index() >= vertices) {
            return Err(MeshError::MissingVertex { face: f.index(), vertex: v.index(), vertices });
        }
    }
    Ok(())
}

fn twins(
    vertices: usize,
    faces: &TiSlice<FaceId, [VertexId; 3]>,
) -> Result<TiVec<HalfedgeId, HalfedgeId>, MeshError> {
    let edge_error = |a: VertexId, b: VertexId| MeshError::Edge { edge: [a.index(), b.index()] };
    let by_tail = ByTail::new(vertices, faces);
    let mut twins = ti_vec![HalfedgeId(0); faces.len() * 3];
    let mut lonely = None;
    for (h, a, b) in directed_edges(faces) {
        if a == b || by_tail.first(a, b) != Some(h) {
            return Err(edge_error(a, b));
        }
        match by_tail.first(b, a) {
            Some(twin) => twins[h] = twin,
            None => lonely = lonely.or(Some([a, b])),
        }
    }
    lonely.map_or(Ok(twins), |[a, b]| Err(edge_error(a, b)))
}

/// Every halfedge with its ends.
fn directed_edges(
    faces: &TiSlice<FaceId, [VertexId; 3]>,
) -> impl Iterator<Item = (HalfedgeId, VertexId, VertexId)> {
    let of_face = |(f, corners): (FaceId, &[VertexId; 3])| {
        let corners = *corners;
        (0..3).map(move |k| (HalfedgeId::of(f, k), corners[k], corners[(k + 1) % 3]))
    };
    faces.iter_enumerated().flat_map(of_face)
}

/// Halfedges by the vertices that they come from.
struct ByTail {
    /// The place of the first entry of each vertex, and one past the end.
    starts: Vec<u32>,
    /// The other end and the halfedge, ascending at each vertex.
    entries: Vec<(VertexId, HalfedgeId)>,
}

impl ByTail {
    fn new(vertices: usize, faces: &TiSlice<FaceId, [VertexId; 3]>) -> Self {
        let mut starts = vec![0u32; vertices + 1];
        directed_edges(faces).for_each(|(_, tail, _)| starts[tail.index() + 1] += 1);
        (0..vertices).for_each(|v| starts[v + 1] += starts[v]);
        let mut next = starts.clone();
        let mut entries = vec![(VertexId(0), HalfedgeId(0)); faces.len() * 3];
        for (h, tail, head) in directed_edges(faces) {
            let place = &mut next[tail.index()];
            entries[*place as usize] = (head, h);
            *place += 1;
        }
        let mut by_tail = Self { starts, entries };
        for v in 0..vertices {
            let range = by_tail.range(VertexId::from(v));
            by_tail.entries[range].sort_unstable();
        }
        by_tail
    }

    fn range(&self, v: VertexId) -> Range<usize> {
        self.starts[v.index()] as usize..self.starts[v.index() + 1] as usize
    }

    /// The halfedge of the least number from one vertex to another.
    fn first(&self, tail: VertexId, head: VertexId) -> Option<HalfedgeId> {
        let around = &self.entries[self.range(tail)];
        let found = around.get(around.partition_point(|entry| entry.0 < head))?;
        (found.0 == head).then_some(found.1)
    }
}

/// Each halfedge has one twin, whose twin it is, and both go the same edge in opposite directions.
fn check_twins(
    faces: &TiSlice<FaceId, [VertexId; 3]>,
    twins: &TiSlice<HalfedgeId, HalfedgeId>,
) -> Result<(), MeshError> {
    let ends = |h: HalfedgeId| {
        let corners = faces[h.face()];
        [corners[h.corner()], corners[(h.corner() + 1) % 3]]
    };
    for h in (0..faces.len() * 3).map(HalfedgeId::from) {
        let [tail, head] = ends(h);
        let known = twins.get(h).filter(|_| twins.len() == faces.len() * 3);
        let is_twin = known.is_some_and(|t| twins.get(*t) == Some(&h) && ends(*t) == [head, tail]);
        if tail == head || !is_twin {
            return Err(MeshError::Edge { edge: [tail.index(), head.index()] });
        }
    }
    Ok(())
}

fn outgoing(
    vertices: usize,
    faces: &TiSlice<FaceId, [VertexId; 3]>,
    twins: &TiSlice<HalfedgeId, HalfedgeId>,
) -> Result<TiVec<VertexId, HalfedgeId>, MeshError> {
    const NONE: HalfedgeId = HalfedgeId(u32::MAX);
    let mut outgoing = ti_vec![NONE; vertices];
    let mut visited = 0;
    for h in (0..faces.len() * 3).map(HalfedgeId::from) {
        let v = faces[h.face()][h.corner()];
        if outgoing[v] != NONE {
            continue;
        }
        outgoing[v] = h;
        let mut around = h;
        loop {
            visited += 1;
            around = twins[around.prev()];
            if around == h {
                break;
            }
        }
    }
    if let Some(v) = outgoing.iter().position(|&h| h == NONE) {
        return Err(MeshError::Vertex { vertex: v });
    }
    if visited != faces.len() * 3 {
        return Err(MeshError::Vertex { vertex: pinched_vertex(faces, twins, &outgoing) });
    }
    Ok(outgoing)
}

/// The first vertex whose fan from its outgoing halfedge misses one of its corners.
fn pinched_vertex(
    faces: &TiSlice<FaceId, [VertexId; 3]>,
    twins: &TiSlice<HalfedgeId, HalfedgeId>,
    outgoing: &TiSlice<VertexId, HalfedgeId>,
) -> usize {
    let mut corners = vec![0_usize; outgoing.len()];
    faces.iter().flatten().for_each(|v| corners[v.index()] += 1);
    for (v, &first) in outgoing.iter_enumerated() {
        let mut fan = 0;
        let mut h = first;
        loop {
            fan += 1;
            h = twins[h.prev()];
            if h == first {
                break;
            }
        }
        if fan != corners[v.index()] {
            return v.index();
        }
    }
    unreachable!("a pinched vertex was counted before")
}

#[cfg(test)]
mod tests {
    use crate::mesh::generators::{icosphere, tetrahedron, torus};

    #[test]
    fn euler_characteristics() {
        assert_eq!(tetrahedron().euler_characteristic(), 2);
        assert_eq!(icosphere(3).euler_characteristic(), 2);
        assert_eq!(torus(7, 5).euler_characteristic(), 0);
    }

    #[test]
    fn twins_and_stars_agree() {
        let mesh = icosphere(2);
        for h in mesh.halfedges() {
            assert_eq!(mesh.twin(mesh.twin(h)), h);
            assert_eq!(mesh.tail(mesh.twin(h)), mesh.head(h));
        }
        let corners: usize = mesh.vertices().map(|v| mesh.star(v).count()).sum();
        assert_eq!(corners, mesh.face_count() * 3);
    }
}

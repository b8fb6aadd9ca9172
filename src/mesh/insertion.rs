//! Points of a surface inserted as vertices.

use super::{FaceFrame, FaceId, MeshError, SurfaceMesh, SurfacePoint, VertexId};
use glam::{DMat3, DVec3};
use rustc_hash::FxHashMap;
use typed_index_collections::TiVec;

/// Nearer than this (in barycentric coordinates) to a corner or an edge, a point is taken to lie on it: no click can be meant
/// that exactly, and the needle beside the edge would have angles of rounding size once its neighbours are small.
const SNAP: f64 = 1e-5;

/// A mesh with points inserted; its first vertices are those of the original.
#[derive(Clone, Debug)]
pub struct Insertion {
    /// The mesh with the points.
    pub mesh: SurfaceMesh,
    /// The original face that contains each face.
    pub face_origin: TiVec<FaceId, FaceId>,
    /// Barycentric coordinates of each face's corners in its original face.
    corner_origins: TiVec<FaceId, [DVec3; 3]>,
    /// The vertex of each point, in the order given.
    pub vertices: Vec<VertexId>,
}

impl Insertion {
    /// The place of a face on the original mesh.
    pub fn frame(&self, face: FaceId) -> FaceFrame {
        FaceFrame { face: self.face_origin[face], corners: self.corner_origins[face].map(|w| w.to_array()) }
    }

    /// A point of the mesh as a point of the original mesh.
    pub fn on_original(&self, point: SurfacePoint) -> SurfacePoint {
        let [p, q, r] = self.corner_origins[point.face];
        let [a, b, c] = point.barycentric;
        SurfacePoint { face: self.face_origin[point.face], barycentric: (p * a + q * b + r * c).to_array() }
    }
}

/// Inserts points as vertices: inside a face it is split in three, on an edge both its faces in two; near a corner the corner
/// itself is taken.
///
/// # Errors
/// [`MeshError`], which points of the mesh rule out.
pub fn insert(mesh: &SurfaceMesh, points: &[SurfacePoint]) -> Result<Insertion, MeshError> {
    let mut refinement = Refinement {
        original: mesh,
        added: FxHashMap::default(),
        positions: mesh.positions().iter().copied().collect(),
        faces: mesh.triangles().iter().copied().collect(),
        face_origin: mesh.faces().collect(),
        corner_origins: mesh.faces().map(|_| [DVec3::X, DVec3::Y, DVec3::Z]).collect(),
    };
    let vertices = points.iter().map(|p| refinement.insert(p)).collect();
    let Refinement { positions, faces, face_origin, corner_origins, added, .. } = refinement;
    Ok(Insertion {
        mesh: if added.is_empty() { mesh.clone() } else { SurfaceMesh::from_triangles(positions, faces)? },
        face_origin,
        corner_origins,
        vertices,
    })
}

/// A corner that a face gets.
#[derive(Clone, Copy)]
struct Corner {
    vertex: VertexId,
    /// Its barycentric coordinates in the original face.
    origin: DVec3,
}

struct Refinement<'a> {
    original: &'a SurfaceMesh,
    /// The faces that came from each original face that was split, in rising order.
    added: FxHashMap<FaceId, Vec<FaceId>>,
    positions: TiVec<VertexId, DVec3>,
    faces: TiVec<FaceId, [VertexId; 3]>,
    face_origin: TiVec<FaceId, FaceId>,
    corner_origins: TiVec<FaceId, [DVec3; 3]>,
}

impl Refinement<'_> {
    fn insert(&mut self, point: &SurfacePoint) -> VertexId {
        let SurfacePoint { face, barycentric: weights } = self.child(point);
        if let Some(k) = (0..3).find(|&k| weights[k] > 1.0 - SNAP) {
            return self.faces[face][k];
        }
        let corners = self.faces[face].map(|v| self.positions[v]);
        if let Some(k) = (0..3).find(|&k| weights[k] < SNAP) {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let share = weights[b] / (weights[a] + weights[b]);
            return self.split_edge(face, [self.faces[face][a], self.faces[face][b]], share);
        }
        let position = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let v = self.positions.push_and_get_key(position);
        let origins = self.corner_origins[face];
        let origin = origins[0] * weights[0] + origins[1] * weights[1] + origins[2] * weights[2];
        let corner = Corner { vertex: v, origin };
        for k in 1..3 {
            self.replace_corner(face, k, corner);
        }
        self.set_corner(face, 2, corner);
        v
    }

    /// A point of the original mesh as a point of the face that contains it.
    fn child(&self, point: &SurfacePoint) -> SurfacePoint {
        let goal = DVec3::from_array(point.barycentric);
        let coordinates = |f: FaceId| {
            let [p, q, r] = self.corner_origins[f];
            DMat3::from_cols(p, q, r).inverse() * goal
        };
        let all = self.children(point.face).map(|f| (f, coordinates(f)));
        let best = all.max_by(|a, b| a.1.min_element().total_cmp(&b.1.min_element()));
        let (face, weights) = best.unwrap_or((point.face, goal));
        SurfacePoint { face, barycentric: weights.to_array() }
    }

    /// The faces in an original face, ascending: its own number, and those that were added.
    fn children(&self, original: FaceId) -> impl Iterator<Item = FaceId> {
        let added = self.added.get(&original).into_iter().flatten();
        std::iter::once(original).chain(added.copied())
    }

    /// Adds a copy of a face with corner `k - 1` replaced: the child opposite that corner.
    fn replace_corner(&mut self, face: FaceId, k: usize, corner: Corner) {
        let (mut corners, mut origins) = (self.faces[face], self.corner_origins[face]);
        corners[k - 1] = corner.vertex;
        origins[k - 1] = corner.origin;
        let (added, original) = (self.faces.push_and_get_key(corners), self.face_origin[face]);
        self.corner_origins.push(origins);
        self.face_origin.push(original);
        self.added.entry(original).or_default().push(added);
    }

    fn set_corner(&mut self, face: FaceId, k: usize, corner: Corner) {
        self.faces[face][k] = corner.vertex;
        self.corner_origins[face][k] = corner.origin;
    }

    /// Splits the edge ab of a face at the given share of the way to b, in both faces beside it.
    fn split_edge(&mut self, face: FaceId, [a, b]: [VertexId; 2], share: f64) -> VertexId {
        let v = self.positions.push_and_get_key(self.positions[a].lerp(self.positions[b], share));
        let beside = |f: &[VertexId; 3]| f.contains(&a) && f.contains(&b);
        // The other face is in the same original face, or in one beside it.
        let original = self.face_origin[face];
        let neighbours = original.halfedges().map(|h| self.original.twin(h).face());
        let near = std::iter::once(original).chain(neighbours).flat_map(|f| self.children(f));
        let mut found: Vec<FaceId> = near.filter(|&f| beside(&self.faces[f])).collect();
        found.sort_unstable();
        found.dedup();
        for face in found {
            let place = |w: VertexId| self.faces[face].iter().position(|&x| x == w).unwrap_or(0);
            let (ka, kb) = (place(a), place(b));
            let origins = self.corner_origins[face];
            let corner = Corner { vertex: v, origin: origins[ka].lerp(origins[kb], share) };
            self.replace_corner(face, ka + 1, corner);
            self.set_corner(face, kb, corner);
        }
        v
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::HalfedgeId;
    use crate::mesh::generators::icosphere;

    #[test]
    fn every_edge_is_split_in_three() {
        let mesh = icosphere(1);
        let on = SurfacePoint::on_halfedge;
        let edges: Vec<HalfedgeId> = mesh.edges().collect();
        // When the quarter point comes, its edge is already halved, and the point is given in the face on the other side.
        let halves = edges.iter().map(|&h| on(h, 0.5));
        let quarters = edges.iter().map(|&h| on(mesh.twin(h), 0.25));
        let inserted = insert(&mesh, &halves.chain(quarters).collect::<Vec<_>>()).unwrap();
        assert_eq!(inserted.mesh.vertex_count(), mesh.vertex_count() + 2 * edges.len());
        assert_eq!(inserted.mesh.face_count(), mesh.face_count() + 4 * edges.len());
        assert_eq!(inserted.mesh.euler_characteristic(), 2);
        assert!((inserted.mesh.area() - mesh.area()).abs() < 1e-12);
    }

    #[test]
    fn points_become_vertices_where_they_are() {
        let mesh = icosphere(1);
        let at = |face, barycentric| SurfacePoint { face: FaceId(face), barycentric };
        let points = [
            at(7, [0.2, 0.3, 0.5]),
            at(7, [0.6, 0.3, 0.1]),
            at(7, [0.0, 0.25, 0.75]),
            at(7, [0.0, 0.5, 0.5]),
            at(9, [0.0, 1.0, 0.0]),
            at(3, [0.5, 0.5, 0.0]),
        ];
        let inserted = insert(&mesh, &points).unwrap();
        assert_eq!(inserted.mesh.euler_characteristic(), 2);
        assert_eq!(inserted.mesh.vertex_count(), mesh.vertex_count() + 5);
        assert!((inserted.mesh.area() - mesh.area()).abs() < 1e-12);
        for (point, &v) in points.iter().zip(&inserted.vertices) {
            let there = inserted.mesh.positions()[v];
            assert!(point.position(&mesh).distance(there) < 1e-12);
            let back = inserted.on_original(SurfacePoint::at_vertex(&inserted.mesh, v));
            assert!(back.position(&mesh).distance(there) < 1e-12);
        }
        for f in inserted.mesh.faces() {
            assert!(inserted.mesh.face_area(f) > 0.0);
        }
    }
}

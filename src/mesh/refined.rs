//! A mesh that refines an input mesh, and points carried between the two.

use super::insertion::insert;
use super::{FaceFrame, FaceId, HalfedgeId, MeshError, SurfaceMesh, SurfacePoint, VertexId};
use crate::math::triangle::angle_at;
use typed_index_collections::TiVec;

/// A mesh that refines an input mesh, scaled: to area 1, as long as it is not scaled otherwise.
#[derive(Clone, Debug)]
pub struct RefinedMesh {
    /// The refined mesh. Its first vertices are the input mesh's vertices in their order.
    pub mesh: SurfaceMesh,
    /// The point of the input mesh at each refined vertex.
    pub vertex_origin: TiVec<VertexId, SurfacePoint>,
    /// The input face that contains each refined face.
    pub face_origin: TiVec<FaceId, FaceId>,
}

impl RefinedMesh {
    /// The input mesh itself, scaled to area 1.
    pub fn unrefined(input: &SurfaceMesh) -> Self {
        let scale = 1.0 / input.area().sqrt();
        Self {
            mesh: input.with_positions(input.positions().iter().map(|&p| p * scale).collect()),
            vertex_origin: input.vertices().map(|v| SurfacePoint::at_vertex(input, v)).collect(),
            face_origin: input.faces().collect(),
        }
    }

    /// The same mesh, `factor` times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let positions = self.mesh.positions().iter().map(|&p| p * factor).collect();
        Self { mesh: self.mesh.with_positions(positions), ..self.clone() }
    }

    /// The same mesh with points of it inserted as vertices after those that there are, and the vertex of each point.
    ///
    /// # Errors
    /// [`MeshError`], which points of the mesh rule out.
    pub fn with_points(
        &self,
        input: &SurfaceMesh,
        points: &[SurfacePoint],
    ) -> Result<(Self, Vec<VertexId>), MeshError> {
        let inserted = insert(&self.mesh, points)?;
        let on_input = |v: VertexId| {
            self.on_input(input, inserted.on_original(SurfacePoint::at_vertex(&inserted.mesh, v)))
        };
        let known = self.mesh.vertex_count();
        let added = inserted.mesh.vertices().skip(known).map(on_input);
        let refined = Self {
            vertex_origin: self.vertex_origin.iter().copied().chain(added).collect(),
            face_origin: inserted.face_origin.iter().map(|&f| self.face_origin[f]).collect(),
            mesh: inserted.mesh,
        };
        Ok((refined, inserted.vertices))
    }

    /// The same mesh with at least `least` vertices: as long as there are fewer, every edge is bisected.
    ///
    /// # Errors
    /// As [`Self::with_points`].
    pub fn with_vertices(&self, input: &SurfaceMesh, least: usize) -> Result<Self, MeshError> {
        let mut refined = self.clone();
        while refined.mesh.vertex_count() < least {
            let middle = |h: HalfedgeId| SurfacePoint::on_halfedge(h, 0.5);
            let points: Vec<SurfacePoint> = refined.mesh.edges().map(middle).collect();
            refined = refined.with_points(input, &points)?.0;
        }
        Ok(refined)
    }

    /// The same mesh with at least `degree` edges at each of some vertices: the widest faces there are bisected.
    ///
    /// # Errors
    /// As [`Self::with_points`].
    pub fn with_degrees(
        &self,
        input: &SurfaceMesh,
        vertices: impl IntoIterator<Item = VertexId>,
        degree: usize,
    ) -> Result<Self, MeshError> {
        let vertices: Vec<VertexId> = vertices.into_iter().collect();
        let mut refined = self.clone();
        // The bisector of one vertex may be cut by that of a neighbour, and is made again then.
        for _ in 0..BISECTIONS {
            let points: Vec<SurfacePoint> =
                vertices.iter().flat_map(|&v| bisectors(&refined.mesh, v, degree)).collect();
            if points.is_empty() {
                break;
            }
            refined = refined.with_points(input, &points)?.0;
        }
        Ok(refined)
    }

    /// Barycentric coordinates, in the input face of a refined face, of its three corners.
    pub fn origins_in_face(&self, input: &SurfaceMesh, face: FaceId) -> [[f64; 3]; 3] {
        let corners = input.triangles()[self.face_origin[face]];
        self.mesh.triangles()[face].map(|v| {
            let origin = self.vertex_origin[v];
            let named = input.triangles()[origin.face];
            corners.map(|c| (0..3).filter(|&k| named[k] == c).map(|k| origin.barycentric[k]).sum())
        })
    }

    /// The place of a refined face on the input mesh.
    pub fn frame(&self, input: &SurfaceMesh, face: FaceId) -> FaceFrame {
        FaceFrame { face: self.face_origin[face], corners: self.origins_in_face(input, face) }
    }

    /// A point of a refined face as a point of its input face.
    pub fn on_input(&self, input: &SurfaceMesh, point: SurfacePoint) -> SurfacePoint {
        let rows = self.origins_in_face(input, point.face);
        let weight = |c: usize| (0..3).map(|k| rows[k][c] * point.barycentric[k]).sum();
        SurfacePoint { face: self.face_origin[point.face], barycentric: [weight(0), weight(1), weight(2)] }
    }
}

/// The largest number of rounds of bisections: each one after the first is for vertices whose bisectors a neighbour's has cut.
const BISECTIONS: usize = 4;

/// The points where the bisectors of the widest faces at a vertex meet the opposite edges, as many as the vertex lacks edges for the
/// degree.
fn bisectors(mesh: &SurfaceMesh, v: VertexId, degree: usize) -> Vec<SurfacePoint> {
    let place = |h: HalfedgeId| mesh.positions()[mesh.tail(h)];
    let angle = |h: &HalfedgeId| angle_at(place(*h), place(h.next()), place(h.prev()));
    let mut star: Vec<HalfedgeId> = mesh.star(v).collect();
    let missing = degree.saturating_sub(star.len()).min(star.len());
    star.sort_by(|a, b| angle(b).total_cmp(&angle(a)).then(a.cmp(b)));
    let meets = |h: &HalfedgeId| {
        // The bisector divides the opposite side like the sides beside it.
        let (next, last) = (mesh.length(*h), mesh.length(h.prev()));
        let mut barycentric = [0.0; 3];
        barycentric[h.next().corner()] = last / (next + last);
        barycentric[h.prev().corner()] = next / (next + last);
        SurfacePoint { face: h.face(), barycentric }
    };
    star.iter().take(missing).map(meets).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn a_vertex_of_degree_three_gets_six_and_its_surface_stays() {
        let ball = icosphere(1);
        let inside = SurfacePoint { face: FaceId(17), barycentric: [0.7, 0.2, 0.1] };
        let beside = SurfacePoint { face: FaceId(17), barycentric: [0.2, 1e-4, 0.8 - 1e-4] };
        let (mesh, points) = RefinedMesh::unrefined(&ball).with_points(&ball, &[inside, beside]).unwrap();
        // The second point is in a face beside the first.
        assert_eq!(points.iter().map(|&v| mesh.mesh.star(v).count()).collect::<Vec<_>>(), [4, 3]);
        let refined = mesh.with_degrees(&ball, points.iter().copied(), 6).unwrap();
        assert_eq!(refined.mesh.euler_characteristic(), 2);
        assert!((refined.mesh.area() - 1.0).abs() < 1e-12);
        let scale = 1.0 / ball.area().sqrt();
        for &v in &points {
            assert!(refined.mesh.star(v).count() >= 6);
        }
        for v in refined.mesh.vertices() {
            let there = refined.vertex_origin[v].position(&ball) * scale;
            assert!(there.distance(refined.mesh.positions()[v]) < 1e-12);
        }
        for f in refined.mesh.faces() {
            let corners = refined.origins_in_face(&ball, f);
            assert!(corners.iter().all(|w| (w.iter().sum::<f64>() - 1.0).abs() < 1e-9), "{corners:?}");
        }
    }

    #[test]
    fn few_vertices_become_many_on_the_same_surface() {
        let ball = icosphere(0);
        let refined = RefinedMesh::unrefined(&ball).with_vertices(&ball, 100).unwrap();
        // Each round bisects every edge: 12, 42, 162 vertices.
        assert_eq!((refined.mesh.vertex_count(), refined.mesh.face_count()), (162, 320));
        assert_eq!(refined.mesh.euler_characteristic(), 2);
        assert!((refined.mesh.area() - 1.0).abs() < 1e-12);
        let scale = 1.0 / ball.area().sqrt();
        for v in refined.mesh.vertices() {
            let there = refined.vertex_origin[v].position(&ball) * scale;
            assert!(there.distance(refined.mesh.positions()[v]) < 1e-12);
        }
        let same = refined.with_vertices(&ball, 162).unwrap();
        assert_eq!(same.mesh.triangles(), refined.mesh.triangles());
    }

    #[test]
    fn a_degree_that_is_there_changes_nothing() {
        let ball = icosphere(1);
        let mesh = RefinedMesh::unrefined(&ball);
        let same = mesh.with_degrees(&ball, [VertexId(20), VertexId(30)], 6).unwrap();
        assert_eq!(same.mesh.triangles(), mesh.mesh.triangles());
    }
}

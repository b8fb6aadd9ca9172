//! Nearest points of a surface, many of them, by a bounding volume hierarchy.

use super::closest_point::closest_in_triangle;
use super::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::PointQuery;
use typed_index_collections::{TiVec, ti_vec};

/// A surface that can be asked for its nearest points.
pub struct SurfaceIndex<'a> {
    mesh: &'a SurfaceMesh,
    hierarchy: Bvh,
    normals: TiVec<VertexId, DVec3>,
}

/// A point of a surface, and its distance to the point that was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The point.
    pub point: SurfacePoint,
    /// Its distance.
    pub distance: f64,
}

impl<'a> SurfaceIndex<'a> {
    /// Builds the hierarchy.
    pub fn new(mesh: &'a SurfaceMesh) -> Self {
        let boxes: Vec<_> = mesh.faces().map(|f| bounding_box(&mesh.corners(f))).collect();
        let hierarchy = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { mesh, hierarchy, normals: vertex_normals(mesh) }
    }

    /// The surface.
    pub fn mesh(&self) -> &'a SurfaceMesh {
        self.mesh
    }

    /// The unit normal at a point, between those of its face's corners; zero where these cancel.
    pub fn normal(&self, point: SurfacePoint) -> DVec3 {
        let corners = self.mesh.triangles()[point.face];
        (0..3).map(|k| point.barycentric[k] * self.normals[corners[k]]).sum::<DVec3>().normalize_or_zero()
    }

    /// The nearest point.
    pub fn nearest(&self, p: DVec3) -> Nearest {
        self.search(p, self.in_face(p, FaceId(0)), |_| true)
    }

    /// The nearest point among those whose normal is within a right angle of `normal`, so that a point beside a thin part is not
    /// taken to its other side; the nearest of all where there is none. The search begins in the face `near` and is fast where
    /// that is so.
    pub fn nearest_facing(&self, p: DVec3, normal: DVec3, near: FaceId) -> Nearest {
        let facing = |point: SurfacePoint| self.normal(point).dot(normal) > 0.0;
        let any = || self.search(p, self.in_face(p, near), |_| true);
        self.nearest_where(p, near, facing).unwrap_or_else(any)
    }

    /// The nearest point among those that are allowed; `None` where there is none. The search begins in the face `near` and is fast
    /// where that is so.
    pub fn nearest_where(
        &self,
        p: DVec3,
        near: FaceId,
        allowed: impl Fn(SurfacePoint) -> bool,
    ) -> Option<Nearest> {
        let first = self.in_face(p, near);
        let begin = if allowed(first.point) { first } else { Nearest { distance: f64::MAX, ..first } };
        let found = self.search(p, begin, allowed);
        (found.distance < f64::MAX).then_some(found)
    }

    /// The nearest point of one face.
    fn in_face(&self, p: DVec3, face: FaceId) -> Nearest {
        let point = SurfacePoint { face, barycentric: closest_in_triangle(p, self.mesh.corners(face)) };
        Nearest { point, distance: point.position(self.mesh).distance(p) }
    }

    /// The nearest point that is allowed, or `begin` where none is nearer.
    fn search(&self, p: DVec3, begin: Nearest, allowed: impl Fn(SurfacePoint) -> bool) -> Nearest {
        let place = p.to_array().into();
        let found = self.hierarchy.find_best(
            begin.distance,
            |node, _| node.aabb().distance_to_local_point(place, true),
            |face, _| {
                let found = self.in_face(p, FaceId(face));
                allowed(found.point).then_some((found.distance, found.point))
            },
        );
        found.map_or(begin, |(_, (distance, point))| Nearest { point, distance })
    }
}

/// The least box around points.
pub(crate) fn bounding_box(points: &[DVec3]) -> Aabb {
    let least = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let most = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    Aabb::new(least.to_array().into(), most.to_array().into())
}

/// Unit normals at the vertices: those of the faces around by area.
fn vertex_normals(mesh: &SurfaceMesh) -> TiVec<VertexId, DVec3> {
    let mut normals = ti_vec![DVec3::ZERO; mesh.vertex_count()];
    for f in mesh.faces() {
        let [a, b, c] = mesh.corners(f);
        let normal = (b - a).cross(c - a);
        mesh.triangles()[f].iter().for_each(|&v| normals[v] += normal);
    }
    normals.into_iter().map(DVec3::normalize_or_zero).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;
    use crate::mesh::closest_point::closest_point;
    use crate::mesh::generators::{icosphere, torus};

    #[test]
    fn as_when_every_face_is_looked_at() {
        for mesh in [icosphere(2), torus(12, 7)] {
            let index = SurfaceIndex::new(&mesh);
            let mut random = SplitMix::new(1);
            for _ in 0..200 {
                let p = DVec3::from_array([0; 3].map(|_| 6.0 * random.unit() - 3.0));
                // The nearer one of both answers is the nearest point with any normal.
                let all = [p, -p].map(|normal| closest_point(&mesh, p, normal).position(&mesh).distance(p));
                let found = index.nearest(p);
                assert!((found.distance - all[0].min(all[1])).abs() < 1e-12);
                assert!((found.point.position(&mesh).distance(p) - found.distance).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_thin_sheet_has_two_sides() {
        // A ball pressed to a sheet of thickness 0.002.
        let ball = icosphere(4);
        let flat = ball.positions().iter().map(|p| *p * DVec3::new(1.0, 1.0, 0.001)).collect();
        let sheet = ball.with_positions(flat);
        let index = SurfaceIndex::new(&sheet);
        for k in 0..50 {
            let t = 0.1 * f64::from(k);
            let p = DVec3::new(0.15 * (t - 2.5), 0.1 * (t - 1.0), 0.01);
            for (normal, near) in [(DVec3::Z, 0), (DVec3::NEG_Z, 7), (DVec3::NEG_Z, 2000)] {
                let found = index.nearest_facing(p, normal, FaceId(near));
                let at = found.point.position(&sheet);
                assert!(at.z * normal.z > 0.0, "{at}");
                assert!((at - p).truncate().length() < 1e-3);
            }
        }
    }
}

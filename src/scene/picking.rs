//! The surface point under a ray, by a bounding volume hierarchy, in f64.

use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use glam::DVec3;
use parry3d_f64::query::{PointQueryWithLocation, Ray, RayCast};
use parry3d_f64::shape::TriMesh;

/// A surface that can be picked.
pub struct Picker {
    shape: TriMesh,
}

impl Picker {
    /// Builds the hierarchy; `None` for a mesh without triangles.
    pub fn new(mesh: &SurfaceMesh) -> Option<Self> {
        let vertices = mesh.positions().iter().map(|p| p.to_array().into()).collect();
        let triangles = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        Some(Self { shape: TriMesh::new(vertices, triangles).ok()? })
    }

    /// The first point of the mesh on the ray.
    pub fn pick(&self, mesh: &SurfaceMesh, origin: DVec3, direction: DVec3) -> Option<SurfacePoint> {
        let ray = Ray::new(origin.to_array().into(), direction.to_array().into());
        let hit = self.shape.cast_local_ray_and_get_normal(&ray, f64::MAX, false)?;
        let id = hit.subshape as usize;
        let point = origin + direction * hit.time_of_impact;
        let face = FaceId::from(id);
        Some(SurfacePoint::clamped(face, shares(mesh.corners(face), point)))
    }

    /// The point of the mesh nearest to a point in space.
    pub fn nearest(&self, mesh: &SurfaceMesh, point: DVec3) -> SurfacePoint {
        let (_, (face, _)) = self.shape.project_local_point_and_get_location(point.to_array().into(), false);
        let face = FaceId(face);
        SurfacePoint { face, barycentric: closest_in_triangle(point, mesh.corners(face)) }
    }
}

/// Barycentric coordinates, but for their sum, of the projection of a point to a triangle's plane.
fn shares([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let share = |q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal);
    [share(b, c), share(c, a), share(a, b)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn rays_to_the_centre_meet_the_sphere_where_they_come_from() {
        let sphere = icosphere(3);
        let picker = Picker::new(&sphere).unwrap();
        for k in 0..100 {
            let direction =
                DVec3::new(f64::from(k % 7) - 3.1, f64::from(k % 11) - 5.2, f64::from(k % 5) - 2.3)
                    .normalize();
            let hit = picker.pick(&sphere, direction * 3.0, -direction).unwrap();
            assert!(hit.position(&sphere).normalize().distance(direction) < 1e-9);
            let nearest = picker.nearest(&sphere, hit.position(&sphere) * 1.001);
            assert!(nearest.position(&sphere).distance(hit.position(&sphere)) < 1e-3);
        }
        assert!(picker.pick(&sphere, DVec3::splat(3.0), DVec3::X).is_none());
    }
}

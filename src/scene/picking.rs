//! The surface point under a ray, by bounding volume hierarchies, in f64.
//!
//! A hierarchy of a large mesh takes a while to build, in which nothing else could be done. So the faces are parted, in their own
//! order, and each part has a hierarchy of its own.

use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;
use parry3d_f64::query::{PointQuery, PointQueryWithLocation, Ray, RayCast};
use parry3d_f64::shape::TriMesh;
use rustc_hash::FxHashMap;

/// Number of faces of a part.
const PART: usize = 10_000;
/// The largest number of parts of a mesh that is ready from the beginning.
const FEW_PARTS: usize = 6;

/// A surface that can be picked, once it is ready.
pub struct Picker {
    /// The hierarchies of the parts so far: of [`PART`] faces each, of which the last may have fewer.
    parts: Vec<TriMesh>,
    /// The number of parts of the whole mesh.
    count: usize,
}

impl Picker {
    /// Begins with a mesh; a small one is ready at once. `None` for a mesh without triangles.
    pub fn begun(mesh: &SurfaceMesh) -> Option<Self> {
        let count = mesh.face_count().div_ceil(PART);
        let mut picker = Self { parts: Vec::new(), count };
        while count <= FEW_PARTS && !picker.is_ready() {
            picker.grow(mesh)?;
        }
        (count > 0).then_some(picker)
    }

    /// Whether all parts are there; before that, nothing is picked.
    pub fn is_ready(&self) -> bool {
        self.parts.len() >= self.count
    }

    /// Builds the next part; `None` where the part has nothing that can be picked.
    pub fn grow(&mut self, mesh: &SurfaceMesh) -> Option<()> {
        let first = PART * self.parts.len();
        let faces = mesh.triangles().raw.get(first..(first + PART).min(mesh.face_count()))?;
        let mut places = Vec::new();
        let mut numbers: FxHashMap<VertexId, u32> = FxHashMap::default();
        let mut number = |v: VertexId| {
            *numbers.entry(v).or_insert_with(|| {
                places.push(mesh.positions()[v].to_array().into());
                places.len() as u32 - 1
            })
        };
        let triangles = faces.iter().map(|corners| corners.map(&mut number)).collect();
        self.parts.push(TriMesh::new(places, triangles).ok()?);
        Some(())
    }

    /// The first point of the mesh on the ray.
    pub fn pick(&self, mesh: &SurfaceMesh, origin: DVec3, direction: DVec3) -> Option<SurfacePoint> {
        let ray = Ray::new(origin.to_array().into(), direction.to_array().into());
        let hit = |(part, shape): (usize, &TriMesh)| {
            let hit = shape.cast_local_ray_and_get_normal(&ray, f64::MAX, false)?;
            Some((hit.time_of_impact, FaceId::from(PART * part + hit.subshape as usize)))
        };
        let hits = self.ready_parts()?.iter().enumerate().filter_map(hit);
        let (time, face) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(SurfacePoint::clamped(face, shares(mesh.corners(face), origin + direction * time)))
    }

    /// The point of the mesh nearest to a point in space.
    pub fn nearest(&self, mesh: &SurfaceMesh, point: DVec3) -> Option<SurfacePoint> {
        let nearest = |(part, shape): (usize, &TriMesh)| {
            let (found, (face, _)) =
                shape.project_local_point_and_get_location(point.to_array().into(), false);
            let place: [f64; 3] = found.point.into();
            (DVec3::from_array(place).distance_squared(point), FaceId::from(PART * part + face as usize))
        };
        let all = self.ready_parts()?.iter().enumerate().map(nearest);
        let (_, face) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(SurfacePoint { face, barycentric: closest_in_triangle(point, mesh.corners(face)) })
    }

    /// The point of the mesh nearest to a point in space, among those of the faces that look within a right angle of a direction; among
    /// all where no face does.
    pub fn nearest_facing(&self, mesh: &SurfaceMesh, point: DVec3, direction: DVec3) -> Option<SurfacePoint> {
        let place = point.to_array().into();
        let on_face = |face: FaceId| {
            let corners = mesh.corners(face);
            let [a, b, c] = corners;
            let barycentric = closest_in_triangle(point, corners);
            let found = SurfacePoint { face, barycentric };
            let facing = (b - a).cross(c - a).dot(direction) > 0.0;
            facing.then(|| (found.position(mesh).distance(point), found))
        };
        let mut best: Option<(f64, SurfacePoint)> = None;
        for (part, shape) in self.ready_parts()?.iter().enumerate() {
            let found = shape.bvh().find_best(
                best.map_or(f64::MAX, |best| best.0),
                |node, _| node.aabb().distance_to_local_point(place, true),
                |face, _| on_face(FaceId::from(PART * part + face as usize)),
            );
            best = found.map(|found| found.1).or(best);
        }
        best.map(|best| best.1).or_else(|| self.nearest(mesh, point))
    }

    fn ready_parts(&self) -> Option<&[TriMesh]> {
        self.is_ready().then_some(&self.parts)
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
        let picker = Picker::begun(&sphere).unwrap();
        for k in 0..100 {
            let direction =
                DVec3::new(f64::from(k % 7) - 3.1, f64::from(k % 11) - 5.2, f64::from(k % 5) - 2.3)
                    .normalize();
            let hit = picker.pick(&sphere, direction * 3.0, -direction).unwrap();
            assert!(hit.position(&sphere).normalize().distance(direction) < 1e-9);
            let nearest = picker.nearest(&sphere, hit.position(&sphere) * 1.001).unwrap();
            assert!(nearest.position(&sphere).distance(hit.position(&sphere)) < 1e-3);
        }
        assert!(picker.pick(&sphere, DVec3::splat(3.0), DVec3::X).is_none());
    }

    #[test]
    fn of_a_thin_sheet_the_nearest_point_lies_on_the_side_that_is_asked_for() {
        let ball = icosphere(4);
        let flat = ball.positions().iter().map(|p| *p * DVec3::new(1.0, 1.0, 0.001)).collect();
        let sheet = ball.with_positions(flat);
        let picker = Picker::begun(&sheet).unwrap();
        for k in 0..50 {
            let t = 0.1 * f64::from(k);
            let p = DVec3::new(0.15 * (t - 2.5), 0.1 * (t - 1.0), 0.01);
            for side in [DVec3::Z, DVec3::NEG_Z] {
                let at = picker.nearest_facing(&sheet, p, side).unwrap().position(&sheet);
                assert!(at.z * side.z > 0.0 && (at - p).truncate().length() < 1e-3, "{at}");
            }
            // No face looks nowhere.
            let any = picker.nearest_facing(&sheet, p, DVec3::ZERO).unwrap();
            assert_eq!(Some(any), picker.nearest(&sheet, p));
        }
    }

    #[test]
    fn a_large_surface_is_picked_when_its_last_part_is_there_and_then_like_a_small_one() {
        let sphere = icosphere(6);
        assert!(sphere.face_count() > FEW_PARTS * PART && !sphere.face_count().is_multiple_of(PART));
        let mut picker = Picker::begun(&sphere).unwrap();
        let ways = || {
            (0..40).map(|k| {
                DVec3::new(f64::from(k % 7) - 3.1, f64::from(k % 11) - 5.2, f64::from(k % 5) - 2.3)
                    .normalize()
            })
        };
        while !picker.is_ready() {
            assert!(picker.pick(&sphere, DVec3::X * 3.0, DVec3::NEG_X).is_none());
            assert!(picker.nearest(&sphere, DVec3::X).is_none());
            picker.grow(&sphere).unwrap();
        }
        assert_eq!(picker.parts.len(), picker.count);
        for way in ways() {
            let hit = picker.pick(&sphere, way * 3.0, -way).unwrap().position(&sphere);
            assert!(hit.normalize().distance(way) < 1e-9 && hit.dot(way) > 0.99);
            let nearest = picker.nearest(&sphere, way * 2.0).unwrap().position(&sphere);
            assert!(nearest.distance(way) < 0.05);
        }
    }
}

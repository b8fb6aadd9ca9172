//! A finished map asked at single places: its triangles are drawn on both surfaces, and on each the map is affine.

use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh_side::MeshSide;
use glam::DVec3;
use parry3d_f64::query::{PointQueryWithLocation, Ray, RayCast};
use parry3d_f64::shape::TriMesh;

/// A map as one triangulation with places on both meshes.
pub struct MapPicker {
    positions: [Vec<DVec3>; 2],
    triangles: Vec<[u32; 3]>,
    /// A hierarchy over each mesh, made when it is first needed.
    shapes: [Option<TriMesh>; 2],
}

/// A place of one mesh with its partner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapPlace {
    /// The place on the source and on the target, in input coordinates.
    pub positions: [DVec3; 2],
    /// The points at the corners of the map's triangle that holds it.
    pub corners: [u32; 3],
    /// The weights of these points: a value of the map's points has its weighted mean at the place.
    pub weights: [f64; 3],
}

impl MapPicker {
    /// Takes a map: places on the source and on the target of each point, and triangles of points.
    /// `None` where the numbers do not fit each other.
    pub fn new(positions: [Vec<DVec3>; 2], triangles: Vec<[u32; 3]>) -> Option<Self> {
        let count = positions[0].len();
        let fits = positions[1].len() == count && triangles.iter().flatten().all(|&v| (v as usize) < count);
        fits.then_some(Self { positions, triangles, shapes: [None, None] })
    }

    /// The place where a ray first meets one mesh.
    pub fn under_ray(&mut self, side: MeshSide, origin: DVec3, direction: DVec3) -> Option<MapPlace> {
        let ray = Ray::new(origin.to_array().into(), direction.to_array().into());
        let hit = self.shape(side)?.cast_local_ray_and_get_normal(&ray, f64::MAX, false)?;
        let point = origin + direction * hit.time_of_impact;
        let triangle = *self.triangles.get(hit.subshape as usize)?;
        let weights = closest_in_triangle(point, self.corners(side, triangle));
        Some(self.place(triangle, weights))
    }

    /// The place nearest to a point, on one mesh.
    pub fn nearest(&mut self, side: MeshSide, point: DVec3) -> Option<MapPlace> {
        let (_, (triangle, _)) =
            self.shape(side)?.project_local_point_and_get_location(point.to_array().into(), false);
        let triangle = *self.triangles.get(triangle as usize)?;
        let weights = closest_in_triangle(point, self.corners(side, triangle));
        Some(self.place(triangle, weights))
    }

    fn shape(&mut self, side: MeshSide) -> Option<&TriMesh> {
        let shape = &mut self.shapes[side];
        if shape.is_none() {
            let vertices = self.positions[side].iter().map(|p| p.to_array().into()).collect();
            *shape = TriMesh::new(vertices, self.triangles.clone()).ok();
        }
        shape.as_ref()
    }

    fn corners(&self, side: MeshSide, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|v| self.positions[side][v as usize])
    }

    fn place(&self, triangle: [u32; 3], weights: [f64; 3]) -> MapPlace {
        let blend = |[a, b, c]: [DVec3; 3]| a * weights[0] + b * weights[1] + c * weights[2];
        MapPlace {
            positions: MeshSide::BOTH.map(|side| blend(self.corners(side, triangle))),
            corners: triangle,
            weights,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    fn stretch(p: DVec3) -> DVec3 {
        DVec3::new(2.0 * p.x, 0.5 * p.y, p.z + 3.0)
    }

    /// The unit ball mapped affinely to an ellipsoid elsewhere.
    fn picker() -> MapPicker {
        let ball = icosphere(3);
        let source = ball.positions().raw.to_vec();
        let target = source.iter().map(|p| stretch(*p)).collect();
        let triangles = ball.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        MapPicker::new([source, target], triangles).unwrap()
    }

    #[test]
    fn a_place_and_its_image_belong_together_from_both_sides() {
        let mut picker = picker();
        for k in 0..50 {
            let way = DVec3::new(f64::from(k % 7) - 3.1, f64::from(k % 11) - 5.2, f64::from(k % 5) - 2.3);
            let place = picker.under_ray(MeshSide::Source, way.normalize() * 4.0, -way.normalize()).unwrap();
            let [on_source, on_target] = place.positions;
            assert!(on_source.normalize().distance(way.normalize()) < 1e-9);
            assert!(on_target.distance(stretch(on_source)) < 1e-12);
            let blend: DVec3 =
                (0..3).map(|k| picker.positions[0][place.corners[k] as usize] * place.weights[k]).sum();
            assert!(blend.distance(on_source) < 1e-12);
            let back = picker.nearest(MeshSide::Target, on_target).unwrap();
            assert!(back.positions[0].distance(on_source) < 1e-9);
        }
        assert!(picker.under_ray(MeshSide::Source, DVec3::splat(3.0), DVec3::X).is_none());
    }

    #[test]
    fn numbers_that_do_not_fit_are_refused() {
        let points = || vec![DVec3::ZERO; 3];
        assert!(MapPicker::new([points(), points()], vec![[0, 1, 2]]).is_some());
        assert!(MapPicker::new([points(), points()], vec![[0, 1, 3]]).is_none());
        assert!(MapPicker::new([points(), Vec::new()], Vec::new()).is_none());
    }
}

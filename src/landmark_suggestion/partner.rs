//! The partner of a point across the mirror plane, as left and right are.

use crate::math::mirror_plane::MirrorPlane;
use crate::mesh::{SurfaceMesh, SurfacePoint};
use glam::DVec3;

/// A point within this distance of the plane, in units of the root of the area, lies on the midline: clicks are no more exact. Chosen by
/// hand.
const MIDLINE: f64 = 0.01;

/// The partner of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// The point lies on the midline and is its own partner.
    Itself,
    /// Another point.
    Across {
        /// The point of the surface nearest to the reflected point.
        point: SurfacePoint,
        /// The distance between both, in units of the root of the area.
        distance: f64,
    },
}

/// The partner of a point. `nearest` gives the point of the surface nearest to a place, of those that face a direction where there
/// are some: so the partner of a point outside on an ear does not lie inside the other ear. `None` where `nearest` gives none.
pub fn partner(
    mesh: &SurfaceMesh,
    plane: MirrorPlane,
    point: SurfacePoint,
    nearest: impl FnOnce(DVec3, DVec3) -> Option<SurfacePoint>,
) -> Option<Partner> {
    let size = mesh.area().sqrt();
    let place = point.position(mesh);
    if plane.height(place).abs() <= MIDLINE * size {
        return Some(Partner::Itself);
    }
    let [a, b, c] = mesh.corners(point.face);
    let image = plane.reflected(place);
    let point = nearest(image, plane.turned((b - a).cross(c - a)))?;
    Some(Partner::Across { point, distance: point.position(mesh).distance(image) / size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FaceId;
    use crate::mesh::generators::icosphere;
    use crate::mesh::surface_index::SurfaceIndex;

    /// The partner of a point of a ball flattened to an ellipsoid, which mirrors itself in x.
    fn on_egg(point: SurfacePoint) -> (SurfaceMesh, Partner) {
        let ball = icosphere(3);
        let egg =
            ball.with_positions(ball.positions().iter().map(|p| *p * DVec3::new(1.5, 1.0, 0.7)).collect());
        let plane = MirrorPlane::across(DVec3::X, DVec3::ZERO).unwrap();
        let index = SurfaceIndex::new(&egg);
        let nearest = |place, normal| Some(index.nearest_facing(place, normal, FaceId(0)).point);
        let found = partner(&egg, plane, point, nearest).unwrap();
        (egg, found)
    }

    #[test]
    fn partners_name_each_other_and_the_midline_itself() {
        let mut middle = 0;
        for face in (0..1280).step_by(7).map(FaceId) {
            let point = SurfacePoint { face, barycentric: [0.2, 0.5, 0.3] };
            let (egg, found) = on_egg(point);
            let (place, limit) = (point.position(&egg), MIDLINE * egg.area().sqrt());
            let Partner::Across { point: other, distance } = found else {
                assert!(place.x.abs() <= limit);
                middle += 1;
                continue;
            };
            assert!(place.x.abs() > limit && distance < 1e-12);
            assert!(other.position(&egg).distance(place * DVec3::new(-1.0, 1.0, 1.0)) < 1e-12);
            let (_, back) = on_egg(other);
            let Partner::Across { point: back, .. } = back else { panic!("{back:?}") };
            assert!(back.position(&egg).distance(place) < 1e-12);
        }
        assert!(middle > 0);
    }

    #[test]
    fn where_nothing_is_across_there_is_none() {
        let ball = icosphere(1);
        let plane = MirrorPlane::across(DVec3::X, DVec3::ZERO).unwrap();
        let point = SurfacePoint { face: FaceId(0), barycentric: [1.0, 0.0, 0.0] };
        let at = ball.corners(FaceId(0))[0];
        assert!(at.x.abs() > 0.1);
        assert_eq!(partner(&ball, plane, point, |_, _| None), None);
    }
}

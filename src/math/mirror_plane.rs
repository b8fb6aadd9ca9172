//! Planes that mirror points in space.

use glam::DVec3;

/// A plane: the points whose product with the unit normal is the offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirrorPlane {
    normal: DVec3,
    offset: f64,
}

impl MirrorPlane {
    /// The plane through a point across a direction; `None` where the direction has no length.
    pub fn across(direction: DVec3, through: DVec3) -> Option<Self> {
        let normal = direction.try_normalize()?;
        Some(Self { normal, offset: normal.dot(through) })
    }

    /// The plane that mirrors two points into each other; `None` where they are one.
    pub fn between([a, b]: [DVec3; 2]) -> Option<Self> {
        Self::across(b - a, 0.5 * (a + b))
    }

    /// The unit normal.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The signed distance of a point, positive where the normal points to.
    pub fn height(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }

    /// The mirror image of a point.
    pub fn reflected(&self, p: DVec3) -> DVec3 {
        p - 2.0 * self.height(p) * self.normal
    }

    /// The mirror image of a direction.
    pub fn turned(&self, direction: DVec3) -> DVec3 {
        direction - 2.0 * self.normal.dot(direction) * self.normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    fn points() -> impl Iterator<Item = DVec3> {
        let mut random = SplitMix::new(3);
        std::iter::repeat_with(move || DVec3::from_array([0; 3].map(|_| 8.0 * random.unit() - 4.0))).take(60)
    }

    #[test]
    fn to_reflect_twice_gives_the_point_back() {
        let plane = MirrorPlane::across(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.3, 4.0, -1.0)).unwrap();
        for p in points() {
            let image = plane.reflected(p);
            assert!(plane.reflected(image).distance(p) < 1e-13);
            assert!((plane.height(p) + plane.height(image)).abs() < 1e-13);
            // The middle lies in the plane, and the way there is across it.
            assert!(plane.height(0.5 * (p + image)).abs() < 1e-13);
            assert!((image - p).cross(plane.normal()).length() < 1e-12);
            assert!(plane.turned(p - image).distance(image - p) < 1e-12);
        }
    }

    #[test]
    fn the_plane_between_two_points_exchanges_them() {
        let all: Vec<DVec3> = points().collect();
        for pair in all.windows(2) {
            let plane = MirrorPlane::between([pair[0], pair[1]]).unwrap();
            assert!(plane.reflected(pair[0]).distance(pair[1]) < 1e-13);
        }
        assert_eq!(MirrorPlane::between([all[0], all[0]]), None);
        assert_eq!(MirrorPlane::across(DVec3::ZERO, all[0]), None);
    }
}

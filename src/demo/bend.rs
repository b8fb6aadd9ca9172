//! A bend of space. The map from a body to the bent body is known at every point, whatever triangles both are cut into.

use super::shape::Shape;
use crate::math::scalar::{cos, sin};
use glam::DVec3;

/// Bends space around an upright axis, so that the x axis becomes an arc of a circle. It keeps heights, and lengths along the x axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    /// The distance of that axis from the origin, along z. Lengths nearer to the axis shrink.
    pub radius: f64,
}

impl Bend {
    /// The image of a place under the bend.
    pub fn place(&self, p: DVec3) -> DVec3 {
        let angle = p.x / self.radius;
        let reach = self.radius - p.z;
        DVec3::new(reach * sin(angle), p.y, self.radius - reach * cos(angle))
    }

    /// A shape, bent with its points.
    pub fn shape(&self, Shape { mesh, points }: Shape) -> Shape {
        let places = mesh.positions().iter().map(|&p| self.place(p)).collect();
        let points = points.into_iter().map(|(name, p)| (name, self.place(p))).collect();
        Shape { mesh: mesh.with_positions(places), points }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_keeps_its_lengths_and_no_place_is_turned_over() {
        let bend = Bend { radius: 1.5 };
        let at = |x: f64, y: f64, z: f64| bend.place(DVec3::new(x, y, z));
        let h = 1e-6;
        for x in [-1.0, -0.2, 0.0, 0.7, 1.4] {
            for z in [-0.3, 0.0, 0.3] {
                let along = (at(x + h, 0.4, z) - at(x - h, 0.4, z)) / (2.0 * h);
                let up = (at(x, 0.4 + h, z) - at(x, 0.4 - h, z)) / (2.0 * h);
                let across = (at(x, 0.4, z + h) - at(x, 0.4, z - h)) / (2.0 * h);
                assert!((along.length() - (1.0 - z / 1.5)).abs() < 1e-8);
                assert!((across.length() - 1.0).abs() < 1e-8 && (up - DVec3::Y).length() < 1e-8);
                assert!((along.cross(up).dot(across) - along.length()).abs() < 1e-8);
            }
        }
    }
}

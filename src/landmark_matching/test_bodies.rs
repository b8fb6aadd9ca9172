//! Bodies for tests: balls with ends.

use super::options::MatchOptions;
use super::shape::{Body, Shape};
use crate::math::scalar::exp;
use crate::mesh::SurfaceMesh;
use crate::mesh::generators::icosphere;
use crate::monitor::Silent;
use glam::DVec3;

/// A ball of radius 1 with an end in each direction, as much higher than the ball as is said beside it; the larger `sharpness`, the
/// thinner. Its vertices have the numbers of `icosphere(4)`.
pub(super) fn ball_with_ends(ends: &[(DVec3, f64)], sharpness: f64) -> SurfaceMesh {
    let ball = icosphere(4);
    let end =
        |p: DVec3, (at, height): &(DVec3, f64)| height * exp(-sharpness * p.distance_squared(at.normalize()));
    let height = |p: DVec3| 1.0 + ends.iter().map(|e| end(p, e)).sum::<f64>();
    ball.with_positions(ball.positions().iter().map(|&p| height(p) * p).collect())
}

/// The ends of [`four_footed`]: two fore feet, two hind ones, which are nearer to each other, a head before and above them, and a tail
/// behind; the left feet come first.
pub(super) const ENDS: [DVec3; 6] = [
    DVec3::new(0.7, 0.6, -0.6),
    DVec3::new(0.7, -0.6, -0.6),
    DVec3::new(-0.6, 0.4, -0.8),
    DVec3::new(-0.6, -0.4, -0.8),
    DVec3::new(0.9, 0.0, 0.6),
    DVec3::new(-1.0, 0.0, 0.2),
];

/// A ball with a limb at each of [`ENDS`], symmetric about the plane y = 0.
pub(super) fn four_footed() -> SurfaceMesh {
    ball_with_ends(&ENDS.map(|end| (end, 2.0)), 30.0)
}

/// A body without given landmarks; every vertex may be one.
pub(super) fn shape(mesh: &SurfaceMesh) -> Shape {
    let body = Body { mesh, given: &[], may_mark: None };
    Shape::new(body, &MatchOptions::default(), &mut Silent).unwrap()
}

//! Bodies for tests: balls with ends.

use crate::math::scalar::exp;
use crate::mesh::SurfaceMesh;
use crate::mesh::generators::icosphere;
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

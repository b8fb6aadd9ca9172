//! The point of a surface nearest to a point in space.

use super::{FaceId, SurfaceMesh, SurfacePoint};
use crate::math::barycentric::interpolated;
use crate::math::segment::nearest_share;
use glam::DVec3;

/// The point of the mesh nearest to `p`, among the faces whose normal is within a right angle of `normal`; where there is
/// none, among all faces. Every face is looked at: for a handful of points.
pub fn closest_point(mesh: &SurfaceMesh, p: DVec3, normal: DVec3) -> SurfacePoint {
    let mut best = [(f64::INFINITY, SurfacePoint { face: FaceId(0), barycentric: [1.0, 0.0, 0.0] }); 2];
    for face in mesh.faces() {
        let [a, b, c] = mesh.corners(face);
        let barycentric = closest_in_triangle(p, [a, b, c]);
        let distance = p.distance_squared(interpolated([a, b, c], barycentric));
        let turned = (b - a).cross(c - a).dot(normal) <= 0.0;
        let slot = &mut best[usize::from(turned)];
        if distance < slot.0 {
            *slot = (distance, SurfacePoint { face, barycentric });
        }
    }
    let [same, turned] = best;
    if same.0.is_finite() { same.1 } else { turned.1 }
}

/// Barycentric coordinates of the point of a triangle nearest to `p`.
pub(crate) fn closest_in_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let area = normal.length_squared();
    if area > 0.0 {
        let weight = |q: DVec3, r: DVec3| (r - q).cross(p - q).dot(normal) / area;
        let inside = [weight(b, c), weight(c, a), weight(a, b)];
        if inside.iter().all(|w| *w >= 0.0) {
            return inside;
        }
    }
    let on_side = |k: usize, [q, r]: [DVec3; 2]| {
        let share = nearest_share(p, [q, r]);
        let mut barycentric = [0.0; 3];
        barycentric[k] = 1.0 - share;
        barycentric[(k + 1) % 3] = share;
        (p.distance_squared(q.lerp(r, share)), barycentric)
    };
    let sides = [on_side(0, [a, b]), on_side(1, [b, c]), on_side(2, [c, a])];
    sides.into_iter().min_by(|x, y| x.0.total_cmp(&y.0)).map_or([1.0, 0.0, 0.0], |nearest| nearest.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::VertexId;
    use crate::mesh::generators::icosphere;

    #[test]
    fn the_nearest_point_of_a_ball_lies_under_the_point() {
        let ball = icosphere(3);
        for k in 0..37 {
            let out = ball.positions()[VertexId(17 * k)];
            let found = closest_point(&ball, out * 1.7, out).position(&ball);
            assert!(found.distance(out) < 1e-12);
            // The far side of the ball is all that faces the other way.
            assert!(closest_point(&ball, out * 1.7, -out).position(&ball).dot(out) < 0.3);
        }
    }

    #[test]
    fn no_point_of_the_surface_is_nearer() {
        let ball = icosphere(1);
        for k in 0..20 {
            let t = f64::from(k);
            let p = DVec3::new(0.3 * t - 2.0, 1.0 - 0.13 * t, 0.07 * t * t - 1.0);
            let nearest = ball.faces().flat_map(|f| {
                let [a, b, c] = ball.corners(f);
                (0..=20).flat_map(move |i| {
                    (0..=20 - i).map(move |j| {
                        (a * f64::from(i) + b * f64::from(j) + c * f64::from(20 - i - j)) / 20.0
                    })
                })
            });
            let sampled = nearest.map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            let normal = p;
            let found = closest_point(&ball, p, normal).position(&ball).distance(p);
            assert!(found <= sampled + 1e-12 && found > sampled - 0.1, "{found} {sampled}");
        }
    }
}

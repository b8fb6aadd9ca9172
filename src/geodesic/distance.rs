//! Geodesic distances of all vertices to the nearest of some seeds.

use super::front::Front;
use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::{TiVec, ti_vec};

/// The distance of every vertex to the nearest of `seeds`, in the mesh's unit; infinite without seeds.
pub fn distances(mesh: &SurfaceMesh, seeds: &[VertexId]) -> TiVec<VertexId, f64> {
    distances_within(mesh, seeds, f64::INFINITY)
}

/// The distances up to a radius (mesh's unit); a vertex beyond it has some distance above the radius, or an infinite one.
pub fn distances_within(mesh: &SurfaceMesh, seeds: &[VertexId], radius: f64) -> TiVec<VertexId, f64> {
    let mut distance = ti_vec![f64::INFINITY; mesh.vertex_count()];
    Front::new(mesh, |h| mesh.length(h), seeds, &mut distance).advance(radius);
    distance
}

/// Adds seeds to distances that this module has found on the same mesh: they fall to the distances to the nearest of all seeds.
pub fn shorten(mesh: &SurfaceMesh, seeds: &[VertexId], distance: &mut TiVec<VertexId, f64>) {
    Front::new(mesh, |h| mesh.length(h), seeds, distance).advance(f64::INFINITY);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scalar::acos;
    use crate::mesh::generators::icosphere;

    #[test]
    fn distances_on_a_ball_are_angles() {
        let ball = icosphere(4);
        let seed = VertexId(7);
        let pole = ball.positions()[seed];
        let found = distances(&ball, &[seed]);
        for v in ball.vertices() {
            let angle = acos(ball.positions()[v].dot(pole).clamp(-1.0, 1.0));
            assert!((found[v] - angle).abs() < 0.02 * angle + 1e-12, "{} {angle}", found[v]);
        }
    }

    #[test]
    fn within_a_radius_distances_are_the_same() {
        let ball = icosphere(4);
        let seed = VertexId(7);
        let (all, near) = (distances(&ball, &[seed]), distances_within(&ball, &[seed], 0.5));
        assert!(all.iter().zip(&near).all(|(a, n)| if *a <= 0.5 { a == n } else { *n > 0.5 }));
        assert!(near.iter().any(|n| n.is_infinite()));
    }

    #[test]
    fn more_seeds_are_the_minimum() {
        let ball = icosphere(3);
        let [a, b] = [VertexId(3), VertexId(400)];
        let both = distances(&ball, &[a, b]);
        let (to_a, to_b) = (distances(&ball, &[a]), distances(&ball, &[b]));
        for v in ball.vertices() {
            assert!(both[v] <= to_a[v].min(to_b[v]) + 1e-12);
            assert!(both[v] >= 0.97 * to_a[v].min(to_b[v]));
        }
    }
}

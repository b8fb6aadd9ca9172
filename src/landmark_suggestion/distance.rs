//! Approximate geodesic distances: a front over vertices that crosses triangles.
//!
//! A vertex takes its distance from a neighbour along the edge, or from the far side of a triangle as if the front were a
//! circle about a point in the triangle's plane (Novotni & Klein 2002, section 3). Exact in the plane as long as the front
//! has gone through no obtuse corner; a few per cent too long at most.

use crate::mesh::{SurfaceMesh, VertexId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use typed_index_collections::{TiVec, ti_vec};

/// The distance of every vertex to the nearest of `seeds`, in the mesh's unit; infinite without seeds.
pub fn distances(mesh: &SurfaceMesh, seeds: &[VertexId]) -> TiVec<VertexId, f64> {
    distances_within(mesh, seeds, f64::INFINITY)
}

/// The same up to a radius; what lies beyond has a distance above it, or an infinite one.
pub fn distances_within(mesh: &SurfaceMesh, seeds: &[VertexId], radius: f64) -> TiVec<VertexId, f64> {
    let mut distance = ti_vec![f64::INFINITY; mesh.vertex_count()];
    spread(mesh, (seeds, radius), &mut distance);
    distance
}

/// Lowers distances to what they are with more seeds.
pub fn shorten(mesh: &SurfaceMesh, seeds: &[VertexId], distance: &mut TiVec<VertexId, f64>) {
    spread(mesh, (seeds, f64::INFINITY), distance);
}

fn spread(mesh: &SurfaceMesh, (seeds, radius): (&[VertexId], f64), distance: &mut TiVec<VertexId, f64>) {
    let mut queue = BinaryHeap::new();
    for &v in seeds {
        distance[v] = 0.0;
        // Positive floats order like their bits.
        queue.push((Reverse(0_u64), v));
    }
    while let Some((Reverse(bits), v)) = queue.pop() {
        let here = f64::from_bits(bits);
        if here > radius {
            break;
        }
        if here > distance[v] {
            continue;
        }
        let mut offer = |w: VertexId, through: f64, distance: &mut TiVec<VertexId, f64>| {
            if through < distance[w] {
                distance[w] = through;
                queue.push((Reverse(through.to_bits()), w));
            }
        };
        for h in mesh.star(v) {
            let (b, c) = (mesh.head(h), mesh.tail(h.prev()));
            let lengths = [mesh.length(h), mesh.length(h.next()), mesh.length(h.prev())];
            offer(b, here + lengths[0], distance);
            // Through the sides of the face that end in v.
            let onto_c = through_edge([here, distance[b]], lengths);
            offer(c, onto_c, distance);
            let onto_b = through_edge([here, distance[c]], [lengths[2], lengths[1], lengths[0]]);
            offer(b, onto_b, distance);
            // And through the far side, where v has just become known.
            let twin = mesh.twin(h.next());
            let far = mesh.tail(twin.prev());
            // `twin` runs from c to b.
            let sides = [mesh.length(twin), mesh.length(twin.prev()), mesh.length(twin.next())];
            offer(far, through_edge([distance[b], distance[c]], sides), distance);
        }
    }
}

/// The distance of the corner r of a triangle p q r behind the edge p q, from the distances of p and q; `lengths` are
/// those of p q, q r and r p. Infinite where the straight line does not cross the edge.
fn through_edge([at_p, at_q]: [f64; 2], [pq, qr, rp]: [f64; 3]) -> f64 {
    if !at_q.is_finite() || !at_p.is_finite() || pq <= 0.0 {
        return f64::INFINITY;
    }
    // p = 0, q = (pq, 0), r above, the source below.
    let x_r = (pq * pq + rp * rp - qr * qr) / (2.0 * pq);
    let y_r = (rp * rp - x_r * x_r).max(0.0).sqrt();
    let x_s = (pq * pq + at_p * at_p - at_q * at_q) / (2.0 * pq);
    let below = at_p * at_p - x_s * x_s;
    if below < 0.0 || y_r <= 0.0 {
        return f64::INFINITY;
    }
    let y_s = below.sqrt();
    let crossing = x_s + (x_r - x_s) * y_s / (y_s + y_r);
    if !(0.0..=pq).contains(&crossing) {
        return f64::INFINITY;
    }
    ((x_r - x_s) * (x_r - x_s) + (y_r + y_s) * (y_r + y_s)).sqrt()
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

//! Which parts of a surface lie in hollows and which on ridges: a cheap stand-in for how much light from around reaches them.
//!
//! A vertex whose neighbours lie above its tangent plane is in a hollow. The mean slope to the neighbours is spread over the
//! surface in rounds, so that creases as wide as a few per cent of the body are seen and not only those of single edges.

use crate::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;
use typed_index_collections::{TiVec, ti_vec};

/// The number of rounds of spreading for a mesh of [`FEW`] vertices; finer meshes get more, in proportion to the root of their vertices.
/// Chosen by hand.
const ROUNDS: f64 = 6.0;
/// The number of vertices for which [`ROUNDS`] was chosen.
const FEW: f64 = 5000.0;
/// The largest number of rounds of spreading. Chosen by hand.
const MOST_ROUNDS: f64 = 24.0;

/// The factor by which the spread slopes are multiplied: an armpit comes near 1. Chosen by hand.
const STRENGTH: f64 = 3.0;

/// The largest number of rounds in which points between vertices get values; what has none after them keeps none.
const MOST_ROUNDS_BETWEEN: usize = 40;

/// The degree to which each vertex lies in a hollow: from -1 on sharp ridges to 1 in deep hollows, 0 where the surface is flat.
pub fn hollows(mesh: &SurfaceMesh, normals: &TiVec<VertexId, DVec3>) -> TiVec<VertexId, f64> {
    let count = mesh.vertex_count();
    let mut degrees: TiVec<VertexId, f64> = ti_vec![0.0; count];
    let mut slopes: TiVec<VertexId, f64> = ti_vec![0.0; count];
    for [a, b] in sides(mesh) {
        let way = (mesh.positions()[b] - mesh.positions()[a]).normalize_or_zero();
        slopes[a] += way.dot(normals[a]);
        degrees[a] += 1.0;
    }
    slopes.iter_mut().zip(&degrees).for_each(|(slope, degree)| *slope /= degree.max(1.0));
    // The rounds' mean is a wide blur with a sharp middle.
    let rounds = (ROUNDS * (count as f64 / FEW).sqrt()).clamp(ROUNDS, MOST_ROUNDS) as usize;
    let mut sum = slopes.clone();
    for _ in 0..rounds {
        let mut spread: TiVec<VertexId, f64> = ti_vec![0.0; count];
        for [a, b] in sides(mesh) {
            spread[a] += slopes[b];
        }
        for v in mesh.vertices() {
            slopes[v] = 0.3 * slopes[v] + 0.7 * spread[v] / degrees[v].max(1.0);
            sum[v] += slopes[v];
        }
    }
    sum.into_iter().map(|x| (STRENGTH * x / (rounds + 1) as f64).clamp(-1.0, 1.0)).collect()
}

/// Carries values to a finer triangulation of the same surface: its points that are vertices of the mesh have the values of `known`, and
/// those between them, on edges and in faces, the means of their neighbours.
pub fn carried(known: &[Option<f32>], triangles: &[u32]) -> Vec<f32> {
    let mut values = known.to_vec();
    // Points that lie between are few edges away from a vertex; in a long thin face at most some dozens.
    for _ in 0..MOST_ROUNDS_BETWEEN {
        let mut sums = vec![(0.0_f32, 0_u32); known.len()];
        for corners in triangles.chunks_exact(3) {
            let corners = [corners[0], corners[1], corners[2]].map(|v| v as usize);
            for k in 0..3 {
                let (v, next, last) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
                for value in [values[next], values[last]].into_iter().flatten().filter(|_| known[v].is_none())
                {
                    sums[v].0 += value;
                    sums[v].1 += 1;
                }
            }
        }
        let mut is_complete = true;
        for (value, (sum, count)) in values.iter_mut().zip(sums) {
            if count > 0 {
                is_complete &= value.is_some();
                *value = Some(sum / count as f32);
            }
        }
        if is_complete {
            break;
        }
    }
    values.into_iter().map(|value| value.unwrap_or(0.0)).collect()
}

/// Every edge twice, once from each end.
fn sides(mesh: &SurfaceMesh) -> impl Iterator<Item = [VertexId; 2]> + '_ {
    // The surface is closed: the neighbour of the edge's face has it the other way.
    mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::normals::vertex_normals;

    #[test]
    fn a_dimple_is_a_hollow_and_a_ball_is_none() {
        let ball = icosphere(4);
        let of = |mesh: &SurfaceMesh| hollows(mesh, &vertex_normals(mesh));
        assert!(of(&ball).iter().all(|h| (-0.4..0.0).contains(h)));
        // A pit with a rounded bottom.
        let dimple = |p: &DVec3| *p * (1.0 - 0.5 * (1.0 - (1.0 - p.z) / 0.2).max(0.0));
        let dented = ball.with_positions(ball.positions().iter().map(dimple).collect());
        let found = of(&dented);
        let bottom =
            ball.vertices().max_by(|a, b| ball.positions()[*a].z.total_cmp(&ball.positions()[*b].z)).unwrap();
        assert!(found[bottom] > 0.05, "{}", found[bottom]);
    }

    #[test]
    fn points_between_take_the_means_of_their_neighbours() {
        // A fan around point 4 of the square 0 to 3, and a point 5 without a value around it.
        let triangles = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 4, 5, 6];
        let known = [Some(1.0), Some(0.0), Some(1.0), Some(0.0), None, None, None];
        let found = carried(&known, &triangles);
        assert_eq!(found[..4], [1.0, 0.0, 1.0, 0.0]);
        assert!((found[4] - 0.5).abs() < 0.1 && (found[5] - 0.5).abs() < 0.2, "{found:?}");
        assert_eq!(carried(&[None; 3], &[0, 1, 2]), [0.0; 3]);
    }
}

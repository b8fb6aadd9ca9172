//! Tips: ends of limbs.

use super::distance::{distances, shorten};
use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::{TiVec, ti_vec};

/// Points from which the mean distance is measured.
const SAMPLES: usize = 32;

/// Ends of limbs, the most remote first: vertices whose mean geodesic distance to the whole surface is the largest within
/// `radius` around them, and larger than the surface's mean.
///
/// The mean over the surface is that over farthest points (Hilaga et al. 2001 call it the integral geodesic distance).
pub fn tips(mesh: &SurfaceMesh, radius: f64) -> Vec<VertexId> {
    let remoteness = remoteness(mesh);
    let mean = remoteness.iter().sum::<f64>() / remoteness.len() as f64;
    let mut order: Vec<VertexId> = mesh.vertices().filter(|&v| remoteness[v] > mean).collect();
    order.sort_by(|a, b| remoteness[*b].total_cmp(&remoteness[*a]).then(a.cmp(b)));
    let mut covered: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    let mut tips = Vec::new();
    for v in order {
        let highest = mesh.star(v).all(|h| remoteness[mesh.head(h)] <= remoteness[v]);
        if highest && covered[v] > radius {
            tips.push(v);
        }
        if highest {
            shorten(mesh, &[v], &mut covered);
        }
    }
    tips
}

/// Mean distance of every vertex to points spread over the surface.
fn remoteness(mesh: &SurfaceMesh) -> TiVec<VertexId, f64> {
    let mut sum: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
    let mut nearest: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    let mut sample = VertexId(0);
    for _ in 0..SAMPLES {
        let field = distances(mesh, &[sample]);
        for v in mesh.vertices() {
            sum[v] += field[v] / SAMPLES as f64;
            nearest[v] = nearest[v].min(field[v]);
        }
        let farthest = mesh.vertices().max_by(|a, b| nearest[*a].total_cmp(&nearest[*b]));
        sample = farthest.unwrap_or(sample);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use glam::DVec3;

    /// A ball with five arms.
    #[test]
    fn the_ends_of_all_arms_of_a_star_are_found_and_nothing_else() {
        let arms = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z];
        let ball = icosphere(4);
        let arm = |p: &DVec3| {
            let along = arms.iter().map(|a| a.dot(*p)).fold(0.0, f64::max);
            *p * (1.0 + 2.0 * crate::math::scalar::pow(along, 12.0))
        };
        let star = ball.with_positions(ball.positions().iter().map(arm).collect());
        let found = tips(&star, 0.5);
        assert_eq!(found.len(), arms.len());
        for a in arms {
            assert!(found.iter().any(|&v| star.positions()[v].distance(a * 3.0) < 0.2), "{a}");
        }
    }
}

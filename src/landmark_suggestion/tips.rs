//! Tips: ends of limbs.

use crate::geodesic::{distances, shorten};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::{TiVec, ti_vec};

/// Points to which the mean distance is measured; each costs one search over the mesh. Chosen by hand.
const SAMPLES: usize = 32;

/// Ends of limbs, the most remote first: vertices whose mean geodesic distance to the whole surface is the largest within
/// `radius` around them, and larger than the surface's mean.
///
/// The mean over the surface is approximated by that over farthest points (Hilaga et al. 2001 call it the integral geodesic distance).
/// `radius` is in the mesh's unit.
///
/// # Errors
/// [`Cancelled`].
pub fn tips(mesh: &SurfaceMesh, radius: f64, monitor: &mut dyn Monitor) -> Result<Vec<VertexId>, Cancelled> {
    let remoteness = remoteness(mesh, monitor)?;
    let mean = remoteness.iter().sum::<f64>() / remoteness.len() as f64;
    let mut order: Vec<VertexId> = mesh.vertices().filter(|&v| remoteness[v] > mean).collect();
    order.sort_by(|a, b| remoteness[*b].total_cmp(&remoteness[*a]).then(a.cmp(b)));
    let mut covered: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    let mut tips = Vec::new();
    let candidates = order.len() as f64;
    for (k, v) in order.into_iter().enumerate() {
        let highest = mesh.star(v).all(|h| remoteness[mesh.head(h)] <= remoteness[v]);
        if highest && covered[v] > radius {
            tips.push(v);
        }
        if highest {
            let fraction = 0.5 + 0.5 * k as f64 / candidates;
            monitor.step(Step { fraction, residual: None })?;
            shorten(mesh, &[v], &mut covered);
        }
    }
    Ok(tips)
}

/// Mean distance of every vertex to points spread over the surface, in the mesh's unit.
fn remoteness(mesh: &SurfaceMesh, monitor: &mut dyn Monitor) -> Result<TiVec<VertexId, f64>, Cancelled> {
    let mut sum: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
    let mut nearest: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    let mut sample = VertexId(0);
    for k in 0..SAMPLES {
        monitor.step(Step { fraction: 0.5 * k as f64 / SAMPLES as f64, residual: None })?;
        let field = distances(mesh, &[sample]);
        for v in mesh.vertices() {
            sum[v] += field[v] / SAMPLES as f64;
            nearest[v] = nearest[v].min(field[v]);
        }
        let farthest = mesh.vertices().max_by(|a, b| nearest[*a].total_cmp(&nearest[*b]));
        sample = farthest.unwrap_or(sample);
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
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
        let found = tips(&star, 0.5, &mut Silent).unwrap();
        assert_eq!(found.len(), arms.len());
        for a in arms {
            assert!(found.iter().any(|&v| star.positions()[v].distance(a * 3.0) < 0.2), "{a}");
        }
    }
}

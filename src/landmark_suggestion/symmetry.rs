//! Partners under a symmetry of the surface, as left and right are.
//!
//! The quantiles, over the area, of the distances from a point to the surface do not change under a symmetry of the surface. So two
//! points whose quantiles agree, each nearest to the other, are taken for partners. Distances alone cannot tell which is left.

use crate::geodesic::distances;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};

/// Quantiles by which points are compared. Chosen by hand.
const QUANTILES: usize = 32;

/// Partners' quantiles differ by less than this share of their mean: above the error of distances, below what tells a hand from a
/// foot. Chosen by hand.
const ALIKE: f64 = 0.03;

/// For each point the number of its partner under a symmetry, where there is one; partners name each other.
///
/// # Errors
/// [`Cancelled`].
pub fn partners(
    mesh: &SurfaceMesh,
    points: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<Vec<Option<usize>>, Cancelled> {
    let areas = mesh.vertex_areas().raw;
    let mut by_point: Vec<[f64; QUANTILES]> = Vec::with_capacity(points.len());
    for &v in points {
        monitor.step(Step { fraction: by_point.len() as f64 / points.len() as f64, residual: None })?;
        by_point.push(quantiles(mesh, &areas, v));
    }
    let nearest = |i: usize| {
        let others = (0..points.len()).filter(|&j| j != i);
        let misfits = others.map(|j| (misfit(&by_point[i], &by_point[j]), j));
        misfits.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|best| best.0 < ALIKE).map(|best| best.1)
    };
    let nearest: Vec<Option<usize>> = (0..points.len()).map(nearest).collect();
    Ok((0..points.len()).map(|i| nearest[i].filter(|&j| nearest[j] == Some(i))).collect())
}

/// The quantiles of the distances from a vertex to the surface, by area.
fn quantiles(mesh: &SurfaceMesh, areas: &[f64], v: VertexId) -> [f64; QUANTILES] {
    let field = distances(mesh, &[v]);
    let mut order: Vec<usize> = (0..areas.len()).collect();
    order.sort_by(|&a, &b| field.raw[a].total_cmp(&field.raw[b]));
    let share = areas.iter().sum::<f64>() / QUANTILES as f64;
    let (mut quantiles, mut next, mut within) = ([0.0; QUANTILES], 0, 0.0);
    for w in order {
        within += areas[w];
        while next < QUANTILES && within > (next as f64 + 0.5) * share {
            quantiles[next] = field.raw[w];
            next += 1;
        }
    }
    quantiles
}

/// The mean difference of two points' quantiles, relative to their mean.
fn misfit(a: &[f64; QUANTILES], b: &[f64; QUANTILES]) -> f64 {
    let difference: f64 = a.iter().zip(b).map(|(x, y)| (x - y).abs()).sum();
    2.0 * difference / (a.iter().sum::<f64>() + b.iter().sum::<f64>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmark_suggestion::tips;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use glam::DVec3;

    /// A ball with two equal arms and two of other lengths.
    #[test]
    fn equal_arms_are_partners_and_others_are_not() {
        let arms = [(DVec3::X, 2.0), (DVec3::NEG_X, 2.0), (DVec3::Y, 1.0), (DVec3::NEG_Y, 3.0)];
        let ball = icosphere(4);
        let arm = |p: &DVec3| {
            let grown = |(a, l): &(DVec3, f64)| l * crate::math::scalar::pow(a.dot(*p).max(0.0), 12.0);
            *p * (1.0 + arms.iter().map(grown).sum::<f64>())
        };
        let star = ball.with_positions(ball.positions().iter().map(arm).collect());
        let ends = tips(&star, 0.5, &mut Silent).unwrap();
        assert_eq!(ends.len(), arms.len());
        let found = partners(&star, &ends, &mut Silent).unwrap();
        for (i, partner) in found.iter().enumerate() {
            let p = star.positions()[ends[i]];
            match partner {
                Some(j) => {
                    let q = star.positions()[ends[*j]];
                    assert!(p.distance(q * DVec3::new(-1.0, 1.0, 1.0)) < 0.2, "{p} {q}");
                    assert_eq!(found[*j], Some(i));
                }
                None => assert!(p.x.abs() < 0.5, "{p} has no partner"),
            }
        }
    }
}

//! Farthest point sampling: each point is the vertex farthest from all before it.

use crate::geodesic::shorten;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::TiVec;

/// Number and least distance of farthest points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Number of points, at most.
    pub count: usize,
    /// Least distance of each point from all others, in the mesh's unit.
    pub least_distance: f64,
}

/// Chooses farthest points: each is the vertex farthest from all before it and from the seeds of `distance` (in the mesh's unit), of
/// those vertices for which `may` holds. There are fewer than wanted where every such vertex is too near.
///
/// # Errors
/// [`Cancelled`].
pub fn farthest_points(
    mesh: &SurfaceMesh,
    mut distance: TiVec<VertexId, f64>,
    wanted: Spread,
    may: impl Fn(VertexId) -> bool,
    monitor: &mut dyn Monitor,
) -> Result<Vec<VertexId>, Cancelled> {
    let Spread { count, least_distance } = wanted;
    let mut chosen = Vec::new();
    while chosen.len() < count {
        monitor.step(Step { fraction: chosen.len() as f64 / count as f64, residual: None })?;
        let allowed = mesh.vertices().filter(|&v| may(v) && distance[v].is_finite());
        let Some(v) = allowed.max_by(|a, b| distance[*a].total_cmp(&distance[*b])) else { break };
        // On a surface whose area is too small for a number, the least distance is 0.
        if distance[v] < least_distance || distance[v] == 0.0 {
            break;
        }
        chosen.push(v);
        shorten(mesh, &[v], &mut distance);
    }
    Ok(chosen)
}

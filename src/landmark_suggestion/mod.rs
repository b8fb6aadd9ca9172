//! Points of one mesh that are worth a landmark.

mod distance;

pub use distance::{distances, shorten};

use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// Farthest points: `count` vertices, each the farthest from all before it and from what `distance` measures from; `may`
/// says which vertices are allowed. Fewer where every allowed vertex is nearer than `least`.
pub fn farthest_points(
    mesh: &SurfaceMesh,
    mut distance: TiVec<VertexId, f64>,
    (count, least): (usize, f64),
    may: impl Fn(VertexId) -> bool,
) -> Vec<VertexId> {
    let mut chosen = Vec::with_capacity(count);
    while chosen.len() < count {
        let allowed = mesh.vertices().filter(|&v| may(v) && distance[v].is_finite());
        let Some(v) = allowed.max_by(|a, b| distance[*a].total_cmp(&distance[*b])) else { break };
        if distance[v] < least {
            break;
        }
        chosen.push(v);
        shorten(mesh, &[v], &mut distance);
    }
    chosen
}

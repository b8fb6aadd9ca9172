//! Points of one mesh that are worth a landmark: ends of limbs, and points far from all others.

mod distance;
mod tips;

pub use distance::{distances, shorten};
pub use tips::tips;

use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// Why a point is suggested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The end of a limb.
    Tip,
    /// Far from all landmarks and suggestions before it.
    Far,
}

/// A point that is worth a landmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Suggestion {
    /// Where.
    pub vertex: VertexId,
    /// Why.
    pub reason: Reason,
}

/// At most `count` vertices that are worth a landmark beside those that there are, the best first: tips, the most remote
/// first, then farthest points. All are farther from each other and from `landmarks` than a tenth of the root of the area.
pub fn suggest(mesh: &SurfaceMesh, landmarks: &[VertexId], count: usize) -> Vec<Suggestion> {
    let least = 0.1 * mesh.area().sqrt();
    let mut distance = distances(mesh, landmarks);
    let mut found = Vec::with_capacity(count);
    for vertex in tips(mesh, least) {
        if found.len() < count && distance[vertex] > least {
            found.push(Suggestion { vertex, reason: Reason::Tip });
            shorten(mesh, &[vertex], &mut distance);
        }
    }
    let nothing_known = landmarks.is_empty() && found.is_empty();
    if nothing_known && count > 0 {
        // A ball: any point is as good as another.
        found.push(Suggestion { vertex: VertexId(0), reason: Reason::Far });
        shorten(mesh, &[VertexId(0)], &mut distance);
    }
    let rest = farthest_points(mesh, distance, (count - found.len(), least), |_| true);
    found.extend(rest.into_iter().map(|vertex| Suggestion { vertex, reason: Reason::Far }));
    found
}

/// Farthest points: at most `count` vertices, each the farthest from all before it and from what `distance` measures from;
/// `may` says which vertices are allowed. Fewer where every allowed vertex is nearer than `least`.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn suggestions_are_apart_from_each_other_and_from_the_landmarks() {
        let ball = icosphere(3);
        let least = 0.1 * ball.area().sqrt();
        for landmarks in [vec![], vec![VertexId(5), VertexId(300)]] {
            let found = suggest(&ball, &landmarks, 12);
            assert_eq!(found.len(), 12);
            let all: Vec<VertexId> =
                landmarks.iter().copied().chain(found.iter().map(|s| s.vertex)).collect();
            for (k, &v) in all.iter().enumerate() {
                let field = distances(&ball, &[v]);
                assert!(all.iter().skip(k.max(landmarks.len()) + 1).all(|&w| field[w] >= 0.97 * least));
            }
        }
        assert!(suggest(&ball, &[], 0).is_empty());
    }
}

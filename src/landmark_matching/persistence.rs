//! Peaks of a function on a mesh with their persistence: how far one must descend from a peak to reach a higher one.

use crate::math::disjoint_sets::DisjointSets;
use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::TiSlice;

/// A peak of a function on a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Peak {
    pub(super) vertex: VertexId,
    /// Its height above the highest pass to a higher peak; for the highest peak the range of the function.
    pub(super) persistence: f64,
}

/// All peaks with at least the persistence `least`, the most persistent first (superlevel sets, as in Edelsbrunner, Letscher &
/// Zomorodian 2002).
pub(super) fn peaks(mesh: &SurfaceMesh, height: &TiSlice<VertexId, f64>, least: f64) -> Vec<Peak> {
    let mut order: Vec<VertexId> = mesh.vertices().collect();
    order.sort_by(|a, b| height[*b].total_cmp(&height[*a]).then(a.cmp(b)));
    let mut sets = DisjointSets::new(mesh.vertex_count());
    let mut is_in = vec![false; mesh.vertex_count()];
    // The highest vertex of each set, by the set's root.
    let mut top: Vec<VertexId> = mesh.vertices().collect();
    let is_higher = |a: VertexId, b: VertexId| height[a].total_cmp(&height[b]).then(b.cmp(&a)).is_gt();
    let mut found = Vec::new();
    for &v in &order {
        is_in[v.index()] = true;
        for w in mesh.star(v).map(|h| mesh.head(h)).filter(|w| is_in[w.index()]) {
            let [a, b] = [v, w].map(|x| sets.root(x.index()));
            if a == b {
                continue;
            }
            let (higher, lower) = if is_higher(top[a], top[b]) { (top[a], top[b]) } else { (top[b], top[a]) };
            found.push(Peak { vertex: lower, persistence: height[lower] - height[v] });
            sets.join(a, b);
            top[sets.root(a)] = higher;
        }
    }
    if let (Some(&first), Some(&last)) = (order.first(), order.last()) {
        found.push(Peak { vertex: first, persistence: height[first] - height[last] });
    }
    found.retain(|peak| peak.persistence >= least);
    found.sort_by(|a, b| b.persistence.total_cmp(&a.persistence).then(a.vertex.cmp(&b.vertex)));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use glam::DVec3;
    use typed_index_collections::TiVec;

    #[test]
    fn two_hills_have_the_depth_of_the_pass_between_them() {
        let ball = icosphere(4);
        let hill = |p: &DVec3, at: DVec3, height: f64| height * (1.0 - p.distance(at)).max(0.0);
        let height: TiVec<VertexId, f64> =
            ball.positions().iter().map(|p| hill(p, DVec3::X, 2.0).max(hill(p, DVec3::Z, 1.0))).collect();
        let found = peaks(&ball, &height, 0.05);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(ball.positions()[found[0].vertex].distance(DVec3::X) < 0.1);
        assert!(ball.positions()[found[1].vertex].distance(DVec3::Z) < 0.1);
        assert!((found[0].persistence - height[found[0].vertex]).abs() < 1e-12);
        // Halfway between the hills, sqrt(2) apart, the lower one is still 1 - sqrt(2) / 2 high, the higher one too.
        assert!((found[1].persistence - 0.65).abs() < 0.12, "{found:?}");
    }
}

//! The rims of the caps that close the holes of a mesh.

use super::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::math::disjoint_sets::DisjointSets;
use std::collections::BTreeMap;

/// A cap with its rim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rim {
    /// The faces of the cap, in order.
    pub cap: Vec<FaceId>,
    /// The vertices of the rim, in order of their numbers.
    pub vertices: Vec<VertexId>,
    /// Length of the edges between the cap and the skin.
    pub length: f64,
}

/// The rims of all caps, the longest first. Faces that share an edge are one cap.
pub fn rims(mesh: &SurfaceMesh, is_cap: impl Fn(FaceId) -> bool) -> Vec<Rim> {
    let mut sets = DisjointSets::new(mesh.face_count());
    let neighbour = |h: HalfedgeId| mesh.twin(h).face();
    for h in mesh.edges().filter(|&h| is_cap(h.face()) && is_cap(neighbour(h))) {
        sets.join(h.face().index(), neighbour(h).index());
    }
    let mut rims: BTreeMap<usize, Rim> = BTreeMap::new();
    for f in mesh.faces().filter(|&f| is_cap(f)) {
        let rim = rims.entry(sets.root(f.index())).or_default();
        rim.cap.push(f);
        for h in f.halfedges().into_iter().filter(|&h| !is_cap(neighbour(h))) {
            rim.vertices.extend([mesh.tail(h), mesh.head(h)]);
            rim.length += mesh.length(h);
        }
    }
    let mut rims: Vec<Rim> = rims.into_values().collect();
    for rim in &mut rims {
        rim.vertices.sort_unstable();
        rim.vertices.dedup();
    }
    rims.sort_by(|a, b| b.length.total_cmp(&a.length).then_with(|| a.cap.cmp(&b.cap)));
    rims
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn each_cap_has_its_rim_the_longest_first() {
        let ball = icosphere(4);
        let height = |f: FaceId| ball.corners(f).iter().sum::<glam::DVec3>().z / 3.0;
        let found = rims(&ball, |f| height(f) > 0.9 || height(f) < -0.7);
        assert_eq!(found.len(), 2);
        for (rim, height) in found.iter().zip([-0.7, 0.9]) {
            // A jagged circle.
            let round = std::f64::consts::TAU * f64::sqrt(1.0 - height * height);
            assert!(rim.length > 0.95 * round && rim.length < 1.5 * round, "{} {round}", rim.length);
            assert!(rim.vertices.iter().all(|&v| (ball.positions()[v].z - height).abs() < 0.08));
            let area: f64 = rim.cap.iter().map(|&f| ball.face_area(f)).sum();
            let expected = std::f64::consts::TAU * (1.0 - height.abs());
            assert!((area / expected - 1.0).abs() < 0.1, "{area} {expected}");
        }
        assert_eq!(rims(&ball, |_| false), []);
    }
}

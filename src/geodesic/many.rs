//! Distances from many places of one mesh.

use super::front::Front;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use typed_index_collections::{TiVec, ti_vec};

/// A mesh with the lengths of its halfedges: a front asks for each many times.
pub struct ManyDistances<'a> {
    mesh: &'a SurfaceMesh,
    lengths: TiVec<HalfedgeId, f64>,
}

impl<'a> ManyDistances<'a> {
    /// Measures the edges of a mesh.
    pub fn on(mesh: &'a SurfaceMesh) -> Self {
        Self { mesh, lengths: mesh.halfedges().map(|h| mesh.length(h)).collect() }
    }

    /// The distance of every vertex to a seed, in the mesh's unit, as by [`super::distances`].
    pub fn to(&self, seed: VertexId) -> TiVec<VertexId, f64> {
        let mut distance = ti_vec![f64::INFINITY; self.mesh.vertex_count()];
        Front::new(self.mesh, |h| self.lengths[h], &[seed], &mut distance).advance(f64::INFINITY);
        distance
    }
}

#[cfg(test)]
mod tests {
    use super::super::distances;
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn one_by_one_they_are_the_same() {
        let ball = icosphere(3);
        let many = ManyDistances::on(&ball);
        for seed in [0, 7, 300].map(VertexId) {
            assert_eq!(many.to(seed), distances(&ball, &[seed]));
        }
    }
}

//! The neighbours of all vertices in one array, for searches that visit the same stars many times.

use super::{SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// The neighbours of each vertex, one vertex's after the other's. Going around a star from twin to twin waits for memory at each halfedge;
/// these lie side by side.
pub struct Neighbours {
    heads: Vec<VertexId>,
    /// Where those of each vertex begin and end in `heads`.
    ranges: TiVec<VertexId, [u32; 2]>,
}

impl Neighbours {
    /// Those of all vertices of a mesh, counter-clockwise as in [`SurfaceMesh::star`].
    #[must_use]
    pub fn new(mesh: &SurfaceMesh) -> Self {
        let mut heads = Vec::with_capacity(mesh.halfedges().len());
        let range = |v: VertexId| {
            let start = heads.len() as u32;
            heads.extend(mesh.star(v).map(|h| mesh.head(h)));
            [start, heads.len() as u32]
        };
        let ranges = mesh.vertices().map(range).collect();
        Self { heads, ranges }
    }

    /// Those of a vertex.
    #[inline]
    #[must_use]
    pub fn of(&self, v: VertexId) -> &[VertexId] {
        let [start, end] = self.ranges[v];
        &self.heads[start as usize..end as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn they_are_the_heads_of_the_stars() {
        let mesh = icosphere(2);
        let neighbours = Neighbours::new(&mesh);
        for v in mesh.vertices() {
            let star: Vec<VertexId> = mesh.star(v).map(|h| mesh.head(h)).collect();
            assert_eq!(neighbours.of(v), star);
        }
    }
}

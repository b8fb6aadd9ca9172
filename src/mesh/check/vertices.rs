//! The vertices that triangles use: their numbers, and whether each is of one part of the surface.

use super::edges::EdgeTable;
use super::fault::{Elements, MeshFault};
use super::triangulated::Triangle;
use crate::math::disjoint_sets::DisjointSets;
use crate::mesh::VertexId;
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;
use typed_index_collections::TiVec;

/// The vertex of each vertex of the file, `None` where no triangle has it, and the vertices' positions.
pub(super) fn used_vertices(
    soup: &PolygonSoup,
    triangles: &[Triangle],
) -> (Vec<Option<VertexId>>, TiVec<VertexId, DVec3>) {
    let mut used = vec![false; soup.positions.len()];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut positions = TiVec::new();
    let number = |(used, p): (bool, &DVec3)| used.then(|| positions.push_and_get_key(*p));
    let mut from_file: Vec<Option<VertexId>> = used.into_iter().zip(&soup.positions).map(number).collect();
    for (vertex, first) in soup.joined_with.iter().enumerate().take(soup.positions.len()) {
        from_file[vertex] = from_file.get(*first as usize).copied().flatten();
    }
    (from_file, positions)
}

/// Every vertex has one fan: its corners are connected through edges at the vertex.
pub(super) fn check_fans(
    triangles: &[Triangle],
    edges: &EdgeTable,
    vertices: usize,
) -> Result<(), MeshFault> {
    // Halfedges belong to the triangles as they were before turning: a corner is named by its vertex instead.
    let corners = triangles.len() * 3;
    let mut sets = DisjointSets::new(corners);
    let corner = |t: usize, v: u32| 3 * t + triangles[t].iter().position(|&w| w == v).unwrap_or(0);
    for (ends, halfedges) in edges.ends.iter().zip(&edges.halfedges) {
        for &v in ends {
            let [a, b] = halfedges.map(|s| corner(s as usize / 3, v));
            sets.join(a, b);
        }
    }
    let mut fans = vec![0_u32; vertices];
    for c in (0..corners).filter(|&c| sets.root(c) == c) {
        fans[triangles[c / 3][c % 3] as usize] += 1;
    }
    let faults: Elements<usize> = (0..vertices).filter(|&v| fans[v] > 1).collect();
    if faults.count > 0 { Err(MeshFault::PinchedVertices(faults)) } else { Ok(()) }
}

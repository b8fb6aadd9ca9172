//! The rims of holes.

use super::super::draft::{DraftFace, Edge};
use crate::mesh::check::{Elements, MeshFault};
use rustc_hash::FxHashMap;

/// The vertices of each hole's rim, the way its cap runs around it: against the faces beside it. The loops begin with their least
/// vertex and are in the order of these.
///
/// # Errors
/// [`MeshFault::PinchedVertices`] where open edges are no simple loops.
pub(super) fn loops(faces: &[DraftFace], edges: &[Edge]) -> Result<Vec<Vec<u32>>, MeshFault> {
    let mut next: FxHashMap<u32, u32> = FxHashMap::default();
    let mut starts = Vec::new();
    let mut crossed: Vec<usize> = Vec::new();
    for edge in edges {
        if let [h] = edge.halfedges[..] {
            let [a, b] = faces[h as usize / 3].edge(h as usize % 3);
            starts.push(b);
            crossed.extend(next.insert(b, a).map(|_| b as usize));
        }
    }
    if !crossed.is_empty() {
        return Err(MeshFault::PinchedVertices(crossed.into_iter().collect()));
    }
    starts.sort_unstable();
    let mut found = Vec::new();
    for start in starts {
        let mut rim = Vec::new();
        let mut v = start;
        while let Some(after) = next.remove(&v) {
            rim.push(v);
            v = after;
        }
        if v != start {
            return Err(MeshFault::PinchedVertices(Elements { count: 1, first: vec![v as usize] }));
        }
        if !rim.is_empty() {
            found.push(rim);
        }
    }
    Ok(found)
}

//! Triangles that agree with their neighbours, and face outwards.

use super::edges::EdgeTable;
use super::fault::MeshFault;
use super::triangulated::Triangle;
use crate::mesh::FaceId;
use crate::mesh::soup::PolygonSoup;
use typed_index_collections::TiVec;

/// Turns triangles so that neighbours agree; returns which were turned. Halfedge numbers stay those of the table.
pub(super) fn orient(
    triangles: &mut [Triangle],
    edges: &EdgeTable,
) -> Result<TiVec<FaceId, bool>, MeshFault> {
    let original = triangles.to_vec();
    let start_of = |h: usize| original[h / 3][h % 3];
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut stack = Vec::new();
    for root in 0..triangles.len() {
        if turned[root].is_some() {
            continue;
        }
        turned[root] = Some(false);
        stack.push(root);
        while let Some(t) = stack.pop() {
            for h in 3 * t..3 * t + 3 {
                let other = edges.across(h);
                // Agreeing neighbours run along their edge in opposite directions.
                let opposed = start_of(h) == start_of(other);
                let wanted = turned[t].map(|x| x != opposed);
                match turned[other / 3] {
                    None => {
                        turned[other / 3] = wanted;
                        stack.push(other / 3);
                    }
                    found if found != wanted => {
                        let edge = edges.ends[edges.edge_of[h] as usize].map(|v| v as usize);
                        return Err(MeshFault::NotOrientable { edge });
                    }
                    _ => {}
                }
            }
        }
    }
    let turned: TiVec<FaceId, bool> = turned.into_iter().map(|x| x == Some(true)).collect();
    for (triangle, _) in triangles.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
        triangle.swap(1, 2);
    }
    Ok(turned)
}

/// Six times the volume inside, negative where triangles face inwards.
pub(super) fn signed_volume(soup: &PolygonSoup, triangles: &[Triangle]) -> f64 {
    let origin = soup.positions[triangles[0][0] as usize];
    let volume = |t: &Triangle| {
        let [p, q, r] = t.map(|v| soup.positions[v as usize] - origin);
        p.dot(q.cross(r))
    };
    triangles.iter().map(volume).sum()
}

//! Holes that are punched into meshes.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::geodesic::distances;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// Marks the faces nearest to a vertex as removed until they have the given share of the area.
pub fn remove_around(mesh: &SurfaceMesh, centre: VertexId, share: f64, removed: &mut TiVec<FaceId, bool>) {
    let far = distances(mesh, &[centre]);
    let farthest = |f: FaceId| mesh.triangles()[f].iter().map(|&v| far[v]).fold(0.0, f64::max);
    let mut order: Vec<FaceId> = mesh.faces().collect();
    order.sort_by(|&a, &b| farthest(a).total_cmp(&farthest(b)));
    let mut left = share * mesh.area();
    for f in order {
        left -= mesh.face_area(f);
        if left < 0.0 {
            break;
        }
        removed[f] = true;
    }
}

//! Normals of the surface at the vertices.

use super::{SurfaceMesh, VertexId};
use glam::DVec3;
use typed_index_collections::TiVec;

/// Smooth unit normals, weighted by area.
pub fn vertex_normals(mesh: &SurfaceMesh) -> TiVec<VertexId, DVec3> {
    let mut normals: TiVec<VertexId, DVec3> = mesh.vertices().map(|_| DVec3::ZERO).collect();
    for (f, corners) in mesh.triangles().iter_enumerated() {
        let [p, q, r] = mesh.corners(f);
        let normal = (q - p).cross(r - p);
        corners.iter().for_each(|&v| normals[v] += normal);
    }
    normals.iter().map(|n| n.normalize_or(DVec3::Z)).collect()
}

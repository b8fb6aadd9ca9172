//! Tests of geodesic distances on meshes on which the search for them once did not end.

use crate::common;
use crate::data::HANG;
use crate::distance_bounds::check_bounds;
use conemap::geodesic::{distances, shorten};
use conemap::mesh::VertexId;
use std::path::Path;

tests![distances_end_on_meshes_that_once_hung];

/// Checks meshes on which the search did not end, since rounding lowered the distances of its front again and again.
fn distances_end_on_meshes_that_once_hung(data: &Path) {
    for name in HANG {
        let mesh = common::read_mesh(&data.join(name));
        for k in 0..8 {
            check_bounds(&mesh, VertexId::from(k * mesh.vertex_count() / 8), name);
        }
        let mut nearest = distances(&mesh, &[VertexId(0)]);
        for v in mesh.vertices().step_by(100) {
            let before = nearest.clone();
            shorten(&mesh, &[v], &mut nearest);
            assert!(nearest[v] == 0.0 && nearest.iter().zip(&before).all(|(now, before)| now <= before));
        }
    }
}

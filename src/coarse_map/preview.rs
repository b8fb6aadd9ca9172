//! Previews of a coarse map before it is refined.
//!
//! The vertices of the present level have exact images. Every other vertex of the full mesh is projected onto the level, and its image
//! is interpolated from those of its face's corners there: near enough to show a pattern, for one search each.

use super::multilevel::{CoarseMap, PlacedLevel};
use crate::landmarks::MeshSide;
use crate::mesh::normals::vertex_normals;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, VertexId};
use crate::monitor::MapPreview;
use glam::DVec3;

impl MapPreview for CoarseMap<'_> {
    /// The image of each vertex of the full mesh with its landmarks on the other mesh, which is scaled to area 1.
    fn images(&self, of: MeshSide) -> Option<Vec<DVec3>> {
        let PlacedLevel { level, images, full, onto } = self.placed(of)?;
        let index = SurfaceIndex::new(&level.mesh);
        let normals = vertex_normals(full);
        let unit = 1.0 / onto.area().sqrt();
        let mut near = FaceId(0);
        let place = |v: VertexId| {
            let place: DVec3 = if let Ok(known) = level.vertices.binary_search(&v) {
                images[known]
            } else {
                let point = index.nearest_facing(full.positions()[v], normals[v], near).point;
                near = point.face;
                let corners = level.mesh.triangles()[point.face];
                (0..3).map(|k| point.barycentric[k] * images[corners[k]]).sum()
            };
            place * unit
        };
        Some(full.vertices().map(place).collect())
    }
}

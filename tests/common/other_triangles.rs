//! Surfaces cut into other triangles, as they come from other programs: drawn out along an axis, or cut into slivers by planes as
//! sections of a solid are.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::remesh::{Options, remesh};
use glam::DVec3;
use std::collections::HashMap;
use typed_index_collections::TiVec;

/// The surface remeshed to this many triangles, `factor` times as long along the body's longest axis as across it.
pub fn drawn_out(mesh: &SurfaceMesh, faces: usize, factor: f64) -> SurfaceMesh {
    let extent = extent(mesh);
    let mut stretch = DVec3::ONE;
    stretch[extent.max_position()] = factor;
    let scaled = |mesh: &SurfaceMesh, by: DVec3| {
        mesh.with_positions(mesh.positions().iter().map(|&p| p * by).collect())
    };
    let pressed = scaled(mesh, stretch.recip());
    scaled(&remesh(&pressed, &Options::to_faces(faces), &mut Silent).expect("a new mesh").mesh, stretch)
}

/// The same surface, its triangles cut by planes across the three axes that lie `spacing` apart: many of them become slivers.
pub fn cut_by_planes(mesh: &SurfaceMesh, spacing: f64) -> SurfaceMesh {
    let (least, extent) = (least_corner(mesh), extent(mesh));
    let mut cut = mesh.clone();
    for axis in 0..3 {
        // Not through the least corner, where bodies often have vertices.
        let mut at = least[axis] + 0.37 * spacing;
        while at < least[axis] + extent[axis] {
            cut = cut_by_plane(&cut, axis, at, 1e-6 * spacing);
            at += spacing;
        }
    }
    cut
}

/// The surface with its triangles cut where they cross a plane; vertices nearer to it than `on_plane` count as on it.
fn cut_by_plane(mesh: &SurfaceMesh, axis: usize, at: f64, on_plane: f64) -> SurfaceMesh {
    let height = |v: VertexId| mesh.positions()[v][axis] - at;
    let mut positions: TiVec<VertexId, DVec3> = mesh.positions().iter().copied().collect();
    let mut middles: HashMap<HalfedgeId, VertexId> = HashMap::new();
    for h in mesh.edges() {
        let (below, above) = (height(mesh.tail(h)), height(mesh.head(h)));
        if (below < 0.0) != (above < 0.0) && below.abs().min(above.abs()) > on_plane {
            let middle =
                mesh.positions()[mesh.tail(h)].lerp(mesh.positions()[mesh.head(h)], below / (below - above));
            middles.insert(h, positions.push_and_get_key(middle));
        }
    }
    let mut faces = Vec::with_capacity(mesh.face_count() + 2 * middles.len());
    for (f, &corners) in mesh.triangles().iter_enumerated() {
        let middle = |k: usize| {
            let h = HalfedgeId::of(f, k);
            middles.get(&h.min(mesh.twin(h))).copied()
        };
        cut_face(corners, [0, 1, 2].map(middle), &mut faces);
    }
    let faces = faces.into_iter().collect::<TiVec<FaceId, _>>();
    SurfaceMesh::from_triangles(positions, faces).expect("a cut mesh is closed and manifold")
}

/// The parts of a triangle of whose edges up to two are cut, edge k from corner k to the next.
fn cut_face([a, b, c]: [VertexId; 3], middles: [Option<VertexId>; 3], faces: &mut Vec<[VertexId; 3]>) {
    match middles {
        [None, None, None] => faces.push([a, b, c]),
        [Some(m), None, None] => faces.extend([[a, m, c], [m, b, c]]),
        [Some(m), None, Some(n)] => faces.extend([[a, m, n], [m, b, c], [m, c, n]]),
        [m, n, o] => cut_face([b, c, a], [n, o, m], faces),
    }
}

fn least_corner(mesh: &SurfaceMesh) -> DVec3 {
    mesh.positions().iter().fold(DVec3::INFINITY, |least, p| least.min(*p))
}

fn extent(mesh: &SurfaceMesh) -> DVec3 {
    mesh.positions().iter().fold(DVec3::NEG_INFINITY, |most, p| most.max(*p)) - least_corner(mesh)
}

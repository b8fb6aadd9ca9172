//! Base meshes for wrapping as users have them, with quads, texture coordinates, normals, groups and materials.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::mesh::normals::vertex_normals;
use conemap::mesh::{FaceId, HalfedgeId, SurfaceMesh};
use glam::DVec3;
use std::fmt::Write;

/// An OBJ file of a closed mesh, in which pairs of triangles are merged to the squarest quads and the others stay triangles; faces that are
/// not kept are left out.
pub fn obj_with_quads(mesh: &SurfaceMesh, is_kept: impl Fn(FaceId) -> bool) -> Vec<u8> {
    let mut text = String::from("# a base\nmtllib base.mtl\no body\n");
    let normals = vertex_normals(mesh);
    for (v, p) in mesh.positions().iter_enumerated() {
        writeln!(text, "v {} {} {}  0.5 0.25 {}", p.x, p.y, p.z, (v.0 % 10) as f64 / 10.0)
            .expect("memory takes text");
    }
    // The texture coordinates may be any numbers.
    for p in mesh.positions() {
        writeln!(text, "vt {:.6} {:.6}", 0.5 + p.x, 0.5 + p.y).expect("memory takes text");
    }
    for n in &normals {
        writeln!(text, "vn {:.4} {:.4} {:.4}", n.x, n.y, n.z).expect("memory takes text");
    }
    for (k, polygon) in polygons(mesh, is_kept).iter().enumerate() {
        if k % 2000 == 0 {
            writeln!(text, "g part{k}\nusemtl skin{}\ns {}", k % 3, k % 2).expect("memory takes text");
        }
        let corners: Vec<String> = polygon.iter().map(|v| format!("{0}/{0}/{0}", v + 1)).collect();
        writeln!(text, "f {}", corners.join(" ")).expect("memory takes text");
    }
    text.into_bytes()
}

/// The quads and the triangles that are left over, in the order of their faces; the best quads are chosen first.
fn polygons(mesh: &SurfaceMesh, is_kept: impl Fn(FaceId) -> bool) -> Vec<Vec<u32>> {
    let mut edges: Vec<(f64, HalfedgeId)> = mesh
        .edges()
        .filter(|&h| is_kept(h.face()) && is_kept(mesh.twin(h).face()))
        .filter_map(|h| Some((worst_corner(mesh, h)?, h)))
        .collect();
    edges.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut polygon_of: Vec<Option<Vec<u32>>> =
        mesh.triangles().iter().map(|t| Some(t.map(|v| v.0).to_vec())).collect();
    let mut is_merged = vec![false; mesh.face_count()];
    for (_, h) in edges {
        let pair = [h.face(), mesh.twin(h).face()].map(FaceId::index);
        if pair.iter().any(|&f| is_merged[f]) {
            continue;
        }
        pair.iter().for_each(|&f| is_merged[f] = true);
        polygon_of[pair[0]] = Some(ring(mesh, h).map(|v| v.0).to_vec());
        polygon_of[pair[1]] = None;
    }
    let kept = polygon_of.into_iter().enumerate().filter(|(f, _)| is_kept(FaceId::from(*f)));
    kept.filter_map(|(_, polygon)| polygon).collect()
}

/// The four corners of the two faces at an edge, in order around them.
fn ring(mesh: &SurfaceMesh, h: HalfedgeId) -> [conemap::mesh::VertexId; 4] {
    let twin = mesh.twin(h);
    [mesh.tail(h), mesh.tail(twin.prev()), mesh.head(h), mesh.tail(h.prev())]
}

/// The largest |cosine| of the corners of the quad that two faces make; `None` where the quad is not nearly flat, is hollow, or has an
/// angle above 150 degrees.
fn worst_corner(mesh: &SurfaceMesh, h: HalfedgeId) -> Option<f64> {
    let normal = |f: FaceId| {
        let [p, q, r] = mesh.corners(f);
        (q - p).cross(r - p).normalize_or(DVec3::Z)
    };
    if normal(h.face()).dot(normal(mesh.twin(h).face())) < 0.9 {
        return None;
    }
    let at = ring(mesh, h).map(|v| mesh.positions()[v]);
    let cosine = |k: usize| {
        let (u, w) = (at[(k + 3) % 4] - at[k], at[(k + 1) % 4] - at[k]);
        u.normalize_or_zero().dot(w.normalize_or_zero())
    };
    let across = normal(h.face()) + normal(mesh.twin(h).face());
    let is_hollow = |k: usize| (at[(k + 1) % 4] - at[k]).cross(at[(k + 3) % 4] - at[k]).dot(across) <= 0.0;
    if (0..4).any(is_hollow) {
        return None;
    }
    let cosines = [0, 1, 2, 3].map(cosine);
    let least = cosines.iter().copied().fold(1.0, f64::min);
    (least > -0.866).then(|| cosines.iter().map(|c| c.abs()).fold(0.0, f64::max))
}

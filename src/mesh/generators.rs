//! Small closed meshes for tests, examples and demos.

use super::{FaceId, SurfaceMesh, VertexId};
use crate::math::scalar::{cos, sin};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::f64::consts::TAU;
use typed_index_collections::TiVec;

fn build(positions: Vec<DVec3>, faces: Vec<[usize; 3]>) -> SurfaceMesh {
    let faces: TiVec<FaceId, _> = faces.into_iter().map(|f| f.map(VertexId::from)).collect();
    SurfaceMesh::from_triangles(positions.into(), faces).expect("generators make closed manifold meshes")
}

/// The regular tetrahedron inscribed in the unit sphere.
pub fn tetrahedron() -> SurfaceMesh {
    let s = (1.0_f64 / 3.0).sqrt();
    let positions = [(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)]
        .map(|(x, y, z)| DVec3::new(x, y, z) * s);
    build(positions.to_vec(), vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
}

/// The octahedron inscribed in the unit sphere.
pub fn octahedron() -> SurfaceMesh {
    let positions = vec![DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let faces = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    build(positions, faces)
}

/// The icosahedron inscribed in the unit sphere, subdivided `levels` times: 20 * 4^levels faces.
pub fn icosphere(levels: usize) -> SurfaceMesh {
    let mut mesh = icosahedron();
    for _ in 0..levels {
        let fine = midpoint_subdivision(&mesh);
        let on_sphere = fine.positions().iter().map(|p| p.normalize()).collect();
        mesh = fine.with_positions(on_sphere);
    }
    mesh
}

fn icosahedron() -> SurfaceMesh {
    let t = 0.5 * (1.0 + 5.0_f64.sqrt());
    let raw = [
        (-1.0, t, 0.0),
        (1.0, t, 0.0),
        (-1.0, -t, 0.0),
        (1.0, -t, 0.0),
        (0.0, -1.0, t),
        (0.0, 1.0, t),
        (0.0, -1.0, -t),
        (0.0, 1.0, -t),
        (t, 0.0, -1.0),
        (t, 0.0, 1.0),
        (-t, 0.0, -1.0),
        (-t, 0.0, 1.0),
    ];
    let positions = raw.iter().map(|&(x, y, z)| DVec3::new(x, y, z).normalize()).collect();
    let faces = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    build(positions, faces)
}

/// Every triangle split into four at its edge midpoints; the first vertices are the mesh's own, in order.
pub fn midpoint_subdivision(mesh: &SurfaceMesh) -> SurfaceMesh {
    let mut positions: Vec<DVec3> = mesh.positions().iter().copied().collect();
    let mut midpoints = FxHashMap::default();
    for h in mesh.edges() {
        midpoints.insert(h, positions.len());
        positions.push(0.5 * (mesh.positions()[mesh.tail(h)] + mesh.positions()[mesh.head(h)]));
    }
    let mut faces = Vec::with_capacity(mesh.face_count() * 4);
    for (f, corners) in mesh.triangles().iter_enumerated() {
        let [a, b, c] = corners.map(usize::from);
        let [ab, bc, ca] = [0, 1, 2].map(|k| {
            let h = super::HalfedgeId::of(f, k);
            midpoints[&h.min(mesh.twin(h))]
        });
        faces.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    build(positions, faces)
}

/// A torus of revolution with radii 2 and 1: `around` by `tube` vertices (both at least 3), genus 1.
pub fn torus(around: usize, tube: usize) -> SurfaceMesh {
    let mut positions = Vec::with_capacity(around * tube);
    let mut faces = Vec::with_capacity(around * tube * 2);
    for i in 0..around {
        for j in 0..tube {
            let (a, b) = (TAU * i as f64 / around as f64, TAU * j as f64 / tube as f64);
            let r = 2.0 + cos(b);
            positions.push(DVec3::new(r * cos(a), r * sin(a), sin(b)));
            let at = |i: usize, j: usize| (i % around) * tube + j % tube;
            faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    build(positions, faces)
}

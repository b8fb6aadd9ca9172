//! The zero set of a function as a closed triangle mesh with well-shaped triangles.
//!
//! Marching tetrahedra (six to a cube) always give a closed manifold; short edges are then collapsed and vertices moved
//! towards the middle of their neighbours and back onto the surface.

use crate::mesh::collapsible::{CollapsibleMesh, ShapeLimits};
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use glam::DVec3;
use rustc_hash::FxHashMap;
use typed_index_collections::TiVec;

/// The six tetrahedra of a cube around its diagonal 0-7; corner k is at (k & 1, k >> 1 & 1, k >> 2).
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The surface where `value` is 0 (negative inside) in a box, on a grid of the given cell size.
pub(super) fn polygonise(value: impl Fn(DVec3) -> f64, [low, high]: [DVec3; 2], cell: f64) -> SurfaceMesh {
    let mut grid = Grid::new(&value, low, high, cell);
    grid.march();
    let faces = grid.faces.iter().map(|t| t.map(VertexId)).collect();
    let raw = SurfaceMesh::from_triangles(grid.positions.into(), faces);
    let mut mesh = raw.expect("marching tetrahedra give a closed manifold");
    for _ in 0..3 {
        mesh = without_short_edges(&mesh, 0.6 * cell);
        mesh = smoothed(&mesh, &value, cell);
    }
    mesh
}

struct Grid {
    values: Vec<f64>,
    size: [usize; 3],
    low: DVec3,
    cell: f64,
    /// Surface vertex on each grid edge that is crossed.
    crossings: FxHashMap<[u32; 2], u32>,
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
}

impl Grid {
    fn new(value: &impl Fn(DVec3) -> f64, low: DVec3, high: DVec3, cell: f64) -> Self {
        let size = ((high - low) / cell).ceil().to_array().map(|n| n as usize + 2);
        let mut values = Vec::with_capacity(size[0] * size[1] * size[2]);
        for z in 0..size[2] {
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let v = value(low + DVec3::new(x as f64, y as f64, z as f64) * cell);
                    // A corner exactly on the surface would make vertices coincide.
                    values.push(if v.abs() < 1e-3 * cell { 1e-3 * cell } else { v });
                }
            }
        }
        Self {
            values,
            size,
            low,
            cell,
            crossings: FxHashMap::default(),
            positions: Vec::new(),
            faces: Vec::new(),
        }
    }

    fn march(&mut self) {
        let [nx, ny, nz] = self.size;
        for z in 0..nz - 1 {
            for y in 0..ny - 1 {
                for x in 0..nx - 1 {
                    let corner = |k: usize| ((z + (k >> 2)) * ny + y + (k >> 1 & 1)) * nx + x + (k & 1);
                    for tetrahedron in TETRAHEDRA {
                        self.cut(tetrahedron.map(corner));
                    }
                }
            }
        }
    }

    /// Adds the triangles of one positively oriented tetrahedron, facing away from the inside.
    fn cut(&mut self, corners: [usize; 4]) {
        let inside: Vec<usize> = (0..4).filter(|&k| self.values[corners[k]] < 0.0).collect();
        let outside: Vec<usize> = (0..4).filter(|&k| self.values[corners[k]] >= 0.0).collect();
        let mut at = |a: usize, b: usize| self.crossing(corners[a], corners[b]);
        let triangles = match (&inside[..], &outside[..]) {
            (&[a], &[b, c, d]) => vec![[at(a, b), at(a, c), at(a, d)]],
            (&[b, c, d], &[a]) => vec![[at(a, b), at(a, c), at(a, d)]],
            (&[a, b], &[c, d]) => {
                let [ac, ad, bc, bd] = [at(a, c), at(a, d), at(b, c), at(b, d)];
                vec![[ac, ad, bd], [ac, bd, bc]]
            }
            _ => return,
        };
        let place = |k: usize| self.place(corners[k]);
        let outwards = place(outside[0]) - place(inside[0]);
        for mut t in triangles {
            let [p, q, r] = t.map(|v| self.positions[v as usize]);
            if (q - p).cross(r - p).dot(outwards) < 0.0 {
                t.swap(1, 2);
            }
            self.faces.push(t);
        }
    }

    fn place(&self, corner: usize) -> DVec3 {
        let [nx, ny, _] = self.size;
        self.low
            + DVec3::new((corner % nx) as f64, (corner / nx % ny) as f64, (corner / (nx * ny)) as f64)
                * self.cell
    }

    fn crossing(&mut self, a: usize, b: usize) -> u32 {
        let (a, b) = (a.min(b), a.max(b));
        let (p, q) = (self.place(a), self.place(b));
        let (va, vb) = (self.values[a], self.values[b]);
        let next = self.positions.len() as u32;
        let index = *self.crossings.entry([a as u32, b as u32]).or_insert(next);
        if index == next {
            self.positions.push(p.lerp(q, va / (va - vb)));
        }
        index
    }
}

/// Collapses edges shorter than `least` where the mesh stays a manifold of good shape.
fn without_short_edges(mesh: &SurfaceMesh, least: f64) -> SurfaceMesh {
    let limits = ShapeLimits { normal_cosine: 0.7, double_area: 0.0 };
    let mut short: Vec<_> = mesh.edges().map(|h| (mesh.length(h), h)).filter(|e| e.0 < least).collect();
    short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut coarse = CollapsibleMesh::new(mesh);
    for (_, edge) in short {
        // The edge may have vanished or moved with an earlier collapse.
        for h in [edge, mesh.twin(edge)] {
            let (a, b) = (mesh.tail(h), mesh.head(h));
            let same = coarse.is_alive(a) && coarse.is_alive(b);
            let Some(h) = same.then(|| coarse.star(a).find(|&g| coarse.head(g) == b)).flatten() else {
                continue;
            };
            if coarse.link_condition(h) && coarse.keeps_shape(h, mesh.positions(), &limits) {
                coarse.collapse(h);
                break;
            }
        }
    }
    let mut number: TiVec<VertexId, VertexId> = mesh.vertices().collect();
    let mut positions = TiVec::new();
    for v in coarse.vertices() {
        number[v] = positions.push_and_get_key(mesh.positions()[v]);
    }
    let faces: TiVec<FaceId, _> = coarse.faces().map(|f| coarse.corners(f).map(|v| number[v])).collect();
    SurfaceMesh::from_triangles(positions, faces).expect("collapses keep a closed manifold")
}

/// Moves every vertex towards the mean of its neighbours and back onto the surface, a few times.
fn smoothed(mesh: &SurfaceMesh, value: &impl Fn(DVec3) -> f64, cell: f64) -> SurfaceMesh {
    let mut positions: TiVec<VertexId, DVec3> = mesh.positions().iter().copied().collect();
    for _ in 0..4 {
        let mean = |v: VertexId| {
            let (sum, n) =
                mesh.star(v).fold((DVec3::ZERO, 0.0), |(s, n), h| (s + positions[mesh.head(h)], n + 1.0));
            positions[v].lerp(sum / n, 0.5)
        };
        let moved: TiVec<VertexId, DVec3> = mesh.vertices().map(mean).collect();
        positions = moved.iter().map(|&p| projected(p, value, cell)).collect();
    }
    mesh.with_positions(positions)
}

/// Newton steps along the gradient onto the zero set.
fn projected(mut p: DVec3, value: &impl Fn(DVec3) -> f64, cell: f64) -> DVec3 {
    let h = 1e-4 * cell;
    for _ in 0..3 {
        let v = value(p);
        let slope = |axis: DVec3| (value(p + axis * h) - value(p - axis * h)) / (2.0 * h);
        let gradient = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
        let step = gradient * (v / gradient.length_squared().max(1e-6));
        p -= step.clamp_length_max(0.5 * cell);
    }
    p
}

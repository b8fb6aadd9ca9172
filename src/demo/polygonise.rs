//! The zero set of a function as a closed triangle mesh with well-shaped triangles.
//!
//! Marching tetrahedra (six to a cube) always give a closed manifold; short edges are then collapsed and vertices moved
//! towards the middle of their neighbours and back onto the surface.

use super::marching::Grid;
use super::skin::of_level;
use crate::mesh::collapsible::{CollapsibleMesh, ShapeLimits};
use crate::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;
use typed_index_collections::TiVec;

/// The surface where `value` is 0 (negative inside) in a box, on a grid of the given cell size.
pub(super) fn polygonise(value: impl Fn(DVec3) -> f64, bounds: [DVec3; 2], cell: f64) -> SurfaceMesh {
    let mut grid = sampled(&value, bounds, cell);
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

/// A grid over a box with the values of a function.
fn sampled(value: &impl Fn(DVec3) -> f64, bounds: [DVec3; 2], cell: f64) -> Grid {
    let mut grid = Grid::new(bounds, cell);
    let [nx, ny, nz] = grid.size;
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                let v = value(grid.at([x, y, z]));
                let corner = grid.number([x, y, z]);
                // A corner exactly on the surface would make vertices coincide.
                grid.values[corner] = if v.abs() < 1e-3 * cell { 1e-3 * cell } else { v };
            }
        }
    }
    grid
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
    of_level(&coarse, mesh.positions())
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

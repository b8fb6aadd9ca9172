//! The skin of a body as a closed mesh with well-shaped triangles, smaller where the body asks for it.
//!
//! Marching tetrahedra (six to a cube) in the cells near the surface always give a closed manifold. Then short edges are
//! collapsed, edges that are not Delaunay are flipped, and vertices are moved to the middle of their neighbours and back onto the surface.

use super::body::Body;
use super::marching::Grid;
use crate::math::disjoint_sets::DisjointSets;
use crate::math::scalar::{max, min};
use crate::math::triangle::cotangent_between;
use crate::mesh::collapsible::{CollapsibleMesh, ShapeLimits};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The number of cells along the edge of a block.
const BLOCK: usize = 4;
/// The distance of a block's middle from the surface, in units of its half diagonal, beyond which the block is left out.
const CAUTION: f64 = 1.3;
/// The distance from the surface, in units of the cells' size, at which parts have to be felt, or blocks that they touch are left out.
pub(super) const FELT: f64 = 4.0;
/// The number of smoothings in each round of collapses, splits and flips.
const SMOOTHINGS: [usize; 3] = [1, 1, 3];

/// The places and the size of the cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    /// The length of an edge of a cell.
    pub size: f64,
    /// The offset of the cells, in cells.
    pub offset: DVec3,
    /// The factor by which all lengths of edges that the body wants are multiplied.
    pub coarseness: f64,
}

/// The closed skin of a body.
pub(super) fn skin(body: &Body, cells: &Cells) -> SurfaceMesh {
    let mut grid = sampled(body, cells);
    grid.march();
    let (positions, faces) = largest_part(&grid.positions, &grid.faces);
    let raw = SurfaceMesh::from_triangles(positions, faces);
    let mut mesh = raw.expect("marching tetrahedra give a closed manifold");
    let mut lengths = wanted_lengths(&mesh, body, cells.coarseness);
    for times in SMOOTHINGS {
        (mesh, lengths) = with_even_edges(&mesh, lengths);
        mesh = smoothed(&mesh, body, times);
    }
    let onto = mesh.positions().iter().map(|p| projected(*p, body)).collect();
    mesh.with_positions(onto)
}

/// The vertices and faces of the largest connected part. Where a tip is thinner than the cells, small parts may be cut off.
fn largest_part(
    positions: &[DVec3],
    faces: &[[u32; 3]],
) -> (TiVec<VertexId, DVec3>, TiVec<FaceId, [VertexId; 3]>) {
    let mut parts = DisjointSets::new(positions.len());
    for &[a, b, c] in faces {
        parts.join(a as usize, b as usize);
        parts.join(b as usize, c as usize);
    }
    let roots: Vec<usize> = (0..positions.len()).map(|v| parts.root(v)).collect();
    let mut sizes = vec![0; positions.len()];
    for &root in &roots {
        sizes[root] += 1;
    }
    let largest = (0..sizes.len()).max_by_key(|&root| sizes[root]);
    let mut number = vec![VertexId(u32::MAX); positions.len()];
    let mut kept = TiVec::new();
    for v in (0..positions.len()).filter(|&v| Some(roots[v]) == largest) {
        number[v] = kept.push_and_get_key(positions[v]);
    }
    let faces = faces.iter().filter(|t| Some(roots[t[0] as usize]) == largest);
    (kept, faces.map(|t| t.map(|v| number[v as usize])).collect())
}

/// The body's values in the cells around it.
fn sampled(body: &Body, cells: &Cells) -> Grid {
    let [low, high] = body.bounds();
    let mut grid = Grid::new([low - (DVec3::ONE + cells.offset) * cells.size, high], cells.size);
    let size = grid.size;
    for z in (0..size[2]).step_by(BLOCK) {
        for y in (0..size[1]).step_by(BLOCK) {
            for x in (0..size[0]).step_by(BLOCK) {
                fill(&mut grid, body, cells.size, [x, y, z]);
            }
        }
    }
    grid
}

/// Sets the values of a block of the grid; where the surface is far away all corners get the same value.
fn fill(grid: &mut Grid, body: &Body, cell: f64, start: [usize; 3]) {
    let half = 0.5 * (BLOCK - 1) as f64 * cell;
    let middle = body.value(grid.at(start) + DVec3::splat(half));
    let is_far = middle.abs() > CAUTION * 3_f64.sqrt() * half;
    let end = [0, 1, 2].map(|k| (start[k] + BLOCK).min(grid.size[k]));
    for z in start[2]..end[2] {
        for y in start[1]..end[1] {
            for x in start[0]..end[0] {
                let value = if is_far { middle } else { body.value(grid.at([x, y, z])) };
                // A corner on the surface would make vertices coincide.
                let least = 0.03 * cell;
                let corner = grid.number([x, y, z]);
                grid.values[corner] = if value < 0.0 { min(value, -least) } else { max(value, least) };
            }
        }
    }
}

/// The length of the edges that is wanted at each vertex, changing slowly from vertex to vertex.
fn wanted_lengths(mesh: &SurfaceMesh, body: &Body, coarseness: f64) -> TiVec<VertexId, f64> {
    let mut lengths: TiVec<VertexId, f64> =
        mesh.positions().iter().map(|&p| coarseness * body.edge(p)).collect();
    for _ in 0..6 {
        let mean = |v: VertexId| {
            let (sum, n) = mesh.star(v).fold((0.0, 0.0), |(s, n), h| (s + lengths[mesh.head(h)], n + 1.0));
            0.5 * (lengths[v] + sum / n)
        };
        lengths = mesh.vertices().map(mean).collect();
    }
    lengths
}

/// Collapses the short edges where the mesh keeps its shape, and flips edges that are not Delaunay.
fn with_even_edges(
    mesh: &SurfaceMesh,
    mut lengths: TiVec<VertexId, f64>,
) -> (SurfaceMesh, TiVec<VertexId, f64>) {
    let limits = ShapeLimits { normal_cosine: 0.8, double_area: 0.1 };
    let relative = |h: HalfedgeId| mesh.length(h) / (0.5 * (lengths[mesh.tail(h)] + lengths[mesh.head(h)]));
    let mut short: Vec<_> = mesh.edges().map(|h| (relative(h), h)).filter(|e| e.0 < SHORT).collect();
    short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut coarse = CollapsibleMesh::new(mesh);
    let mut touched: TiVec<VertexId, bool> = ti_vec![false; mesh.vertex_count()];
    for (_, edge) in short {
        // The edge may have vanished or moved with an earlier collapse.
        for h in [edge, mesh.twin(edge)] {
            let (a, b) = (mesh.tail(h), mesh.head(h));
            let same = coarse.is_alive(a) && coarse.is_alive(b) && !touched[a];
            let Some(h) = same.then(|| coarse.star(a).find(|&g| coarse.head(g) == b)).flatten() else {
                continue;
            };
            let fits = |g: HalfedgeId| {
                let c = coarse.head(g);
                mesh.positions()[c].distance(mesh.positions()[b]) < LONG * lengths[c]
            };
            if coarse.star(a).all(fits)
                && coarse.link_condition(h)
                && coarse.keeps_shape(h, mesh.positions(), &limits)
            {
                touched[b] = true;
                coarse.collapse(h);
                break;
            }
        }
    }
    let mut positions: TiVec<VertexId, DVec3> = mesh.positions().iter().copied().collect();
    split_long_edges(&mut coarse, &mut positions, &mut lengths);
    for _ in 0..2 {
        flip_to_delaunay(&mut coarse, &positions);
    }
    let kept = coarse.vertices().map(|v| lengths[v]).collect();
    (of_level(&coarse, &positions), kept)
}

/// Splits the edges that are too long for the wanted length, the longest first.
fn split_long_edges(
    mesh: &mut CollapsibleMesh,
    positions: &mut TiVec<VertexId, DVec3>,
    lengths: &mut TiVec<VertexId, f64>,
) {
    let mut long = Vec::new();
    for h in mesh.faces().flat_map(FaceId::halfedges).filter(|&h| h < mesh.twin(h)) {
        let (a, b) = (mesh.tail(h), mesh.head(h));
        let relative = positions[a].distance(positions[b]) / (0.5 * (lengths[a] + lengths[b]));
        if relative > LONG {
            long.push((relative, h));
        }
    }
    long.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for (_, h) in long {
        // A half of an edge that was split keeps its number only where it begins: no edge is split twice.
        let (a, b) = (mesh.tail(h), mesh.head(h));
        positions.push(positions[a].midpoint(positions[b]));
        lengths.push(0.5 * (lengths[a] + lengths[b]));
        mesh.split(h);
    }
}

/// The length below which edges are collapsed, in units of the wanted length.
const SHORT: f64 = 0.75;
/// The length beyond which edges are split, and which no collapse exceeds, in units of the wanted length.
const LONG: f64 = 1.45;

fn flip_to_delaunay(mesh: &mut CollapsibleMesh, positions: &TiSlice<VertexId, DVec3>) {
    let edges: Vec<HalfedgeId> = mesh.faces().flat_map(FaceId::halfedges).collect();
    for h in edges {
        let t = mesh.twin(h);
        if t < h {
            continue;
        }
        let [a, b, c, d] = [h, t, h.prev(), t.prev()].map(|g| positions[mesh.tail(g)]);
        let sum = cotangent_between(a - c, b - c) + cotangent_between(a - d, b - d);
        // That of a triangle without area may be not a number.
        if sum.is_nan() || sum >= -1e-6 {
            continue;
        }
        let normals =
            [(b - a).cross(c - a), (d - a).cross(b - a), (d - c).cross(b - c), (a - c).cross(d - c)];
        let [n0, n1, m0, m1] = normals.map(DVec3::normalize_or_zero);
        if n0.dot(n1) > 0.9 && m0.dot(m1) > 0.9 && m0.dot(n0) > 0.8 && m1.dot(n1) > 0.8 {
            mesh.flip(h);
        }
    }
}

/// The level as a mesh of its own.
pub(super) fn of_level(level: &CollapsibleMesh, positions: &TiSlice<VertexId, DVec3>) -> SurfaceMesh {
    let mut number: TiVec<VertexId, VertexId> = ti_vec![VertexId(u32::MAX); positions.len()];
    let mut places = TiVec::new();
    for v in level.vertices() {
        number[v] = places.push_and_get_key(positions[v]);
    }
    let faces: TiVec<FaceId, _> = level.faces().map(|f| level.corners(f).map(|v| number[v])).collect();
    SurfaceMesh::from_triangles(places, faces).expect("collapses and flips keep a closed manifold")
}

/// Moves every vertex towards the mean of its neighbours and back near the surface, `times` times, and at last onto the surface.
fn smoothed(mesh: &SurfaceMesh, body: &Body, times: usize) -> SurfaceMesh {
    let mut positions: TiVec<VertexId, DVec3> = mesh.positions().iter().copied().collect();
    for _ in 0..times {
        let moved = |v: VertexId| {
            let (mut sum, mut n, mut normal, mut reach) = (DVec3::ZERO, 0.0, DVec3::ZERO, f64::INFINITY);
            let at = positions[v];
            for h in mesh.star(v) {
                let [p, q] = [mesh.head(h), mesh.tail(h.prev())].map(|w| positions[w]);
                (sum, n, reach) = (sum + p, n + 1.0, min(reach, p.distance_squared(at)));
                normal += (p - at).cross(q - at);
            }
            let (goal, reach) = (at.lerp(sum / n, 0.6), 0.5 * reach.sqrt());
            goal - normal.normalize_or_zero() * body.value(goal).clamp(-reach, reach)
        };
        positions = mesh.vertices().map(moved).collect();
    }
    mesh.with_positions(positions)
}

/// A Newton step along the gradient onto the surface.
fn projected(p: DVec3, body: &Body) -> DVec3 {
    let h = 1e-5;
    let v = body.value(p);
    let slope = |axis: DVec3| (body.value(p + axis * h) - v) / h;
    let gradient = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
    let step = gradient * (v / max(gradient.length_squared(), 0.1));
    p - step.clamp_length_max(0.01)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo::body::{Ellipsoid, Part, Solid};

    fn ball(centre: DVec3, radius: f64) -> Solid {
        Solid::Ellipsoid(Ellipsoid {
            centre,
            axes: [DVec3::X, DVec3::Y, DVec3::Z],
            radii: DVec3::splat(radius),
        })
    }

    #[test]
    fn the_skin_of_a_ball_is_a_sphere_with_edges_as_wanted() {
        let body = Body::new(vec![Part::join(vec![ball(DVec3::ONE, 0.5)], 0.05, 0.06)]);
        let cells = Cells { size: 0.04, offset: DVec3::splat(0.3), coarseness: 1.0 };
        let mesh = skin(&body, &cells);
        assert_eq!(mesh.euler_characteristic(), 2);
        assert!(mesh.positions().iter().all(|p| (p.distance(DVec3::ONE) - 0.5).abs() < 1e-4));
        let lengths: Vec<f64> = mesh.edges().map(|h| mesh.length(h) / 0.06).collect();
        let fitting = lengths.iter().filter(|l| (0.6..1.6).contains(*l)).count();
        assert!(fitting as f64 > 0.97 * lengths.len() as f64, "{fitting} of {}", lengths.len());
    }

    #[test]
    fn edges_are_short_where_that_is_wanted() {
        let fine = Part::join(vec![ball(DVec3::X * 0.5, 0.15)], 0.03, 0.015);
        let body = Body::new(vec![Part::join(vec![ball(DVec3::ZERO, 0.5)], 0.05, 0.06), fine]);
        let mesh = skin(&body, &Cells { size: 0.04, offset: DVec3::ZERO, coarseness: 1.0 });
        assert_eq!(mesh.euler_characteristic(), 2);
        let mean = |near: &dyn Fn(DVec3) -> bool| {
            let edges: Vec<_> = mesh.edges().filter(|&h| near(mesh.positions()[mesh.tail(h)])).collect();
            edges.iter().map(|&h| mesh.length(h)).sum::<f64>() / edges.len() as f64
        };
        assert!(mean(&|p| p.x > 0.58) < 0.03);
        assert!(mean(&|p| p.x < 0.0) > 0.045);
    }

    #[test]
    fn a_cut_part_leaves_a_dent() {
        let [whole, cut] = [ball(DVec3::ZERO, 0.5), ball(DVec3::Y * 0.55, 0.2)];
        let body = Body::new(vec![Part::join(vec![whole], 0.05, 0.05), Part::cut(vec![cut], 0.02, 0.03)]);
        assert!(body.value(DVec3::Y * 0.45) > 0.05);
        assert!(body.value(DVec3::X * 0.45) < -0.04);
        assert!((body.normal(DVec3::X * 0.5) - DVec3::X).length() < 1e-3);
    }
}

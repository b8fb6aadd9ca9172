//! Bounds of geodesic distances that hold for triangles of any shape.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::geodesic::distances;
use conemap::mesh::{SurfaceMesh, VertexId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The lengths of the shortest paths along edges from the seeds to all vertices.
pub fn along_edges(mesh: &SurfaceMesh, seeds: &[VertexId]) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; mesh.vertex_count()];
    let mut queue: BinaryHeap<(Reverse<u64>, VertexId)> = BinaryHeap::new();
    for &seed in seeds {
        distance[seed.index()] = 0.0;
        queue.push((Reverse(0), seed));
    }
    while let Some((Reverse(bits), v)) = queue.pop() {
        let here = f64::from_bits(bits);
        if here > distance[v.index()] {
            continue;
        }
        for h in mesh.star(v) {
            let (w, through) = (mesh.head(h), here + mesh.length(h));
            if through < distance[w.index()] {
                distance[w.index()] = through;
                queue.push((Reverse(through.to_bits()), w));
            }
        }
    }
    distance
}

/// Checks that no distance is longer than the shortest path along edges, and none shorter than the straight line through space, but for a
/// small error.
pub fn check_bounds(mesh: &SurfaceMesh, seed: VertexId, name: &str) {
    let (found, most) = (distances(mesh, &[seed]), along_edges(mesh, &[seed]));
    for v in mesh.vertices() {
        let (d, most) = (found[v], most[v.index()]);
        let straight = mesh.positions()[v].distance(mesh.positions()[seed]);
        assert!(d <= most * (1.0 + 1e-12), "{name}: vertex {v:?} at {d}, along edges at {most}");
        assert!(d >= 0.99 * straight, "{name}: vertex {v:?} at {d}, in space at {straight}");
    }
}

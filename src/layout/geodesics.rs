//! Distances between all landmarks along mesh edges.

use crate::mesh::{SurfaceMesh, VertexId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use typed_index_collections::{TiVec, ti_vec};

/// Edge-path distances between all landmarks on both meshes, both areas scaled to 1.
#[derive(Clone, Debug)]
pub(super) struct LandmarkDistances {
    count: usize,
    by_side: [Vec<f64>; 2],
}

impl LandmarkDistances {
    pub fn new(meshes: [&SurfaceMesh; 2], landmarks: [&[VertexId]; 2]) -> Self {
        let count = landmarks[0].len();
        let by_side = [0, 1].map(|s| {
            let scale = 1.0 / meshes[s].area().sqrt();
            landmarks[s].iter().flat_map(|&v| distances_from(meshes[s], v, landmarks[s], scale)).collect()
        });
        Self { count, by_side }
    }

    pub fn len(&self) -> usize {
        self.count
    }

    /// Sum of the distances on both meshes.
    pub fn sum(&self, [i, j]: [usize; 2]) -> f64 {
        self.by_side[0][i * self.count + j] + self.by_side[1][i * self.count + j]
    }
}

/// Positive floats order like their bits.
fn distances_from(mesh: &SurfaceMesh, start: VertexId, goals: &[VertexId], scale: f64) -> Vec<f64> {
    let mut distance: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    let mut queue = BinaryHeap::new();
    distance[start] = 0.0;
    queue.push((Reverse(0_u64), start.0));
    while let Some((Reverse(bits), v)) = queue.pop() {
        let (here, v) = (f64::from_bits(bits), VertexId(v));
        if here > distance[v] {
            continue;
        }
        for h in mesh.star(v) {
            let (next, through) = (mesh.head(h), here + mesh.length(h));
            if through < distance[next] {
                distance[next] = through;
                queue.push((Reverse(through.to_bits()), next.0));
            }
        }
    }
    goals.iter().map(|&v| distance[v] * scale).collect()
}

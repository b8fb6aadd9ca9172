//! The directions in which shortest paths to the other landmarks leave each landmark.

use crate::landmarks::{LandmarkId, Landmarks, MeshSide};
use crate::layout::LandmarkDistances;
use crate::math::triangle::angle_at;
use crate::mesh::{SurfaceMesh, VertexId};
use std::f64::consts::TAU;
use typed_index_collections::{TiSlice, TiVec};

/// Places on each edge of a landmark's ring, as shares of its length, through which paths are tried. Chosen by hand.
const SHARES: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Directions by mesh, landmark and goal: angles around the landmark, counter-clockwise, scaled to 2 pi.
pub(super) struct Directions {
    angles: [TiVec<LandmarkId, TiVec<LandmarkId, f64>>; 2],
}

impl Directions {
    pub(super) fn new(
        meshes: [&SurfaceMesh; 2],
        landmarks: &Landmarks,
        distances: &LandmarkDistances,
    ) -> Self {
        let vertices = [&landmarks.source, &landmarks.target];
        let angles = MeshSide::BOTH.map(|side| {
            let ring = |v: &VertexId| Ring::new(meshes[side], *v);
            let fields = || vertices[side].keys().map(|goal| distances.field(side, goal));
            let directions = |ring: Ring| fields().map(|field| ring.direction(field)).collect();
            vertices[side].iter().map(ring).map(directions).collect()
        });
        Self { angles }
    }

    /// The angles, around landmark `at`, from the direction to `first` counter-clockwise to the directions to all landmarks; 0 to 2 pi.
    pub(super) fn turns(&self, side: MeshSide, at: LandmarkId, first: LandmarkId) -> TiVec<LandmarkId, f64> {
        let around = &self.angles[side][at];
        let begin = around[first];
        around.iter().map(|a| if *a < begin { a - begin + TAU } else { a - begin }).collect()
    }
}

/// Points around a vertex through which paths leave it.
struct Ring {
    points: Vec<RingPoint>,
    /// The sum of the angles around the vertex.
    turned: f64,
}

/// A point of a ring.
struct RingPoint {
    /// The ends of the ring's edge on which it lies.
    edge: [VertexId; 2],
    /// Its place on the edge, 0 to 1.
    share: f64,
    /// Distance from the vertex, the mesh's area scaled to 1.
    length: f64,
    /// The angle of its direction at the vertex, in radians.
    angle: f64,
}

impl Ring {
    fn new(mesh: &SurfaceMesh, v: VertexId) -> Self {
        let scale = 1.0 / mesh.area().sqrt();
        let place = mesh.positions()[v];
        let mut ring = Self { points: Vec::new(), turned: 0.0 };
        for h in mesh.star(v) {
            let edge = [mesh.head(h), mesh.tail(h.prev())];
            let [from, onto] = edge.map(|w| mesh.positions()[w]);
            let width = angle_at(place, from, onto);
            ring.points.extend(SHARES.map(|share| RingPoint {
                edge,
                share,
                length: scale * from.lerp(onto, share).distance(place),
                angle: ring.turned + share * width,
            }));
            ring.turned += width;
        }
        ring
    }

    /// The direction of the shortest path to the point from which `field` has the distances; from 0 to 2 pi.
    fn direction(&self, field: &TiSlice<VertexId, f64>) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for &RingPoint { edge: [from, onto], share, length, angle } in &self.points {
            let through = length + field[from] + share * (field[onto] - field[from]);
            if through < best.0 {
                best = (through, angle);
            }
        }
        best.1 / self.turned * TAU
    }
}

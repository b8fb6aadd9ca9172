//! The quality of a new mesh.

use super::smoothing::SEARCH;
use crate::math::scalar::{max, min};
use crate::math::triangle::angle_at;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, SurfaceMesh};
use crate::monitor::{Cancelled, Pulse};
use glam::DVec3;
use serde::Serialize;

/// The quality of a new mesh; lengths in the given mesh's unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Number of triangles.
    pub faces: usize,
    /// Number of rounds that were made.
    pub rounds: usize,
    /// The lengths of the edges.
    pub edge_length: EdgeLengths,
    /// Smallest angle of a triangle, in degrees.
    pub min_angle: f64,
    /// Mean over the triangles of their smallest angles, in degrees; 60 at most.
    pub mean_min_angle: f64,
    /// The distances to the given surface and from it.
    pub distance: Distances,
}

/// The lengths of edges.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EdgeLengths {
    /// The mean length.
    pub mean: f64,
    /// The standard deviation of the lengths.
    pub deviation: f64,
}

/// Largest distances between two surfaces, at the vertices, edge midpoints and centroids of the one that is named first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distances {
    /// From the new mesh to the given one.
    pub to_original: f64,
    /// From the given mesh to the new one: large where a thin part was lost.
    pub from_original: f64,
}

impl Report {
    /// The same lengths in another unit, of which `factor` make one of this.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let EdgeLengths { mean, deviation } = self.edge_length;
        let Distances { to_original, from_original } = self.distance;
        Self {
            edge_length: EdgeLengths { mean: mean * factor, deviation: deviation * factor },
            distance: Distances { to_original: to_original * factor, from_original: from_original * factor },
            ..self
        }
    }

    /// Measures a mesh against the surface that it stands for.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub(super) fn new(
        mesh: &SurfaceMesh,
        original: &SurfaceIndex<'_>,
        rounds: usize,
        pulse: &mut Pulse<'_>,
    ) -> Result<Self, Cancelled> {
        let smallest: Vec<_> = mesh.faces().map(|f| smallest_angle(mesh.corners(f)).to_degrees()).collect();
        Ok(Self {
            faces: mesh.face_count(),
            rounds,
            edge_length: EdgeLengths::of(mesh),
            min_angle: smallest.iter().copied().fold(60.0, min),
            mean_min_angle: smallest.iter().sum::<f64>() / smallest.len() as f64,
            distance: Distances {
                to_original: largest_distance(mesh, original, pulse)?,
                from_original: largest_distance(original.mesh(), &SurfaceIndex::new(mesh), pulse)?,
            },
        })
    }
}

impl EdgeLengths {
    /// The edge lengths of a mesh.
    pub fn of(mesh: &SurfaceMesh) -> Self {
        let count = mesh.edge_count() as f64;
        let mean = mesh.edges().map(|h| mesh.length(h)).sum::<f64>() / count;
        let square = |length: f64| (length - mean) * (length - mean);
        let deviation = (mesh.edges().map(|h| square(mesh.length(h))).sum::<f64>() / count).sqrt();
        Self { mean, deviation }
    }
}

fn smallest_angle([p, q, r]: [DVec3; 3]) -> f64 {
    min(angle_at(p, q, r), min(angle_at(q, r, p), angle_at(r, p, q)))
}

fn largest_distance(
    from: &SurfaceMesh,
    to: &SurfaceIndex<'_>,
    pulse: &mut Pulse<'_>,
) -> Result<f64, Cancelled> {
    let samples = |f: FaceId| {
        let [p, q, r] = from.corners(f);
        [p, p.midpoint(q), q.midpoint(r), r.midpoint(p), (p + q + r) / 3.0]
    };
    let mut largest = 0.0;
    for sample in from.faces().flat_map(samples) {
        pulse.beat_by(SEARCH)?;
        largest = max(largest, to.nearest(sample).distance);
    }
    Ok(largest)
}

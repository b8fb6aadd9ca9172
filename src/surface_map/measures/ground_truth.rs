//! Distances between images under a map and the true images, where these are known.

use crate::math::quantile::{Weighted, quantile, sort_by_value};
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;

/// Distances between images and true images, in units of sqrt(target area).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GroundTruthError {
    /// Mean over the source's vertices.
    pub mean: f64,
    /// 95 % quantile.
    pub p95: f64,
    /// Maximum.
    pub max: f64,
}

/// Euclidean distances of images from the true ones; vertices without an image, and those whose true image is not known, are left out.
pub fn distance_to_truth(
    target: &SurfaceMesh,
    images: impl Iterator<Item = (VertexId, SurfacePoint)>,
    truth: impl Fn(VertexId) -> Option<DVec3>,
) -> GroundTruthError {
    let scale = 1.0 / target.area().sqrt();
    let distance = |(v, image): (VertexId, SurfacePoint)| {
        let value = image.position(target).distance(truth(v)?) * scale;
        Some(Weighted { value, weight: 1.0 })
    };
    let mut distances: Vec<_> = images.filter_map(distance).collect();
    sort_by_value(&mut distances);
    GroundTruthError {
        mean: distances.iter().map(|d| d.value).sum::<f64>() / distances.len() as f64,
        p95: quantile(&distances, 0.95),
        max: distances.last().map_or(f64::NAN, |d| d.value),
    }
}

//! A ball and a rounded tetrahedron, with the tetrahedron's corners, edges and faces as landmarks.

use super::polygonise::polygonise;
use super::shape::Shape;
use crate::math::scalar::{exp, ln};
use crate::mesh::generators::{self, icosphere};
use glam::DVec3;

/// The names of the landmarks, in the order of [`directions`].
const NAMES: [&str; 14] = [
    "corner 1", "corner 2", "corner 3", "corner 4", "edge 1-2", "edge 1-3", "edge 1-4", "edge 2-3",
    "edge 2-4", "edge 3-4", "face 1", "face 2", "face 3", "face 4",
];

/// Unit directions of the corners, edge midpoints and faces of the regular tetrahedron.
fn directions() -> Vec<DVec3> {
    let mesh = generators::tetrahedron();
    let corners: Vec<DVec3> = mesh.positions().iter().copied().collect();
    let mut directions = corners.clone();
    for i in 0..4 {
        directions.extend((i + 1..4).map(|j| (corners[i] + corners[j]).normalize()));
    }
    directions.extend(corners.iter().map(|c| -*c));
    directions
}

pub(super) fn sphere() -> Shape {
    let points = NAMES.into_iter().zip(directions()).collect();
    Shape { mesh: icosphere(4), points }
}

/// The zero set of a soft maximum of four planes.
pub(super) fn tetrahedron() -> Shape {
    let corners: Vec<DVec3> = generators::tetrahedron().positions().iter().copied().collect();
    let sharpness = 5.0;
    let value = move |p: DVec3| {
        // Relative to the largest, so that nothing overflows.
        let most = corners.iter().map(|c| -c.dot(p)).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = corners.iter().map(|c| exp(sharpness * (-c.dot(p) - most))).sum();
        most + ln(sum) / sharpness - 0.6
    };
    let mesh = polygonise(&value, [DVec3::splat(-1.9), DVec3::splat(1.9)], 0.085);
    let surface = |d: DVec3| {
        let (mut inside, mut outside) = (0.0, 4.0);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if value(d * middle) < 0.0 { inside = middle } else { outside = middle }
        }
        d * inside
    };
    let points = NAMES.into_iter().zip(directions().into_iter().map(surface)).collect();
    Shape { mesh, points }
}

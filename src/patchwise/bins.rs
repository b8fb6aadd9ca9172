//! Point location among developed faces.

use super::development::{Placed, bounds};
use crate::math::barycentric::shares;
use crate::math::triangle::signed_double_area;
use crate::mesh::SurfacePoint;
use glam::DVec2;

/// Barycentric coordinates down to minus this are inside a developed face; the flow leaves some curvature, which moves the
/// faces.
const INSIDE_FACE: f64 = 1e-6;

/// Developed faces in square bins over a triangle.
pub struct Bins {
    faces: Vec<Placed>,
    low: DVec2,
    /// Bins per unit of length.
    density: DVec2,
    /// Number of rows, and of bins in each.
    rows: usize,
    bins: Vec<Vec<u32>>,
}

impl Bins {
    /// Sorts developed faces into bins over a triangle.
    pub fn new(faces: Vec<Placed>, triangle: &[DVec2; 3]) -> Self {
        let [low, high] = bounds(triangle);
        // About one face a bin; 512^2 bins take a few megabytes.
        let rows = ((faces.len() as f64).sqrt() as usize).clamp(1, 512);
        let density = DVec2::splat(rows as f64) / (high - low);
        let mut result = Self { faces, low, density, rows, bins: vec![Vec::new(); rows * rows] };
        for number in 0..result.faces.len() {
            let [low, high] = bounds(&result.faces[number].corners);
            let ([x0, y0], [x1, y1]) = (result.bin(low), result.bin(high));
            for y in y0..=y1 {
                (x0..=x1).for_each(|x| result.bins[y * rows + x].push(number as u32));
            }
        }
        result
    }

    fn bin(&self, p: DVec2) -> [usize; 2] {
        let scaled = (p - self.low) * self.density;
        scaled.to_array().map(|x| (x.max(0.0) as usize).min(self.rows - 1))
    }

    /// The face, not inverted, that contains a point best.
    pub fn locate(&self, q: DVec2) -> Option<SurfacePoint> {
        let [x, y] = self.bin(q);
        let mut best: Option<(f64, SurfacePoint)> = None;
        for &number in &self.bins[y * self.rows + x] {
            let Placed { face, corners } = self.faces[number as usize];
            if signed_double_area(corners[0], corners[1], corners[2]) <= 0.0 {
                continue;
            }
            let weights = weights(&corners, q);
            let least = weights.into_iter().fold(f64::INFINITY, f64::min);
            if least >= -INSIDE_FACE && best.is_none_or(|(other, _)| least > other) {
                best = Some((least, SurfacePoint::clamped(face, weights)));
            }
        }
        best.map(|(_, point)| point)
    }
}

/// Barycentric coordinates of p in a triangle that is not degenerate.
pub fn weights(&[a, b, c]: &[DVec2; 3], p: DVec2) -> [f64; 3] {
    let whole = signed_double_area(a, b, c);
    shares([a, b, c], p).map(|w| w / whole)
}

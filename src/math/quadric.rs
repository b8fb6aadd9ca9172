//! Quadric error metrics.

use glam::{DMat3, DVec3};

/// Area-weighted sum of squared distances to planes (Garland & Heckbert 1997).
#[derive(Clone, Copy, Debug)]
pub struct Quadric {
    second: DMat3,
    first: DVec3,
    constant: f64,
    /// A third of the area of the triangles added, each counted at every corner.
    pub area: f64,
}

impl Quadric {
    /// The sum of no planes.
    pub const ZERO: Self = Self { second: DMat3::ZERO, first: DVec3::ZERO, constant: 0.0, area: 0.0 };

    /// Squared distance to the plane of a triangle, times its area; 0 for a degenerate triangle.
    pub fn of_triangle([p, q, r]: [DVec3; 3]) -> Self {
        let cross = (q - p).cross(r - p);
        let area = 0.5 * cross.length();
        let n = cross.normalize_or_zero();
        let d = -n.dot(p);
        let second = DMat3::from_cols(n * n.x, n * n.y, n * n.z) * area;
        Self { second, first: n * (d * area), constant: d * d * area, area: area / 3.0 }
    }

    /// Sum of both.
    pub fn add(&mut self, other: &Self) {
        self.second += other.second;
        self.first += other.first;
        self.constant += other.constant;
        self.area += other.area;
    }

    /// Value at a point.
    pub fn at(&self, p: DVec3) -> f64 {
        (p.dot(self.second * p) + 2.0 * self.first.dot(p) + self.constant).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_is_the_sum_of_squared_distances_times_areas() {
        let mut quadric = Quadric::ZERO;
        quadric.add(&Quadric::of_triangle([DVec3::ZERO, DVec3::X, DVec3::Y]));
        quadric.add(&Quadric::of_triangle([DVec3::ZERO, DVec3::Y * 2.0, DVec3::Z]));
        let p = DVec3::new(3.0, 0.7, 2.0);
        assert!((quadric.at(p) - (0.5 * 4.0 + 1.0 * 9.0)).abs() < 1e-13);
    }
}

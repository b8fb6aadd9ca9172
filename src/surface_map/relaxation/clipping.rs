//! The polygon that two triangles of a plane share, and its area.

use crate::math::scalar::max;
use crate::math::triangle::signed_double_area;
use glam::DVec2;

/// A counter-clockwise triangle with its bounding box.
#[derive(Clone, Copy)]
pub struct BoxedTriangle {
    /// Its corners.
    pub corners: [DVec2; 3],
    low: DVec2,
    high: DVec2,
}

/// Memory for the corners of a triangle that was clipped three times, also where rounding makes it a little concave.
type Polygon = [DVec2; 12];

impl BoxedTriangle {
    /// A triangle by its corners.
    pub fn new(corners: [DVec2; 3]) -> Self {
        let [p, q, r] = corners;
        Self { corners, low: p.min(q).min(r), high: p.max(q).max(r) }
    }

    /// The area that two triangles share.
    pub fn overlap(&self, clip: &Self) -> f64 {
        let mut polygon: Polygon = [DVec2::ZERO; 12];
        let count = self.shared(clip, &mut polygon);
        0.5 * max(fan(&polygon[..count]).map(|[p, q, r]| signed_double_area(p, q, r)).sum(), 0.0)
    }

    /// The triangles of a fan of the polygon that two triangles share; none where it has no area.
    pub fn shared_triangles(&self, clip: &Self) -> Vec<Self> {
        let mut polygon: Polygon = [DVec2::ZERO; 12];
        let count = self.shared(clip, &mut polygon);
        let has_area = |&[p, q, r]: &[DVec2; 3]| signed_double_area(p, q, r) > 0.0;
        fan(&polygon[..count]).filter(has_area).map(Self::new).collect()
    }

    /// The polygon that two triangles share, one clipped by the other's sides (Sutherland & Hodgman 1974); returns the number of its
    /// corners.
    fn shared(&self, clip: &Self, polygon: &mut Polygon) -> usize {
        if !(self.low.cmple(clip.high).all() && clip.low.cmple(self.high).all()) {
            return 0;
        }
        polygon[..3].copy_from_slice(&self.corners);
        let mut count = 3;
        for k in 0..3 {
            let from = clip.corners[k];
            let along = clip.corners[(k + 1) % 3] - from;
            count = clipped(polygon, count, |p| along.perp_dot(p - from));
            if count < 3 {
                return 0;
            }
        }
        count
    }
}

/// The triangles of a convex polygon that have its first corner.
fn fan(polygon: &[DVec2]) -> impl Iterator<Item = [DVec2; 3]> {
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]])
}

/// Cuts off the part of a polygon where `side` is negative; returns the number of corners left.
fn clipped(polygon: &mut Polygon, count: usize, side: impl Fn(DVec2) -> f64) -> usize {
    let before = *polygon;
    let mut kept = 0;
    let mut here = side(before[0]);
    for i in 0..count {
        let (a, b) = (before[i], before[if i + 1 == count { 0 } else { i + 1 }]);
        let there = side(b);
        if here >= 0.0 {
            polygon[kept] = a;
            kept += 1;
        }
        if (here >= 0.0) != (there >= 0.0) {
            polygon[kept] = a + (b - a) * (here / (here - there));
            kept += 1;
        }
        here = there;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_areas_of_known_triangles() {
        let at = |p: [f64; 2], size: f64| {
            let p = DVec2::from(p);
            BoxedTriangle::new([p, p + DVec2::new(size, 0.0), p + DVec2::new(0.0, size)])
        };
        let unit = at([0.0, 0.0], 1.0);
        assert_eq!(unit.overlap(&unit), 0.5);
        assert_eq!(unit.overlap(&at([0.25, 0.25], 0.25)), 0.03125);
        assert_eq!(unit.overlap(&at([0.5, 0.0], 1.0)), 0.125);
        assert_eq!(at([0.5, 0.0], 1.0).overlap(&unit), 0.125);
        assert_eq!(unit.overlap(&at([1.0, 1.0], 1.0)), 0.0);
        let slanted = BoxedTriangle::new([[-1.0, -1.0], [0.5, -1.0], [0.5, 2.0]].map(DVec2::from));
        let parts = unit.shared_triangles(&slanted);
        assert_eq!(unit.overlap(&slanted), 0.375);
        assert_eq!(parts.iter().map(|part| part.overlap(&unit)).sum::<f64>(), 0.375);
        assert_eq!((parts.len(), parts[0].overlap(&parts[1])), (2, 0.0));
        assert_eq!(unit.shared_triangles(&at([1.0, 1.0], 1.0)).len(), 0);
    }
}

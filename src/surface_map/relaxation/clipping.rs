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

/// Corners of a triangle that was clipped three times, at most, also where rounding makes it a little concave.
const MOST_CORNERS: usize = 12;

/// Memory for these corners.
type Polygon = [DVec2; MOST_CORNERS];

impl BoxedTriangle {
    /// A triangle by its corners.
    pub fn new(corners: [DVec2; 3]) -> Self {
        let [p, q, r] = corners;
        Self { corners, low: p.min(q).min(r), high: p.max(q).max(r) }
    }

    /// The area that two triangles share.
    pub fn overlap(&self, clip: &Self) -> f64 {
        let doubled = |polygon: &[DVec2]| fan(polygon).map(|[p, q, r]| signed_double_area(p, q, r)).sum();
        self.shared(clip, doubled).map_or(0.0, |doubled: f64| 0.5 * max(doubled, 0.0))
    }

    /// The triangles of a fan of the polygon that two triangles share; none where it has no area.
    pub fn shared_triangles(&self, clip: &Self) -> Vec<Self> {
        let has_area = |&[p, q, r]: &[DVec2; 3]| signed_double_area(p, q, r) > 0.0;
        let parts = |polygon: &[DVec2]| fan(polygon).filter(has_area).map(Self::new).collect();
        self.shared(clip, parts).unwrap_or_default()
    }

    /// A value of the polygon that two triangles share, one clipped by the other's sides (Sutherland & Hodgman 1974); `None` where they
    /// share none.
    fn shared<T>(&self, clip: &Self, value: impl FnOnce(&[DVec2]) -> T) -> Option<T> {
        if !(self.low.cmple(clip.high).all() && clip.low.cmple(self.high).all()) {
            return None;
        }
        let mut memory: [Polygon; 2] = [[DVec2::ZERO; MOST_CORNERS]; 2];
        let [mut polygon, mut spare] = memory.each_mut();
        polygon[..3].copy_from_slice(&self.corners);
        let mut count = 3;
        for k in 0..3 {
            let from = clip.corners[k];
            let along = clip.corners[(k + 1) % 3] - from;
            let mut sides = [0.0; MOST_CORNERS];
            let mut is_within = true;
            for (side, &p) in sides.iter_mut().zip(&polygon[..count]) {
                *side = along.perp_dot(p - from);
                is_within &= *side >= 0.0;
            }
            if !is_within {
                count = clipped(&polygon[..count], &sides, spare);
                (polygon, spare) = (spare, polygon);
            }
            if count < 3 {
                return None;
            }
        }
        Some(value(&polygon[..count]))
    }
}

/// The triangles of a convex polygon that have its first corner.
fn fan(polygon: &[DVec2]) -> impl Iterator<Item = [DVec2; 3]> {
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]])
}

/// Cuts off the part of a polygon where `sides` of its corners are negative; returns the number of corners left.
fn clipped(polygon: &[DVec2], sides: &[f64; MOST_CORNERS], left: &mut Polygon) -> usize {
    let count = polygon.len();
    let mut kept = 0;
    for i in 0..count {
        let next = if i + 1 == count { 0 } else { i + 1 };
        let ([a, b], [here, there]) = ([polygon[i], polygon[next]], [sides[i], sides[next]]);
        if here >= 0.0 {
            left[kept] = a;
            kept += 1;
        }
        if (here >= 0.0) != (there >= 0.0) {
            left[kept] = a + (b - a) * (here / (here - there));
            kept += 1;
        }
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

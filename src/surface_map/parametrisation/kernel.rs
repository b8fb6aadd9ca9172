//! The kernel of a star polygon: the places in which a vertex sees all its neighbours' edges from the left.

use crate::math::triangle::signed_double_area;
use glam::DVec2;

/// Reusable memory for clipping.
#[derive(Clone, Default)]
pub struct Kernel {
    polygon: Vec<DVec2>,
    clipped: Vec<DVec2>,
}

impl Kernel {
    /// The centroid of the kernel of a counter-clockwise polygon: of all points that lie on the left of every side.
    ///
    /// `None` where the kernel is empty or has no area but rounding.
    pub fn centroid(&mut self, star: &[DVec2]) -> Option<DVec2> {
        let (low, high) = star.iter().fold((star[0], star[0]), |(l, h), p| (l.min(*p), h.max(*p)));
        self.polygon.clear();
        self.polygon.extend([low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]);
        for k in 0..star.len() {
            self.clip(star[k], star[(k + 1) % star.len()]);
        }
        let size = high - low;
        // Double areas below this share of the bounding box are rounding.
        centroid(&self.polygon, 1e-14 * size.x * size.y)
    }

    /// Keeps the part of the polygon on the left of the line from `a` to `b`.
    fn clip(&mut self, a: DVec2, b: DVec2) {
        let side = |p: DVec2| signed_double_area(a, b, p);
        self.clipped.clear();
        for k in 0..self.polygon.len() {
            let (p, q) = (self.polygon[k], self.polygon[(k + 1) % self.polygon.len()]);
            let (sp, sq) = (side(p), side(q));
            if sp >= 0.0 {
                self.clipped.push(p);
            }
            if (sp < 0.0) != (sq < 0.0) && sp != sq {
                self.clipped.push(p + (q - p) * (sp / (sp - sq)));
            }
        }
        std::mem::swap(&mut self.polygon, &mut self.clipped);
    }
}

fn centroid(polygon: &[DVec2], least_double_area: f64) -> Option<DVec2> {
    let (&origin, rest) = polygon.split_first()?;
    let (mut double_area, mut sum) = (0.0, DVec2::ZERO);
    for pair in rest.windows(2) {
        let (p, q) = (pair[0] - origin, pair[1] - origin);
        let a = p.perp_dot(q);
        double_area += a;
        sum += (p + q) * (a / 3.0);
    }
    (double_area > least_double_area).then(|| origin + sum / double_area)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_of_a_square_is_the_square() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        assert!((Kernel::default().centroid(&square).unwrap() - DVec2::splat(0.5)).length() < 1e-15);
    }

    #[test]
    fn the_centroid_sees_every_side_of_an_arrow_head() {
        let arrow = [DVec2::ZERO, DVec2::new(2.0, 1.0), DVec2::new(4.0, 0.0), DVec2::new(2.0, 4.0)];
        let c = Kernel::default().centroid(&arrow).unwrap();
        for k in 0..4 {
            let (a, b) = (arrow[k], arrow[(k + 1) % 4]);
            assert!((b - a).perp_dot(c - a) > 0.0);
        }
    }

    #[test]
    fn a_spiral_has_no_kernel() {
        let z = [
            (0.0, 0.0),
            (3.0, 0.0),
            (3.0, 3.0),
            (0.0, 3.0),
            (0.0, 1.0),
            (1.0, 1.0),
            (1.0, 2.0),
            (2.0, 2.0),
            (2.0, 0.5),
            (0.0, 0.5),
        ];
        let z: Vec<_> = z.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
        assert!(Kernel::default().centroid(&z).is_none());
    }
}

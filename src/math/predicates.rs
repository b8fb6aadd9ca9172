//! Exact predicates (Shewchuk 1997).

use glam::DVec2;
use robust::Coord;

/// Positive where r lies to the left of the line from p to q, negative to the right, 0 on it: the sign is exact.
pub fn orient2d(p: DVec2, q: DVec2, r: DVec2) -> f64 {
    let [p, q, r] = [p, q, r].map(|c| Coord { x: c.x, y: c.y });
    robust::orient2d(p, q, r)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_is_exact_where_the_formula_rounds() {
        let tiny = f64::EPSILON;
        let (p, q) = (DVec2::new(0.5, 0.5), DVec2::new(12.0, 12.0));
        assert_eq!(orient2d(p, q, DVec2::splat(24.0)), 0.0);
        assert!(orient2d(p, q, DVec2::new(24.0, 24.0 + 24.0 * tiny)) > 0.0);
        assert!(orient2d(p, q, DVec2::new(0.5 + tiny, 0.5)) < 0.0);
    }
}

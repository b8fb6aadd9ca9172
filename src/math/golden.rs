//! Directions that are scattered evenly.

use super::scalar::{cos, sin};
use glam::DVec2;

/// The unit vector at `step` times the golden angle. The vectors of consecutive steps are scattered evenly over the circle.
pub fn direction(step: usize) -> DVec2 {
    // The golden angle, pi (3 - sqrt 5), in radians.
    const GOLDEN: f64 = 2.399_963_229_728_653;
    // Large angles lose digits, so steps repeat.
    let angle = GOLDEN * (step % 1_000_003) as f64;
    DVec2::new(cos(angle), sin(angle))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundred_directions_leave_no_wide_gap() {
        let all: Vec<DVec2> = (0..100).map(direction).collect();
        for k in 0..360 {
            let angle = f64::from(k).to_radians();
            let there = DVec2::new(cos(angle), sin(angle));
            assert!(all.iter().any(|d| d.dot(there) > cos(0.06)));
        }
    }
}

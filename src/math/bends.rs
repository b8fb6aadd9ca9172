//! Ways that are bent: a straight line and what a polynomial adds to it that vanishes at both ends.
//!
//! The polynomial is given by its values at the times [`KEYS`], and is their combination with the weights of [`weights`]. So drawing a way
//! needs a point for each key, and the weights of a moment are the same for all points.

/// The times between 0, the beginning, and 1, the end, at which a bend is given.
pub const KEYS: [f64; 3] = [0.25, 0.5, 0.75];

/// The weights of the values at the keys at a time from 0 to 1: Lagrange's polynomials for 0, the keys and 1, without those of both ends,
/// where a bend is 0.
pub fn weights(time: f64) -> [f64; KEYS.len()] {
    let mut weights = [0.0; KEYS.len()];
    for (k, weight) in weights.iter_mut().enumerate() {
        let ends = time * (1.0 - time) / (KEYS[k] * (1.0 - KEYS[k]));
        let others = (0..KEYS.len()).filter(|&j| j != k);
        *weight = others.fold(ends, |product, j| product * (time - KEYS[j]) / (KEYS[k] - KEYS[j]));
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_that_vanish_at_both_ends_come_back() {
        let bend = |t: f64| t * (1.0 - t) * (2.0 - 3.0 * t + 5.0 * t * t);
        for time in [0.0, 0.1, 0.25, 0.5, 0.6, 0.75, 0.9, 1.0] {
            let sum: f64 = weights(time).iter().zip(KEYS).map(|(w, key)| w * bend(key)).sum();
            assert!((sum - bend(time)).abs() < 1e-14, "{time}");
        }
        assert_eq!([weights(0.0), weights(1.0)], [[0.0; 3]; 2]);
    }
}

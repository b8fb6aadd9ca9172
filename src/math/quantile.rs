//! Quantiles of weighted values.

/// The weighted quantile of sorted (value, weight) pairs; not a number where there are none.
pub fn quantile(sorted: &[(f64, f64)], share: f64) -> f64 {
    let total: f64 = sorted.iter().map(|p| p.1).sum();
    let mut sum = 0.0;
    for (value, weight) in sorted {
        sum += weight;
        if sum >= share * total {
            return *value;
        }
    }
    sorted.last().map_or(f64::NAN, |p| p.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heavy_values_hold_many_quantiles() {
        let sorted = [(1.0, 1.0), (2.0, 8.0), (5.0, 1.0)];
        assert_eq!(
            [0.0, 0.05, 0.2, 0.5, 0.9, 0.95, 1.0].map(|share| quantile(&sorted, share)),
            [1.0, 1.0, 2.0, 2.0, 2.0, 5.0, 5.0]
        );
        assert!(quantile(&[], 0.5).is_nan());
    }
}

//! Quantiles of weighted values.

/// A value that counts by its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// The value.
    pub value: f64,
    /// Its weight, not negative.
    pub weight: f64,
}

/// Sorts by value, the least first.
pub fn sort_by_value(values: &mut [Weighted]) {
    values.sort_by(|a, b| a.value.total_cmp(&b.value));
}

/// The weighted quantile of sorted values; not a number where there are none.
pub fn quantile(sorted: &[Weighted], share: f64) -> f64 {
    let total: f64 = sorted.iter().map(|p| p.weight).sum();
    let mut sum = 0.0;
    for Weighted { value, weight } in sorted {
        sum += weight;
        if sum >= share * total {
            return *value;
        }
    }
    sorted.last().map_or(f64::NAN, |p| p.value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heavy_values_hold_many_quantiles() {
        let mut sorted =
            [(5.0, 1.0), (1.0, 1.0), (2.0, 8.0)].map(|(value, weight)| Weighted { value, weight });
        sort_by_value(&mut sorted);
        assert_eq!(
            [0.0, 0.05, 0.2, 0.5, 0.9, 0.95, 1.0].map(|share| quantile(&sorted, share)),
            [1.0, 1.0, 2.0, 2.0, 2.0, 5.0, 5.0]
        );
        assert!(quantile(&[], 0.5).is_nan());
    }
}

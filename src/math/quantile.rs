//! Quantiles of weighted values.

/// A value that counts by its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// The value.
    pub value: f64,
    /// Its weight, not negative.
    pub weight: f64,
}

/// Values that are sorted between two questions: some milliseconds.
const ASKED_EVERY: usize = 1 << 16;

/// Sorts by value, the least first.
pub fn sort_by_value(values: &mut [Weighted]) {
    values.sort_by(|a, b| a.value.total_cmp(&b.value));
}

/// The same, and asks now and then whether to go on.
///
/// # Errors
/// That of `ask`; the values are then in any order.
pub fn sort_asking<E>(values: &mut [Weighted], mut ask: impl FnMut() -> Result<(), E>) -> Result<(), E> {
    for part in values.chunks_mut(ASKED_EVERY) {
        sort_by_value(part);
        ask()?;
    }
    // Stable, as the parts were: the same order as at once, and quick, since it only merges runs.
    sort_by_value(values);
    Ok(())
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

    #[test]
    fn a_long_sort_asks_and_orders_as_one_at_once() {
        let of = |k: usize| Weighted { value: (k * 7919 % 1000) as f64, weight: k as f64 };
        let mut values: Vec<Weighted> = (0..3 * ASKED_EVERY + 5).map(of).collect();
        let mut at_once = values.clone();
        at_once.sort_by(|a, b| a.value.total_cmp(&b.value));
        let mut asked = 0;
        sort_asking(&mut values, || {
            asked += 1;
            Ok::<_, ()>(())
        })
        .unwrap();
        assert_eq!((asked, values == at_once), (4, true));
        assert_eq!(sort_asking(&mut values, || Err("stop")), Err("stop"));
    }
}

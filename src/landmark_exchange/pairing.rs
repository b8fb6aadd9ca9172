//! Which landmark of the source belongs to which of the target.

use super::problem::ExchangeError;
use super::projection::PlacedMark;
use rustc_hash::FxHashMap;

/// The partners, as numbers into both lists, in the order of the source.
pub(super) struct Partners {
    pub(super) numbers: Vec<[usize; 2]>,
    /// Whether the order paired landmarks with different labels.
    pub(super) labels_differ: bool,
}

/// At most so many labels are named in an error.
const NAMED: usize = 5;

/// Pairs two lists: by label where both have the same labels, each once, or else by order where they are equally long.
pub(super) fn partners(source: &[PlacedMark], target: &[PlacedMark]) -> Result<Partners, ExchangeError> {
    let by_label = [source, target].map(numbers_by_label);
    if let [Some(in_source), Some(in_target)] = &by_label
        && in_source.len() == in_target.len()
    {
        let partner =
            |(number, mark): (usize, &PlacedMark)| Some([number, *in_target.get(mark.label.as_str())?]);
        let numbers: Option<Vec<_>> = source.iter().enumerate().map(partner).collect();
        if let Some(numbers) = numbers {
            return Ok(Partners { numbers, labels_differ: false });
        }
    }
    if source.len() == target.len() {
        let numbers = (0..source.len()).map(|number| [number, number]).collect();
        let differ = |(a, b): (&PlacedMark, &PlacedMark)| {
            !a.label.is_empty() && !b.label.is_empty() && a.label != b.label
        };
        return Ok(Partners { numbers, labels_differ: source.iter().zip(target).any(differ) });
    }
    let only = |list: &[PlacedMark], other: &[PlacedMark]| {
        let known: std::collections::BTreeSet<_> = other.iter().map(|mark| mark.label.as_str()).collect();
        let alone = list.iter().filter(|mark| !mark.label.is_empty() && !known.contains(mark.label.as_str()));
        alone.take(NAMED).map(|mark| mark.label.chars().take(60).collect()).collect()
    };
    Err(ExchangeError::Unpaired {
        counts: [source.len(), target.len()],
        unpaired: [only(source, target), only(target, source)],
    })
}

/// The number of each label; `None` where one is empty or there twice.
fn numbers_by_label(marks: &[PlacedMark]) -> Option<FxHashMap<&str, usize>> {
    let mut numbers = FxHashMap::default();
    for (number, mark) in marks.iter().enumerate() {
        if mark.label.is_empty() || numbers.insert(mark.label.as_str(), number).is_some() {
            return None;
        }
    }
    Some(numbers)
}

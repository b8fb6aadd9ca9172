//! The assignments that take left and right of one body to those of the other.
//!
//! Where both bodies have a reflection there are few of these, so all are tried, however different the proportions of the bodies are.

use super::reflection::Reflection;
use super::search::{Assignment, Tables};

/// The assignments that take partners to partners and the middle line to the middle line, the cheapest first: of those that differ only in
/// left and right, the cheapest one. The given pairs come first in each. One tip on the middle line may have no partner, without cost.
pub(super) fn equivariant(tables: &Tables<'_>, reflections: [&Reflection; 2]) -> Vec<Assignment> {
    let given: Vec<[usize; 2]> = (0..tables.shapes[0].given).map(|k| [k, k]).collect();
    let [source, target] = reflections;
    let pairings = injections(source.pairs.len(), target.pairs.len(), 0);
    let middles = injections(source.middle.len(), target.middle.len(), 1);
    let mut found = Vec::new();
    for pairing in &pairings {
        for middle in &middles {
            let on_middle = middle.iter().map(|&[s, t]| [source.middle[s], target.middle[t]]);
            let fixed: Vec<[usize; 2]> = given.iter().copied().chain(on_middle).collect();
            let turns = (0..1_usize << pairing.len()).map(|turned| {
                let swap = |k: usize, flank: usize| flank ^ (turned >> k & 1);
                let both = pairing.iter().enumerate().flat_map(|(k, &[s, t])| {
                    [0, 1].map(|flank| [source.pairs[s][flank], target.pairs[t][swap(k, flank)]])
                });
                tables.assignment(&fixed.iter().copied().chain(both).collect::<Vec<_>>())
            });
            found.extend(turns.min_by(|a, b| a.full_cost().total_cmp(&b.full_cost())));
        }
    }
    // A limb that only one body has costs nothing.
    let is_rest = |a: &Assignment| a.unmatched.contains(&0);
    let cost = |a: &Assignment| a.full_cost() - if is_rest(a) { a.unmatched_cost } else { 0.0 };
    found.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    found
}

/// All injections of the smaller set into the larger one, and those in which up to `missing` elements of the smaller set have no image.
fn injections(sources: usize, targets: usize, missing: usize) -> Vec<Vec<[usize; 2]>> {
    let least = sources.min(targets).saturating_sub(missing);
    let mut all: Vec<Vec<[usize; 2]>> = vec![Vec::new()];
    for s in 0..sources {
        let longer = all.iter().flat_map(|pairs| {
            let free = (0..targets).filter(|t| pairs.iter().all(|pair| pair[1] != *t));
            free.map(|t| pairs.iter().copied().chain([[s, t]]).collect::<Vec<_>>())
        });
        let longer: Vec<Vec<[usize; 2]>> = longer.collect();
        all.extend(longer);
    }
    all.retain(|pairs| pairs.len() >= least);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_give_partners_is_there_once() {
        assert_eq!(injections(2, 2, 0), [vec![[0, 0], [1, 1]], vec![[0, 1], [1, 0]]]);
        // Two ways with both, four with one.
        assert_eq!(injections(2, 2, 1).len(), 6);
        assert_eq!(injections(1, 3, 0).len(), 3);
        assert_eq!(injections(0, 2, 1), [Vec::<[usize; 2]>::new()]);
    }
}

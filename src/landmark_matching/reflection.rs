//! Reflections of a body, which tell its left and right, found from its main tips.
//!
//! A reflection of the body takes each main tip to its partner on the other side or, on the middle line, to itself; it keeps distances and
//! reverses the orders in which shortest paths lead to the tips. There are few ways to pair the tips, so the best is found by trying
//! all of them.

use super::orders::orders;
use super::shape::Shape;
use crate::math::scalar::{ln, min};
use std::cmp::Reverse;

/// Largest number of main tips for which reflections are searched: ten can be paired in 9,496 ways.
const MOST_TIPS: usize = 10;
/// Largest number of main tips for which a lesser tip may be the partner of one: with eight and six lesser ones there are 11,136 more ways.
const MOST_TIPS_WITH_LESSER: usize = 8;
/// Weight of the share of orders that are not reversed, beside the mean log ratio of distances: as in the search for assignments.
const ORDERS: f64 = 0.3;
/// Largest cost of a reflection. The right ones of sixteen animals cost 0.004 to 0.2, the next best ones 0.11 to 0.3; a wrong one only
/// costs the time of candidates whose maps are worse.
const MOST_COST: f64 = 0.25;
/// Reflections that cost no more than this beyond the best are kept: with a twin of lesser persistence right ones cost 0.00 to 0.01 beyond
/// it on a deer, a cow and two more, those with ears of which only one is found 0.03 and more.
const NEARLY: f64 = 0.02;
/// Reflections that are kept, at most. Chosen by hand.
const REFLECTIONS: usize = 2;
/// A lesser tip is on the middle line where the mean log ratio of its distances to partners is below this: reflections of whole bodies
/// have such means.
const ON_MIDDLE: f64 = 0.06;
/// Lesser tips on the middle line, at most: the most persistent. Chosen by hand.
const LESSER_ON_MIDDLE: usize = 2;
/// A log ratio of distances above this counts as this. Chosen by hand.
const MOST_RATIO: f64 = 1.0;

/// A reflection of a body: its main tips as pairs of partners and single ones on the middle line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reflection {
    /// Partners: left and right, in no order.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Tips on the middle line.
    pub(super) middle: Vec<usize>,
}

impl Reflection {
    /// The reflections of a body's main tips with at least one pair, the best first; none where none fits.
    ///
    /// Of two horns only one is a main tip, since the pass between them is high, and the nose is lesser than both: so one main tip may
    /// have a lesser one as its partner, and then lesser ones on the middle line count, too.
    pub(super) fn all_of(shape: &Shape, main: &[usize]) -> Vec<Self> {
        if main.len() > MOST_TIPS {
            return Vec::new();
        }
        let is_lesser = |k: &usize| !main.contains(k) && main.len() <= MOST_TIPS_WITH_LESSER;
        let lesser: Vec<usize> = shape.tips().filter(is_lesser).collect();
        let none = Self { pairs: Vec::new(), middle: Vec::new() };
        let mut all = Vec::new();
        none.extend(main, &mut all);
        for (k, &of) in main.iter().enumerate() {
            let others: Vec<usize> = [&main[..k], &main[k + 1..]].concat();
            for &twin in &lesser {
                Self { pairs: vec![[of, twin]], middle: Vec::new() }.extend(&others, &mut all);
            }
        }
        all.retain(|reflection| !reflection.pairs.is_empty());
        let mut costs: Vec<(f64, Self)> = all.into_iter().map(|r| (r.cost(shape), r)).collect();
        costs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(least) = costs.first().map(|best| best.0).filter(|least| *least < MOST_COST) else {
            return Vec::new();
        };
        costs.retain(|reflection| reflection.0 < least + NEARLY);
        // A man's hands are nearly as far from both feet, so that his feet might as well lie on the middle line.
        let limbs = |reflection: &Self| {
            reflection.pairs.iter().filter(|pair| pair.iter().all(|k| main.contains(k))).count()
        };
        costs.sort_by_key(|reflection| Reverse(limbs(&reflection.1)));
        let with_lesser = |reflection: Self| {
            let is_twin = reflection.pairs.iter().flatten().any(|k| lesser.contains(k));
            if is_twin { reflection.with_middle(shape, &lesser) } else { reflection }
        };
        costs.into_iter().take(REFLECTIONS).map(|(_, reflection)| with_lesser(reflection)).collect()
    }

    /// The reflection with each tip replaced by the one that stands for its place.
    pub(super) fn of_places(&self, places: &[usize]) -> Self {
        let pairs = self.pairs.iter().map(|pair| pair.map(|k| places[k])).collect();
        Self { pairs, middle: self.middle.iter().map(|&k| places[k]).collect() }
    }

    /// Adds the lesser tips that lie on the middle line.
    fn with_middle(mut self, shape: &Shape, lesser: &[usize]) -> Self {
        let is_free = |k: &usize| self.pairs.iter().flatten().all(|other| other != k);
        let off_middle = |k: usize| {
            let ratio =
                |&[a, b]: &[usize; 2]| (ln(shape.distance([k, a])) - ln(shape.distance([k, b]))).abs();
            self.pairs.iter().map(ratio).sum::<f64>() / self.pairs.len() as f64
        };
        let on_middle = lesser.iter().copied().filter(is_free).filter(|&k| off_middle(k) < ON_MIDDLE);
        let on_middle: Vec<usize> = on_middle.take(LESSER_ON_MIDDLE).collect();
        self.middle.extend(on_middle);
        self
    }

    /// Adds to `all` every reflection that pairs the tips `left` or leaves them on the middle line.
    fn extend(self, left: &[usize], all: &mut Vec<Self>) {
        let Some((&first, rest)) = left.split_first() else {
            all.push(self);
            return;
        };
        for (k, &partner) in rest.iter().enumerate() {
            let mut next = self.clone();
            next.pairs.push([first, partner]);
            let others: Vec<usize> = [&rest[..k], &rest[k + 1..]].concat();
            next.extend(&others, all);
        }
        let mut next = self;
        next.middle.push(first);
        next.extend(rest, all);
    }

    /// The image of a tip; `None` where it is not known.
    fn image(&self, tip: usize) -> Option<usize> {
        self.images().into_iter().find(|image| image[0] == tip).map(|image| image[1])
    }

    /// Each tip with its image.
    fn images(&self) -> Vec<[usize; 2]> {
        let swapped = self.pairs.iter().flat_map(|&[a, b]| [[a, b], [b, a]]);
        swapped.chain(self.middle.iter().map(|&a| [a, a])).collect()
    }

    /// The cost of a reflection: log ratios of distances, differences of descriptors, orders that are not reversed; 0 for a perfect one.
    fn cost(&self, shape: &Shape) -> f64 {
        let images = self.images();
        let ratio = |[a, x]: [usize; 2], [b, y]: [usize; 2]| {
            min((ln(shape.distance([a, b])) - ln(shape.distance([x, y]))).abs(), MOST_RATIO)
        };
        let (mut sum, mut count) = (0.0, 0);
        for (k, &one) in images.iter().enumerate() {
            for &other in images[..k].iter().filter(|other| **other != [one[1], one[0]]) {
                sum += ratio(one, other);
                count += 1;
            }
        }
        let difference = |&[a, b]: &[usize; 2]| shape.marks[a].difference(&shape.marks[b]);
        let differences: f64 = self.pairs.iter().map(difference).sum();
        sum / f64::from(count.max(1))
            + differences / self.pairs.len() as f64
            + ORDERS * orders([shape, shape], &images).kept
    }
}

/// Whether pairs take left and right of one body to left and right of the other, by any of their reflections.
pub(super) fn keeps_sides(reflections: [&[Reflection]; 2], pairs: &[[usize; 2]]) -> bool {
    let onto = |s: usize| pairs.iter().find(|pair| pair[0] == s).map(|pair| pair[1]);
    let from = |t: usize| pairs.iter().find(|pair| pair[1] == t).map(|pair| pair[0]);
    let keeps = |source: &Reflection, target: &Reflection| {
        pairs.iter().all(|&[s, t]| match (source.image(s), target.image(t)) {
            (Some(x), Some(y)) => {
                (x == s) == (y == t) && onto(x).is_none_or(|t| t == y) && from(y).is_none_or(|s| s == x)
            }
            // A small tip that is not in the reflection may be that of a head or a tail.
            (Some(x), None) => x == s,
            (None, Some(y)) => y == t,
            (None, None) => true,
        })
    };
    reflections[0].iter().any(|source| reflections[1].iter().any(|target| keeps(source, target)))
}

#[cfg(test)]
mod tests {
    use super::super::options::MatchOptions;
    use super::super::test_bodies::{four_footed, shape};
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_partners_of_a_body_are_mirror_images() {
        let mesh = four_footed();
        let shape = shape(&mesh);
        let reflection = Reflection::all_of(&shape, &shape.main(&MatchOptions::default())).remove(0);
        let place = |mark: usize| mesh.positions()[shape.on_mesh(shape.marks[mark].vertex)];
        assert_eq!((reflection.pairs.len(), reflection.middle.len()), (2, 2), "{reflection:?}");
        for [a, b] in reflection.pairs {
            assert!(
                place(a).distance(place(b) * DVec3::new(1.0, -1.0, 1.0)) < 0.2,
                "{} {}",
                place(a),
                place(b)
            );
        }
        assert!(reflection.middle.iter().all(|&mark| place(mark).y.abs() < 0.2));
    }

    #[test]
    fn partners_go_to_partners_and_the_middle_to_the_middle() {
        let body = [Reflection { pairs: vec![[0, 1], [2, 3]], middle: vec![4] }];
        let keeps = |pairs: &[[usize; 2]]| keeps_sides([&body, &body], pairs);
        assert!(keeps(&[[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]]));
        // The mirror image, fore and hind limbs exchanged, a limb left over, a small end on the middle line.
        assert!(keeps(&[[0, 1], [1, 0], [2, 3], [3, 2]]));
        assert!(keeps(&[[0, 2], [1, 3], [2, 0], [3, 1]]));
        assert!(keeps(&[[0, 0], [2, 2], [3, 3], [4, 7]]));
        // A limb on the middle line, one of both partners elsewhere, a small end as a limb.
        assert!(!keeps(&[[0, 4]]));
        assert!(!keeps(&[[0, 0], [1, 2]]));
        assert!(!keeps(&[[0, 7], [1, 1]]));
        assert!(!keeps_sides([&body, &[]], &[[4, 4]]));
    }

    #[test]
    fn any_toe_is_the_foot() {
        let body = [Reflection { pairs: vec![[0, 1], [2, 3]], middle: vec![4] }];
        // A second toe of each of two feet, the left and the right.
        let places = [0, 1, 2, 3, 4, 1, 2];
        let of_places = |pairs: &[[usize; 2]]| -> Vec<[usize; 2]> {
            pairs.iter().map(|pair| pair.map(|k| places[k])).collect()
        };
        let keeps = |pairs: &[[usize; 2]]| {
            let of_feet = [body[0].of_places(&places)];
            keeps_sides([&of_feet, &of_feet], &of_places(pairs))
        };
        let pairs = [[0, 0], [1, 5], [2, 6], [3, 3], [4, 4]];
        assert!(keeps(&pairs) && !keeps_sides([&body, &body], &pairs));
        assert!(keeps(&[[5, 1], [0, 0]]) && keeps(&[[5, 0], [0, 5]]));
        assert!(!keeps(&[[0, 0], [5, 3]]) && !keeps(&[[5, 4]]));
    }

    #[test]
    fn every_way_to_pair_is_tried_once() {
        let mut all = Vec::new();
        Reflection { pairs: Vec::new(), middle: Vec::new() }.extend(&[0, 1, 2, 3], &mut all);
        // The involutions of four.
        assert_eq!(all.len(), 10);
        assert!(all.iter().all(|r| 2 * r.pairs.len() + r.middle.len() == 4));
    }
}

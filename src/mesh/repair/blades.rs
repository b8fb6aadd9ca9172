//! The pairs in which halfedges around an edge with many faces belong together.
//!
//! The flattest pair of those that are left is taken again and again. Halfedges of one direction and angle are a group, of which the
//! first is always taken; each group knows its best partner, which is looked for anew only when it has come to be the best of all. So
//! memory grows with the number of halfedges, not with that of pairs.

use crate::math::min_queue::{MinQueue, Queued};
use std::cmp::Ordering;
use std::collections::VecDeque;
use std::f64::consts::PI;

/// A halfedge at an edge, seen along the edge.
pub(super) struct Blade {
    pub halfedge: u32,
    /// Direction in which its face leaves the edge, in radians around it.
    pub angle: f64,
    /// Whether it runs from the edge's first end to the second: its inner side is towards lesser angles then.
    pub is_forward: bool,
}

/// Each backward halfedge with the forward halfedge that closes its wedge, like brackets on a circle.
pub(super) fn wedges(blades: &[Blade]) -> Vec<[u32; 2]> {
    let (mut open, mut pairs) = (Vec::new(), Vec::new());
    let (mut opened, mut closed) = (vec![false; blades.len()], vec![false; blades.len()]);
    // The second round closes what the first has left open.
    for (k, blade) in blades.iter().enumerate().chain(blades.iter().enumerate()) {
        if closed[k] {
            continue;
        }
        if !blade.is_forward && !opened[k] {
            opened[k] = true;
            open.push(k);
        } else if blade.is_forward
            && let Some(partner) = open.pop()
        {
            closed[k] = true;
            closed[partner] = true;
            pairs.push([blades[partner].halfedge, blade.halfedge]);
        }
    }
    pairs
}

/// Pairs of halfedges that run in opposite directions, the flattest first; of blades in the order of angles and halfedges.
pub(super) fn flattest(blades: &[Blade]) -> Vec<[u32; 2]> {
    let mut sides = [true, false].map(|is_forward| Side::new(blades, is_forward));
    let mut queue: MinQueue<[u32; 2], [usize; 2]> = MinQueue::default();
    let offer = |sides: &mut [Side; 2], queue: &mut MinQueue<_, _>, [side, group]: [usize; 2]| {
        if let Some(best) = best(sides, side, group) {
            queue.push(best.flatness, best.pair, [side, group]);
        }
    };
    for side in [0, 1] {
        (0..sides[side].groups.len()).for_each(|group| offer(&mut sides, &mut queue, [side, group]));
    }
    let mut pairs = Vec::new();
    while let Some(Queued { cost, key, value: [side, group] }) = queue.pop() {
        let Some(best) = best(&mut sides, side, group) else { continue };
        // Others have taken its partner, where its best is another one now.
        if best.pair == key && best.flatness.total_cmp(&cost).is_eq() {
            pairs.push(key);
            sides[side].take(group);
            sides[1 - side].take(best.group);
        }
        offer(&mut sides, &mut queue, [side, group]);
    }
    pairs
}

/// A partner of a group.
struct Partner {
    /// How far both faces together are from flat, in radians.
    flatness: f64,
    /// Their halfedges, the one of lesser angle first.
    pair: [u32; 2],
    /// The group of the partner.
    group: usize,
}

impl Partner {
    fn order(&self, other: &Self) -> Ordering {
        self.flatness.total_cmp(&other.flatness).then(self.pair.cmp(&other.pair))
    }
}

/// The flattest partner that is left among those that follow a group.
fn best(sides: &mut [Side; 2], side: usize, group: usize) -> Option<Partner> {
    let Group { angle, ref halfedges } = sides[side].groups[group];
    let own = *halfedges.front()?;
    let others = &mut sides[1 - side];
    // Of two groups of one angle that of forward halfedges has the pair.
    let comes_before = |other: &Group| match other.angle.total_cmp(&angle) {
        Ordering::Less => true,
        Ordering::Equal => side == 1,
        Ordering::Greater => false,
    };
    let first = others.groups.partition_point(comes_before);
    let middle = others.groups.partition_point(|other| other.angle - angle < PI).max(first);
    let mut best: Option<Partner> = None;
    // Partners are less and less flat away from the middle on either side.
    for way in [Way::Up, Way::Down] {
        let mut next = others.left(middle, way);
        while let Some(number) = next.filter(|number| *number >= first) {
            let other = &others.groups[number];
            let halfedge = *other.halfedges.front()?;
            let is_turned = other.angle.total_cmp(&angle).is_eq() && halfedge < own;
            let pair = if is_turned { [halfedge, own] } else { [own, halfedge] };
            let found = Partner { flatness: ((other.angle - angle) - PI).abs(), pair, group: number };
            match &best {
                Some(best) if found.flatness > best.flatness => break,
                Some(best) if found.order(best).is_ge() => {}
                _ => best = Some(found),
            }
            next = match way {
                Way::Up => others.left(number + 1, way),
                Way::Down => others.left(number, way),
            };
        }
    }
    best
}

/// Halfedges of one direction and angle, rising.
struct Group {
    angle: f64,
    halfedges: VecDeque<u32>,
}

/// The groups of one direction, in the order of angles.
struct Side {
    groups: Vec<Group>,
    /// From each number up to the first group from it on that is not used up; one more than groups.
    up: Vec<usize>,
    /// From each number down to the first one below whose predecessor is a group that is not used up, or to 0.
    down: Vec<usize>,
}

#[derive(Clone, Copy)]
enum Way {
    Up,
    Down,
}

impl Side {
    fn new(blades: &[Blade], is_forward: bool) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        for blade in blades.iter().filter(|blade| blade.is_forward == is_forward) {
            match groups.last_mut().filter(|last| last.angle.total_cmp(&blade.angle).is_eq()) {
                Some(last) => last.halfedges.push_back(blade.halfedge),
                None => groups.push(Group { angle: blade.angle, halfedges: [blade.halfedge].into() }),
            }
        }
        let (up, down) = ((0..=groups.len()).collect(), (0..=groups.len()).collect());
        Self { groups, up, down }
    }

    /// The first group that is left: from a number up, or below it.
    fn left(&mut self, from: usize, way: Way) -> Option<usize> {
        match way {
            Way::Up => Some(end(&mut self.up, from)).filter(|k| *k < self.groups.len()),
            Way::Down => end(&mut self.down, from).checked_sub(1),
        }
    }

    /// Takes the first halfedge of a group.
    fn take(&mut self, group: usize) {
        let halfedges = &mut self.groups[group].halfedges;
        halfedges.pop_front();
        if halfedges.is_empty() {
            self.up[group] = group + 1;
            self.down[group + 1] = group;
        }
    }
}

/// The end of a chain of links, which become shorter on the way.
fn end(links: &mut [usize], mut k: usize) -> usize {
    while links[k] != k {
        links[k] = links[links[k]];
        k = links[k];
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;
    use std::f64::consts::TAU;

    fn sorted(mut blades: Vec<Blade>) -> Vec<Blade> {
        blades.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.halfedge.cmp(&b.halfedge)));
        blades
    }

    /// Halfedges at random; their angles are multiples of a step, or any where it is 0.
    fn random(seed: u64, count: u32, step: f64) -> Vec<Blade> {
        let mut random = SplitMix::new(seed);
        let mut blade = |halfedge| {
            let angle = TAU * (random.unit() - 0.5);
            let angle = if step > 0.0 { (angle / step).round() * step } else { angle };
            Blade { halfedge: halfedge * 7 % 1009, angle, is_forward: random.unit() < 0.4 }
        };
        sorted((0..count).map(&mut blade).collect())
    }

    /// All pairs, sorted.
    fn flattest_of_all(blades: &[Blade]) -> Vec<[u32; 2]> {
        let mut all = Vec::new();
        for (i, a) in blades.iter().enumerate() {
            for b in blades[i + 1..].iter().filter(|b| b.is_forward != a.is_forward) {
                all.push((((b.angle - a.angle) - PI).abs(), [a.halfedge, b.halfedge]));
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        for (_, pair) in all {
            if !pairs.iter().flatten().any(|h| pair.contains(h)) {
                pairs.push(pair);
            }
        }
        pairs
    }

    #[test]
    fn pairs_are_those_of_all_that_are_flattest() {
        for seed in 0..200 {
            for step in [0.0, TAU / 12.0, TAU / 8.0, TAU / 5.0, TAU / 2.0, 1e-16] {
                let blades = random(seed, 3 + (seed % 40) as u32, step);
                assert_eq!(flattest(&blades), flattest_of_all(&blades), "{seed} {step}");
            }
        }
    }

    #[test]
    fn very_many_faces_at_one_edge_are_paired() {
        for step in [0.0, TAU / 4.0, TAU / 100.0] {
            let mut blades = random(1, 300_000, step);
            let numbers = 0..blades.len() as u32;
            blades.iter_mut().zip(numbers).for_each(|(blade, number)| blade.halfedge = number);
            let forward = blades.iter().filter(|blade| blade.is_forward).count();
            assert_eq!(flattest(&sorted(blades)).len(), forward, "{step}");
        }
    }
}

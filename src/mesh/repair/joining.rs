//! Vertices at one place become one, along open edges.
//!
//! Elsewhere the surface is closed, and two vertices at one place are two sheets that touch: they stay apart.

use super::draft::{Draft, edges};
use crate::math::disjoint_sets::DisjointSets;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The draft with vertices on open edges joined where they are within a distance of each other; 0 for exactly equal places.
pub(super) fn joined(draft: Draft, within: f64) -> Draft {
    let mut open: Vec<u32> = edges(&draft.faces)
        .iter()
        .filter(|edge| edge.halfedges.len() == 1)
        .flat_map(|edge| edge.ends)
        .collect();
    open.sort_unstable();
    open.dedup();
    let mut sets = DisjointSets::new(draft.positions.len());
    if within > 0.0 {
        join_near(&draft.positions, &open, within, &mut sets);
    } else {
        join_equal(&draft.positions, &open, &mut sets);
    }
    // The vertex with the least number stands for a set.
    let mut least: FxHashMap<usize, u32> = FxHashMap::default();
    let stands: FxHashMap<u32, u32> =
        open.iter().map(|&v| (v, *least.entry(sets.root(v as usize)).or_insert(v))).collect();
    let mut draft = draft;
    for v in draft.faces.iter_mut().flat_map(|face| &mut face.corners) {
        *v = stands.get(v).copied().unwrap_or(*v);
    }
    draft
}

fn join_equal(positions: &[DVec3], open: &[u32], sets: &mut DisjointSets) {
    let mut first_at = FxHashMap::default();
    for &v in open {
        // Adding 0 makes -0 and 0 the same bits.
        let key = (positions[v as usize] + DVec3::ZERO).to_array().map(f64::to_bits);
        let first = *first_at.entry(key).or_insert(v);
        sets.join(v as usize, first as usize);
    }
}

/// The side of a grid's cell in units of the distance: two vertices in one cell are within it.
const SIDE: f64 = 0.577;
/// Vertices within the distance are at most so many cells apart along each axis.
const APART: i64 = 2;

/// The vertices in a cell of the grid.
struct Cell {
    vertices: Vec<u32>,
    /// The box around them.
    low: DVec3,
    high: DVec3,
    /// Whether they are all joined.
    is_one: bool,
}

impl Cell {
    fn new(p: DVec3) -> Self {
        Self { vertices: Vec::new(), low: p, high: p, is_one: true }
    }

    fn push(&mut self, v: u32, p: DVec3) {
        self.vertices.push(v);
        (self.low, self.high) = (self.low.min(p), self.high.max(p));
    }

    /// The distance between the boxes of two cells.
    fn gap(&self, other: &Self) -> f64 {
        (other.low - self.high).max(self.low - other.high).max(DVec3::ZERO).length()
    }
}

/// Joins by a grid whose cells are so small that all in one are joined at once, however many they are.
fn join_near(positions: &[DVec3], open: &[u32], within: f64, sets: &mut DisjointSets) {
    // Cells beyond the range of i64 become one: more vertices are compared, and none is missed.
    let cell = |p: DVec3| (p / (SIDE * within)).floor().to_array().map(|x| x as i64);
    let mut number: FxHashMap<[i64; 3], usize> = FxHashMap::default();
    let mut cells: Vec<([i64; 3], Cell)> = Vec::new();
    for &v in open {
        let p = positions[v as usize];
        let at = cell(p);
        let number = *number.entry(at).or_insert_with(|| {
            cells.push((at, Cell::new(p)));
            cells.len() - 1
        });
        cells[number].1.push(v, p);
    }
    let mut joining = Joining { positions, within, sets };
    cells.iter_mut().for_each(|(_, cell)| joining.inside(cell));
    let width = 2 * APART + 1;
    for (k, (at, cell)) in cells.iter().enumerate() {
        for step in 0..width * width * width {
            let steps = [step % width, step / width % width, step / (width * width)];
            let beside = [0, 1, 2].map(|axis| at[axis].saturating_add(steps[axis] - APART));
            // Each pair is met from both of its cells.
            if let Some(&other) = number.get(&beside).filter(|other| **other < k) {
                joining.between(cell, &cells[other].1);
            }
        }
    }
}

/// Vertices that are being joined.
struct Joining<'a> {
    positions: &'a [DVec3],
    within: f64,
    sets: &'a mut DisjointSets,
}

impl Joining<'_> {
    /// Joins two vertices that are near enough.
    fn pair(&mut self, v: u32, w: u32) -> bool {
        let [p, q] = [v, w].map(|v| self.positions[v as usize]);
        let is_near = p.distance(q) <= self.within;
        if is_near {
            self.sets.join(v as usize, w as usize);
        }
        is_near
    }

    fn inside(&mut self, cell: &mut Cell) {
        for (k, &v) in cell.vertices.iter().enumerate().skip(1) {
            // Only where coordinates are too coarse for the distance, or beyond the range of cells, is the first one farther.
            if !self.pair(v, cell.vertices[0]) {
                cell.is_one = false;
                for &w in &cell.vertices[1..k] {
                    self.pair(v, w);
                }
            }
        }
    }

    fn between(&mut self, a: &Cell, b: &Cell) {
        let are_one = a.is_one && b.is_one;
        let is_joined = self.sets.root(a.vertices[0] as usize) == self.sets.root(b.vertices[0] as usize);
        if a.gap(b) > self.within || (are_one && is_joined) {
            return;
        }
        for &v in &a.vertices {
            for &w in &b.vertices {
                // One pair joins all of both.
                if self.pair(v, w) && are_one {
                    return;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    /// The sets of points within a distance of each other, by the least point of each.
    fn sets_of(positions: &[DVec3], within: f64) -> Vec<usize> {
        let open: Vec<u32> = (0..positions.len() as u32).collect();
        let mut sets = DisjointSets::new(positions.len());
        join_near(positions, &open, within, &mut sets);
        least(&mut sets, positions.len())
    }

    fn least(sets: &mut DisjointSets, count: usize) -> Vec<usize> {
        let mut least: FxHashMap<usize, usize> = FxHashMap::default();
        (0..count).map(|v| *least.entry(sets.root(v)).or_insert(v)).collect()
    }

    fn random(count: usize, size: f64) -> Vec<DVec3> {
        let mut random = SplitMix::new(1);
        let mut coordinate = || size * (random.unit() - 0.5);
        (0..count).map(|_| DVec3::new(coordinate(), coordinate(), coordinate())).collect()
    }

    #[test]
    fn what_is_within_the_distance_is_one_whatever_the_distance() {
        let points = random(300, 2.0);
        for within in [1e-300, 1e-17, 0.01, 0.1, 0.14, 0.2, 0.5, 4.0, 1e300] {
            let mut sets = DisjointSets::new(points.len());
            for (v, p) in points.iter().enumerate() {
                let near = |w: &usize| points[*w].distance(*p) <= within;
                for w in (0..v).filter(near) {
                    sets.join(v, w);
                }
            }
            assert_eq!(sets_of(&points, within), least(&mut sets, points.len()), "{within}");
        }
    }

    #[test]
    fn very_many_within_a_distance_are_joined_at_once() {
        let two = random(200_000, 1.0).into_iter().enumerate();
        let points: Vec<DVec3> = two.map(|(k, p)| p + DVec3::X * (k % 2) as f64 * 8.0).collect();
        for (within, count) in [(1e3, 1), (6.0, 2), (0.5, 2)] {
            let mut sets = sets_of(&points, within);
            sets.sort_unstable();
            sets.dedup();
            assert_eq!(sets.len(), count, "{within}");
        }
    }
}

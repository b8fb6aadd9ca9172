//! A loop filled with triangles that have no vertices but its own.
//!
//! The cap is the triangulation whose sharpest bend, also against the faces around the hole, is least, and among these the one of least
//! area (Liepa 2003), found by dynamic programming in a time that is cubic in the length of the loop. A longer loop is shortened first, by
//! cutting the ear with the shortest chord again and again, which needs memory in proportion to the loop only.

use crate::math::min_queue::MinQueue;
use crate::math::triangle;
use glam::DVec3;
use rustc_hash::FxHashSet;
use std::cmp::Ordering;

/// The loop of a hole.
pub(super) struct Rim<'a> {
    /// Places of its vertices.
    pub places: &'a [DVec3],
    /// Normal of the face beyond the edge from each vertex to the next; zero where there is none to go by.
    pub beyond: &'a [DVec3],
    /// Edges between vertices of the loop that the surface has, also those of the loop, the lesser first.
    pub taken: &'a FxHashSet<[u32; 2]>,
}

/// The length of the longest loop that is filled at best; the time grows with its cube.
const AT_BEST: usize = 160;

/// Triangles over a loop's vertices by their numbers along it; the number after the last is a vertex at `middle`.
#[derive(Debug)]
pub(super) struct Filling {
    /// The triangles, along the loop's direction.
    pub triangles: Vec<[u32; 3]>,
    /// A vertex in the middle, where the loop's own do not suffice.
    pub middle: Option<DVec3>,
}

/// Fills a loop of at least three vertices.
pub(super) fn filled(rim: &Rim<'_>) -> Filling {
    let mut triangles = Vec::new();
    let mut taken = rim.taken.clone();
    let left = without_ears(rim, &mut taken, &mut triangles);
    if let Some(rest) = best(rim, &taken, &left, &triangles) {
        triangles.extend(rest);
        return Filling { triangles, middle: None };
    }
    // A vertex of its own makes edges that nothing else has.
    let n = rim.places.len() as u32;
    let middle = left.iter().map(|&v| rim.places[v as usize]).sum::<DVec3>() / left.len() as f64;
    let around = (0..left.len()).map(|k| [left[k], left[(k + 1) % left.len()], n]);
    triangles.extend(around);
    Filling { triangles, middle: Some(middle) }
}

fn ends(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Whether a triangle has next to no height.
fn is_flat([p, q, r]: [DVec3; 3]) -> bool {
    let longest = p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p));
    triangle::area(p, q, r) <= 1e-9 * longest
}

/// Cuts ears off a long loop until it can be filled at best; what is left of it.
fn without_ears(rim: &Rim<'_>, taken: &mut FxHashSet<[u32; 2]>, triangles: &mut Vec<[u32; 3]>) -> Vec<u32> {
    let n = rim.places.len();
    let mut left = n;
    let (mut next, mut last): (Vec<usize>, Vec<usize>) =
        ((0..n).map(|v| (v + 1) % n).collect(), (0..n).map(|v| (v + n - 1) % n).collect());
    let mut is_there = vec![true; n];
    let chord = |a: usize, b: usize| rim.places[a].distance(rim.places[b]);
    let mut queue: MinQueue<usize, [usize; 2]> = MinQueue::default();
    if n > AT_BEST {
        (0..n).for_each(|v| queue.push(chord(last[v], next[v]), v, [last[v], next[v]]));
    }
    while left > AT_BEST
        && let Some(ear) = queue.pop()
    {
        let (v, [a, b]) = (ear.key, ear.value);
        if !is_there[v] || [last[v], next[v]] != [a, b] {
            continue;
        }
        let corners = [a, v, b].map(|v| rim.places[v]);
        if is_flat(corners) || !taken.insert(ends(a as u32, b as u32)) {
            continue;
        }
        triangles.push([a as u32, v as u32, b as u32]);
        is_there[v] = false;
        (next[a], last[b]) = (b, a);
        left -= 1;
        for w in [a, b] {
            queue.push(chord(last[w], next[w]), w, [last[w], next[w]]);
        }
    }
    (0..n as u32).filter(|&v| is_there[v as usize]).collect()
}

/// The cost of a triangulation: its flat triangles, its sharpest bend (1 - cosine), and its area, compared in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cost {
    flat: u32,
    bend: f64,
    area: f64,
}

impl Cost {
    const NOTHING: Self = Self { flat: 0, bend: 0.0, area: 0.0 };

    fn and(self, other: Self) -> Self {
        Self { flat: self.flat + other.flat, bend: self.bend.max(other.bend), area: self.area + other.area }
    }

    fn order(&self, other: &Self) -> Ordering {
        let by_bend = || self.bend.total_cmp(&other.bend);
        self.flat.cmp(&other.flat).then_with(by_bend).then_with(|| self.area.total_cmp(&other.area))
    }
}

/// The best triangulation of every stretch of a loop, between two of its vertices and their chord.
struct Stretches {
    n: usize,
    /// The cost by first and last vertex; `None` where there is no triangulation.
    cost: Vec<Option<Cost>>,
    /// The third vertex of the triangle at the chord.
    top: Vec<u32>,
}

/// The best triangles over what is left of a loop; `None` where every way needs an edge that the surface has.
fn best(
    rim: &Rim<'_>,
    taken: &FxHashSet<[u32; 2]>,
    left: &[u32],
    ears: &[[u32; 3]],
) -> Option<Vec<[u32; 3]>> {
    let n = left.len();
    let places: Vec<DVec3> = left.iter().map(|&v| rim.places[v as usize]).collect();
    if n > AT_BEST {
        return None;
    }
    let beyond = normals_beyond(rim, left, ears);
    let mut table = Stretches { n, cost: vec![None; n * n], top: vec![0; n * n] };
    (0..n - 1).for_each(|i| table.cost[i * n + i + 1] = Some(Cost::NOTHING));
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            let is_rim = length == n - 1;
            if is_rim || !taken.contains(&ends(left[i], left[j])) {
                let last = is_rim.then(|| beyond[n - 1]);
                table.fill(&places, &beyond, [i, j], last);
            }
        }
    }
    table.cost[n - 1]?;
    let mut triangles = Vec::with_capacity(n - 2);
    let mut stack = vec![(0, n - 1)];
    while let Some((i, j)) = stack.pop() {
        if j > i + 1 {
            let k = table.top[i * n + j] as usize;
            triangles.push([left[i], left[k], left[j]]);
            stack.extend([(i, k), (k, j)]);
        }
    }
    Some(triangles)
}

/// Normals of the faces beyond the edges of what is left of a loop: those of the surface, or of the ears that were cut.
fn normals_beyond(rim: &Rim<'_>, left: &[u32], ears: &[[u32; 3]]) -> Vec<DVec3> {
    let n = rim.places.len() as u32;
    let mut by_chord = rustc_hash::FxHashMap::default();
    for &[a, v, b] in ears {
        by_chord.insert([a, b], normal([a, v, b].map(|v| rim.places[v as usize])));
    }
    let beyond = |k: usize| {
        let [a, b] = [left[k], left[(k + 1) % left.len()]];
        let of_rim = || if b == (a + 1) % n { rim.beyond[a as usize] } else { DVec3::ZERO };
        by_chord.get(&[a, b]).copied().unwrap_or_else(of_rim)
    };
    (0..left.len()).map(beyond).collect()
}

fn normal([p, q, r]: [DVec3; 3]) -> DVec3 {
    (q - p).cross(r - p).normalize_or_zero()
}

/// 1 - cosine of the angle between two normals; none where one is not known.
fn bend(a: DVec3, b: DVec3) -> f64 {
    if a == DVec3::ZERO || b == DVec3::ZERO { 0.0 } else { 1.0 - a.dot(b) }
}

impl Stretches {
    /// Finds the best triangle at the chord from vertex i to vertex j; `last` is the normal beyond the chord where that is an edge of
    /// the loop.
    fn fill(&mut self, places: &[DVec3], beyond: &[DVec3], [i, j]: [usize; 2], last: Option<DVec3>) {
        let n = self.n;
        let mut found: Option<(Cost, usize)> = None;
        for k in i + 1..j {
            let (Some(before), Some(after)) = (self.cost[i * n + k], self.cost[k * n + j]) else { continue };
            let corners = [places[i], places[k], places[j]];
            let normal = normal(corners);
            let at = |a: usize, b: usize| {
                let outside = if b == a + 1 { beyond[a] } else { self.normal_at(places, a, b) };
                bend(normal, outside)
            };
            let sharpest = at(i, k).max(at(k, j)).max(last.map_or(0.0, |last| bend(normal, last)));
            let own = Cost {
                flat: u32::from(is_flat(corners)),
                bend: sharpest,
                area: triangle::area(corners[0], corners[1], corners[2]),
            };
            let cost = before.and(after).and(own);
            if found.is_none_or(|(best, _)| cost.order(&best) == Ordering::Less) {
                found = Some((cost, k));
            }
        }
        if let Some((cost, k)) = found {
            self.cost[i * n + j] = Some(cost);
            self.top[i * n + j] = k as u32;
        }
    }

    /// Normal of the triangle at a chord.
    fn normal_at(&self, places: &[DVec3], i: usize, j: usize) -> DVec3 {
        normal([places[i], places[self.top[i * self.n + j] as usize], places[j]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scalar::{cos, sin};
    use std::f64::consts::TAU;

    fn circle(n: usize, wave: f64) -> Vec<DVec3> {
        let at = |k: usize| {
            let a = TAU * k as f64 / n as f64;
            DVec3::new(cos(a), sin(a), wave * cos(3.0 * a))
        };
        (0..n).map(at).collect()
    }

    fn rim_edges(n: usize) -> FxHashSet<[u32; 2]> {
        (0..n as u32).map(|v| ends(v, (v + 1) % n as u32)).collect()
    }

    /// Every edge of the loop has one triangle along its direction, every other edge two that oppose each other.
    fn fills(triangles: &[[u32; 3]], n: u32) {
        let mut sides: Vec<[u32; 2]> =
            triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]).collect();
        sides.sort_unstable();
        let count = sides.len();
        sides.dedup();
        assert_eq!(sides.len(), count);
        for v in 0..n {
            assert!(sides.binary_search(&[v, (v + 1) % n]).is_ok(), "{v}");
        }
        let inner = sides.iter().filter(|[a, b]| *b != (*a + 1) % n);
        assert!(inner.clone().all(|[a, b]| sides.binary_search(&[*b, *a]).is_ok()));
    }

    #[test]
    fn loops_short_and_long_are_filled_once() {
        for (n, wave) in [(3, 0.0), (4, 0.3), (7, 0.0), (40, 0.3), (AT_BEST, 0.1), (1000, 0.2), (10_000, 0.0)]
        {
            let places = circle(n, wave);
            let beyond = vec![DVec3::ZERO; n];
            let filling = filled(&Rim { places: &places, beyond: &beyond, taken: &rim_edges(n) });
            assert_eq!((filling.triangles.len(), filling.middle), (n - 2, None), "{n}");
            fills(&filling.triangles, n as u32);
        }
    }

    #[test]
    fn a_square_takes_no_edge_that_is_there() {
        let places = circle(4, 0.0);
        let beyond = vec![DVec3::ZERO; 4];
        for (chords, middle) in [(vec![[0, 2]], false), (vec![[1, 3]], false), (vec![[0, 2], [1, 3]], true)] {
            let mut taken = rim_edges(4);
            taken.extend(&chords);
            let filling = filled(&Rim { places: &places, beyond: &beyond, taken: &taken });
            assert_eq!(filling.middle.is_some(), middle);
            let has = |c: &[u32; 2]| filling.triangles.iter().any(|t| t.contains(&c[0]) && t.contains(&c[1]));
            assert!(!chords.iter().any(has), "{:?}", filling.triangles);
        }
    }

    #[test]
    fn a_bent_loop_goes_on_as_the_faces_around_it() {
        // A square bent along the diagonal 0-2: the faces beyond lie in both planes.
        let places = [DVec3::X, DVec3::new(0.0, 2.0, 1.0), DVec3::NEG_X, DVec3::new(0.0, -2.0, 1.0)];
        let normals = [normal([places[0], places[1], places[2]]), normal([places[0], places[2], places[3]])];
        let beyond = [normals[0], normals[0], normals[1], normals[1]];
        let filling = filled(&Rim { places: &places, beyond: &beyond, taken: &rim_edges(4) });
        assert!(
            filling.triangles.iter().all(|t| t.contains(&0) && t.contains(&2)),
            "{:?}",
            filling.triangles
        );
    }
}

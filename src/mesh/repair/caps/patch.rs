//! A cap while it is made: triangles with neighbours, split and flipped.

use crate::math::triangle;
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec3;
use rustc_hash::FxHashSet;

/// A disc of triangles whose first vertices are its rim. Halfedge 3 t + k runs from corner k of triangle t to the next.
pub(super) struct Patch {
    /// Places of the vertices.
    pub points: Vec<DVec3>,
    /// Number of vertices of the rim.
    pub rim: usize,
    /// Corners of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The halfedge across each halfedge; [`RIM`] at the rim.
    across: Vec<u32>,
    /// All edges between its vertices, those of the surface around among them.
    taken: FxHashSet<[u32; 2]>,
}

/// The number that stands for no halfedge across.
const RIM: u32 = u32::MAX;

/// The sum of the cotangents at both corners opposite an edge below which the other diagonal is better.
const WORSE: f64 = -1e-9;

/// The largest number of rounds of flips: off the plane nothing else ends them.
const FLIP_ROUNDS: usize = 20;

fn ends(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl Patch {
    /// Triangles over a rim of so many vertices; `taken` are the edges that the surface around has between these.
    pub fn new(
        points: Vec<DVec3>,
        rim: usize,
        triangles: Vec<[u32; 3]>,
        mut taken: FxHashSet<[u32; 2]>,
    ) -> Self {
        let mut halfedges: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
        for (t, corners) in triangles.iter().enumerate() {
            halfedges.extend((0..3).map(|k| (ends(corners[k], corners[(k + 1) % 3]), (3 * t + k) as u32)));
        }
        halfedges.sort_unstable();
        let mut across = vec![RIM; halfedges.len()];
        for pair in halfedges.chunk_by(|a, b| a.0 == b.0) {
            taken.insert(pair[0].0);
            if let [(_, s), (_, t)] = *pair {
                (across[s as usize], across[t as usize]) = (t, s);
            }
        }
        Self { points, rim, triangles, across, taken }
    }

    /// Places of a triangle's corners.
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.points[v as usize])
    }

    /// Divides a triangle at a point inside of it.
    pub fn split(&mut self, t: usize, point: DVec3) {
        let v = self.points.len() as u32;
        self.points.push(point);
        let [a, b, c] = self.triangles[t];
        let (second, third) = (self.triangles.len(), self.triangles.len() + 1);
        let [_, at_b, at_c] = [0, 1, 2].map(|k| self.across[3 * t + k]);
        self.triangles[t] = [a, b, v];
        self.triangles.extend([[b, c, v], [c, a, v]]);
        self.across.resize(3 * self.triangles.len(), RIM);
        self.join(3 * second, at_b);
        self.join(3 * third, at_c);
        for (one, next) in [(t, second), (second, third), (third, t)] {
            self.join(3 * one + 1, 3 * next as u32 + 2);
        }
        self.taken.extend([a, b, c].map(|w| ends(v, w)));
    }

    fn join(&mut self, h: usize, other: u32) {
        self.across[h] = other;
        if other != RIM {
            self.across[other as usize] = h as u32;
        }
    }

    /// Flips edges until the angles opposite each sum to less than pi (Delaunay), as far as no edge comes twice and no triangle turns
    /// over.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn flip_to_delaunay(&mut self, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        for _ in 0..FLIP_ROUNDS {
            monitor.step(Step::default())?;
            let mut flips = 0;
            for h in 0..self.across.len() {
                if self.across[h] != RIM && self.is_better_flipped(h) {
                    self.flip(h);
                    flips += 1;
                }
            }
            if flips == 0 {
                break;
            }
        }
        Ok(())
    }

    /// The corner opposite a halfedge.
    fn opposite(&self, h: usize) -> u32 {
        self.triangles[h / 3][(h + 2) % 3]
    }

    fn is_better_flipped(&self, h: usize) -> bool {
        let other = self.across[h] as usize;
        let [c, d] = [self.opposite(h), self.opposite(other)];
        let [a, b] = [self.triangles[h / 3][h % 3], self.triangles[other / 3][other % 3]];
        let [p, q, r, s] = [a, b, c, d].map(|v| self.points[v as usize]);
        let cotangent = |at: DVec3| triangle::cotangent_between(p - at, q - at);
        let sum = cotangent(r) + cotangent(s);
        if sum.is_nan() || sum >= WORSE || c == d || self.taken.contains(&ends(c, d)) {
            return false;
        }
        let normals = [(s - p).cross(r - p), (q - s).cross(r - s)];
        let old = (q - p).cross(r - p) + (p - q).cross(s - q);
        normals.iter().all(|n| n.dot(old) > 0.0) && normals[0].dot(normals[1]) > 0.0
    }

    fn flip(&mut self, h: usize) {
        let other = self.across[h] as usize;
        let (t, u) = (h / 3, other / 3);
        let corner = |h: usize, on: usize| self.triangles[h / 3][(h + on) % 3];
        let around = |h: usize, on: usize| self.across[3 * (h / 3) + (h + on) % 3];
        let [a, b, c] = [corner(h, 0), corner(h, 1), corner(h, 2)];
        let d = corner(other, 2);
        let [bc, ca, ad, db] = [around(h, 1), around(h, 2), around(other, 1), around(other, 2)];
        self.taken.remove(&ends(a, b));
        self.taken.insert(ends(c, d));
        self.triangles[t] = [a, d, c];
        self.triangles[u] = [d, b, c];
        self.join(3 * t, ad);
        self.join(3 * t + 1, 3 * u as u32 + 2);
        self.join(3 * t + 2, ca);
        self.join(3 * u, db);
        self.join(3 * u + 1, bc);
    }

    /// Whether no triangle is flat and no edge is bent back sharply.
    pub fn is_sound(&self) -> bool {
        let normal = |t: usize| {
            let [p, q, r] = self.corners(t);
            let longest = p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p));
            let normal = (q - p).cross(r - p);
            (normal.length() > FLAT * longest).then(|| normal.normalize_or_zero())
        };
        let normals: Option<Vec<DVec3>> = (0..self.triangles.len()).map(normal).collect();
        let bent_back = |normals: &[DVec3], h: usize| {
            let other = self.across[h];
            other != RIM && normals[h / 3].dot(normals[other as usize / 3]) < BENT_BACK
        };
        normals.is_some_and(|normals| !(0..self.across.len()).any(|h| bent_back(&normals, h)))
    }

    /// The area of the cap.
    pub fn area(&self) -> f64 {
        let area = |t: usize| {
            let [p, q, r] = self.corners(t);
            triangle::area(p, q, r)
        };
        (0..self.triangles.len()).map(area).sum()
    }
}

/// The least height of a sound triangle over its longest side. Chosen by hand.
const FLAT: f64 = 1e-6;

/// The least cosine of the angle between the normals of neighbours in a sound cap: they fold by 120 degrees at most. Chosen by
/// hand.
const BENT_BACK: f64 = -0.5;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::Silent;

    /// Neighbours name each other, along one edge in opposite directions.
    fn check(patch: &Patch) {
        for h in 0..patch.across.len() {
            let [a, b] = [patch.triangles[h / 3][h % 3], patch.triangles[h / 3][(h + 1) % 3]];
            assert!(patch.taken.contains(&ends(a, b)));
            let other = patch.across[h];
            if other == RIM {
                assert!((a as usize) < patch.rim && (b as usize) < patch.rim);
                continue;
            }
            let other = other as usize;
            assert_eq!(patch.across[other] as usize, h);
            let back = [patch.triangles[other / 3][(other + 1) % 3], patch.triangles[other / 3][other % 3]];
            assert_eq!([a, b], back);
        }
    }

    #[test]
    fn splits_and_flips_keep_a_disc() {
        let rim = 12_u32;
        let points: Vec<DVec3> = (0..rim)
            .map(|k| {
                let a = std::f64::consts::TAU * f64::from(k) / f64::from(rim);
                DVec3::new(crate::math::scalar::cos(a), crate::math::scalar::sin(a), 0.0)
            })
            .collect();
        let fan = (1..rim - 1).map(|k| [0, k, k + 1]).collect();
        let mut patch = Patch::new(points, rim as usize, fan, FxHashSet::default());
        check(&patch);
        let area = patch.area();
        let mut random = crate::math::random::SplitMix::new(3);
        for _ in 0..100 {
            let t = (random.unit() * patch.triangles.len() as f64) as usize;
            let [p, q, r] = patch.corners(t);
            patch.split(t, (p + q + r) / 3.0);
            check(&patch);
            patch.flip_to_delaunay(&mut Silent).unwrap();
            check(&patch);
            assert!((patch.area() - area).abs() < 1e-12);
        }
        assert_eq!(patch.triangles.len(), rim as usize - 2 + 200);
        let better =
            (0..patch.across.len()).filter(|&s| patch.across[s] != RIM && patch.is_better_flipped(s));
        assert_eq!(better.count(), 0);
    }
}

//! Randomised approximate Cholesky factorisation of graph Laplacians.
//!
//! Vertices are eliminated in approximate minimum-degree order; the clique that an elimination makes is replaced by a
//! random tree with the same mean (Kyng & Sachdeva 2016; Gao, Kyng & Spielman 2023), so that the factor stays sparse. The
//! seed is fixed: the same graph has the same factor.

use super::conjugate_gradients::Preconditioner;
use super::graph::Graph;
use crate::math::random::SplitMix;
use crate::monitor::{Cancelled, Monitor, Pulse};

/// The end of a linked list.
const NONE: u32 = u32::MAX;
/// Buckets of the degree queue; the last one holds all higher degrees, in no order. Chosen by hand.
const BUCKETS: usize = 256;

/// An approximate factor of a connected graph's Laplacian.
#[derive(Clone, Debug)]
pub struct ApproximateCholesky {
    /// Vertices in elimination order.
    order: Vec<u32>,
    /// Start of each column in `rows`, and one past the end.
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// Share of the pivot that goes to each row.
    shares: Vec<f64>,
    /// Sum of the weights of the eliminated vertex; 0 for the last.
    pivots: Vec<f64>,
}

impl ApproximateCholesky {
    /// Factorises the Laplacian of a graph.
    pub fn new(graph: &Graph) -> Self {
        let mut factor = Self::empty(graph);
        let mut elimination = Elimination::new(graph);
        while elimination.eliminate(&mut factor) {}
        factor
    }

    /// Factorises the Laplacian of a graph, and asks the monitor between the vertices.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn watched(graph: &Graph, monitor: &mut dyn Monitor) -> Result<Self, Cancelled> {
        let mut factor = Self::empty(graph);
        let mut elimination = Elimination::new(graph);
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        while elimination.eliminate(&mut factor) {
            pulse.beat()?;
        }
        Ok(factor)
    }

    /// A factor without columns, with memory for all.
    fn empty(graph: &Graph) -> Self {
        let n = graph.vertices;
        Self {
            order: Vec::with_capacity(n),
            starts: vec![0],
            rows: Vec::with_capacity(graph.edges.len() * 2),
            shares: Vec::with_capacity(graph.edges.len() * 2),
            pivots: Vec::with_capacity(n),
        }
    }

    fn push_column(&mut self, v: u32, neighbours: &[(u32, f64)]) {
        let pivot: f64 = neighbours.iter().map(|n| n.1).sum();
        self.order.push(v);
        self.pivots.push(pivot);
        for &(row, weight) in neighbours {
            self.rows.push(row);
            self.shares.push(weight / pivot);
        }
        self.starts.push(self.rows.len() as u32);
    }
}

impl Preconditioner<f64> for ApproximateCholesky {
    /// y = (factor)^-1 x.
    fn precondition(&self, x: &[f64], y: &mut [f64]) {
        y.copy_from_slice(x);
        for (k, &v) in self.order.iter().enumerate() {
            let value = y[v as usize];
            for e in self.starts[k] as usize..self.starts[k + 1] as usize {
                y[self.rows[e] as usize] += self.shares[e] * value;
            }
        }
        for (k, &v) in self.order.iter().enumerate().rev() {
            let pivot = self.pivots[k];
            let mut value = if pivot > 0.0 { y[v as usize] / pivot } else { 0.0 };
            for e in self.starts[k] as usize..self.starts[k + 1] as usize {
                value += self.shares[e] * y[self.rows[e] as usize];
            }
            y[v as usize] = value;
        }
    }
}

/// Vertices between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 8192;

/// An elimination under way: the graph that is left, and the queue of its vertices.
struct Elimination {
    lists: Lists,
    queue: DegreeQueue,
    random: SplitMix,
    neighbours: Vec<(u32, f64)>,
}

impl Elimination {
    fn new(graph: &Graph) -> Self {
        let lists = Lists::new(graph);
        let queue = DegreeQueue::new(&lists.degrees);
        Self { lists, queue, random: SplitMix::new(0x9e37_79b9_7f4a_7c15), neighbours: Vec::new() }
    }

    /// Eliminates the next vertex, whose column the factor gets; `false` where none is left.
    fn eliminate(&mut self, factor: &mut ApproximateCholesky) -> bool {
        let Self { lists, queue, random, neighbours } = self;
        let Some(v) = queue.pop(lists) else { return false };
        lists.gather(v, neighbours);
        lists.eliminated[v as usize] = true;
        factor.push_column(v, neighbours);
        lists.replace_clique(neighbours, random, queue);
        true
    }
}

/// Adjacency as linked lists in one arena; edges to eliminated vertices are skipped when met.
struct Lists {
    heads: Vec<u32>,
    next: Vec<u32>,
    ends: Vec<u32>,
    weights: Vec<f64>,
    /// Upper bounds of the degrees.
    degrees: Vec<u32>,
    eliminated: Vec<bool>,
}

impl Lists {
    fn new(graph: &Graph) -> Self {
        let n = graph.vertices;
        let capacity = graph.edges.len() * 5;
        let mut lists = Self {
            heads: vec![NONE; n],
            next: Vec::with_capacity(capacity),
            ends: Vec::with_capacity(capacity),
            weights: Vec::with_capacity(capacity),
            degrees: vec![0; n],
            eliminated: vec![false; n],
        };
        for &(i, j, w) in graph.edges.iter().filter(|e| e.2 > 0.0) {
            lists.add(i, j, w);
        }
        lists
    }

    fn add(&mut self, i: u32, j: u32, weight: f64) {
        for (a, b) in [(i, j), (j, i)] {
            self.next.push(self.heads[a as usize]);
            self.heads[a as usize] = self.ends.len() as u32;
            self.ends.push(b);
            self.weights.push(weight);
            self.degrees[a as usize] += 1;
        }
    }

    /// The neighbours left, parallel edges summed, by ascending weight.
    ///
    /// Not inlined into the one loop that calls it: browsers optimise a function only from one call to the next.
    #[inline(never)]
    fn gather(&self, v: u32, neighbours: &mut Vec<(u32, f64)>) {
        neighbours.clear();
        let mut e = self.heads[v as usize];
        while e != NONE {
            let end = self.ends[e as usize];
            if !self.eliminated[end as usize] {
                neighbours.push((end, self.weights[e as usize]));
            }
            e = self.next[e as usize];
        }
        neighbours.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        neighbours.dedup_by(|b, a| {
            let same = a.0 == b.0;
            if same {
                a.1 += b.1;
            }
            same
        });
        neighbours.sort_unstable_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    }

    /// Joins the neighbours of an eliminated vertex by a random tree; not inlined, likewise.
    #[inline(never)]
    fn replace_clique(&mut self, neighbours: &[(u32, f64)], random: &mut SplitMix, queue: &mut DegreeQueue) {
        let total: f64 = neighbours.iter().map(|n| n.1).sum();
        let mut rest = total;
        for (k, &(i, weight)) in neighbours.iter().enumerate() {
            self.degrees[i as usize] = self.degrees[i as usize].saturating_sub(1);
            rest -= weight;
            if k + 1 < neighbours.len() && rest > 0.0 {
                let later = &neighbours[k + 1..];
                let mut mark = random.unit() * later.iter().map(|n| n.1).sum::<f64>();
                let chosen = later.iter().find(|n| {
                    mark -= n.1;
                    mark <= 0.0
                });
                let j = chosen.unwrap_or(&later[later.len() - 1]).0;
                self.add(i, j, weight * rest / total);
            }
        }
        for &(i, _) in neighbours {
            queue.push(i, self.degrees[i as usize]);
        }
    }
}

/// Vertices by degree, in buckets; entries go stale and are checked when they come up.
struct DegreeQueue {
    buckets: Vec<Vec<u32>>,
    least: usize,
}

impl DegreeQueue {
    fn new(degrees: &[u32]) -> Self {
        let mut queue = Self { buckets: vec![Vec::new(); BUCKETS], least: 0 };
        for (v, &degree) in degrees.iter().enumerate().rev() {
            queue.push(v as u32, degree);
        }
        queue.least = 0;
        queue
    }

    fn push(&mut self, v: u32, degree: u32) {
        let bucket = (degree as usize).min(BUCKETS - 1);
        self.buckets[bucket].push(v);
        self.least = self.least.min(bucket);
    }

    fn pop(&mut self, lists: &Lists) -> Option<u32> {
        while self.least < BUCKETS {
            while let Some(v) = self.buckets[self.least].pop() {
                let degree = (lists.degrees[v as usize] as usize).min(BUCKETS - 1);
                if !lists.eliminated[v as usize] && degree == self.least {
                    return Some(v);
                }
            }
            self.least += 1;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::conjugate_gradients::{CgOptions, CgReport, CgWorkspace, LinearOperator, dot};

    fn solve(graph: &Graph, b: &[f64], x: &mut [f64], max_iterations: usize) -> CgReport {
        let options = CgOptions { tolerance: 1e-10, max_iterations };
        let preconditioner = ApproximateCholesky::new(graph);
        CgWorkspace::default().solve(graph, &preconditioner, b, x, &options).unwrap()
    }

    /// A grid with weights over six orders of magnitude.
    fn grid(n: u32) -> Graph {
        let weight = |k: u32| 10_f64.powi((k * 7919 % 7) as i32 - 3);
        let mut edges = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let at = i * n + j;
                if j + 1 < n {
                    edges.push((at, at + 1, weight(at)));
                }
                if i + 1 < n {
                    edges.push((at, at + n, weight(at + 3)));
                }
            }
        }
        Graph { vertices: (n * n) as usize, edges }
    }

    #[test]
    fn the_solution_satisfies_the_system() {
        let graph = grid(60);
        let n = graph.vertices;
        let mut b: Vec<f64> = (0..n).map(|i| (i % 17) as f64 - 8.0).collect();
        graph.leave_kernel(&mut b);
        let (mut x, mut lx) = (vec![0.0; n], vec![0.0; n]);
        let iterations = solve(&graph, &b, &mut x, 200).iterations;
        graph.apply(&x, &mut lx);
        let error: f64 = lx.iter().zip(&b).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt();
        assert!(error < 1e-8 * dot(&b, &b).sqrt(), "{error}");
        assert!(iterations < 60, "{iterations}");
        assert!(x.iter().sum::<f64>().abs() < 1e-6);
    }

    #[test]
    fn on_a_tree_the_factorisation_is_exact() {
        let edges = (1..500_u32).map(|i| ((i - 1) / 3, i, 1.0 + f64::from(i % 5))).collect();
        let graph = Graph { vertices: 500, edges };
        let b: Vec<f64> = (0..500).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let mut x = vec![0.0; 500];
        let iterations = solve(&graph, &b, &mut x, 50).iterations;
        assert!(iterations <= 2, "{iterations}");
    }

    #[test]
    fn two_factorisations_agree_bit_for_bit() {
        let graph = grid(20);
        let b: Vec<f64> = (0..400).map(f64::from).collect();
        let image = || {
            let mut y = vec![0.0; 400];
            ApproximateCholesky::new(&graph).precondition(&b, &mut y);
            y
        };
        assert_eq!(image(), image());
    }
}

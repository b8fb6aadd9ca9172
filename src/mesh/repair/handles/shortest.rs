//! The shortest loop that does not separate a surface.
//!
//! The shortest such loop through a vertex is at most twice their distance shorter than that through another one. So a search
//! from one vertex, over a ball a little larger than needed, settles the vertices around it as well, but for a small
//! tolerance: a search is as dear as its ball, and a long handle has hundreds of vertices to begin at.

use super::crossings::{Crossings, Generator, NO_EDGE, closed_loop};
use super::graph::Graph;
use crate::math::min_queue::MinQueue;
use crate::monitor::{Cancelled, Monitor, Step};

/// The number of searches between two reports to the monitor. Chosen by hand.
const SEARCHES: usize = 64;

/// Loops that are longer than the best one by less than this share of it are still looked at: they tell how much shorter others can be.
/// Chosen by hand.
const SLACK: f64 = 0.25;

/// The loop that is found is longer than the shortest one by at most this share of it. A loop of less than a hundred edges of one
/// length is the shortest: another one would have an edge less.
const TOLERANCE: f64 = 0.01;

/// The shortest loop of edges, but for [`TOLERANCE`], that does not separate a connected surface that has handles; `None` where no
/// loop is left over.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn shortest_loop(
    graph: &Graph,
    crossings: &Crossings,
    monitor: &mut dyn Monitor,
) -> Result<Option<Generator>, Cancelled> {
    let mut is_root = vec![false; graph.vertices()];
    let on_generators = crossings.generators.iter().flat_map(|generator| &generator.vertices);
    // The vertices of the shortest loops come first: the loops that are found from them make the other searches small.
    let roots: Vec<u32> =
        on_generators.copied().filter(|&v| !std::mem::replace(&mut is_root[v as usize], true)).collect();
    let Some(shortest) = crossings.generators.first() else { return Ok(None) };
    let mut best =
        Generator { edges: shortest.edges.clone(), vertices: shortest.vertices.clone(), ..*shortest };
    let mut search = Search::new(graph, &crossings.of_edge);
    for (k, &root) in roots.iter().enumerate() {
        if k % SEARCHES == 0 {
            monitor.step(Step { fraction: k as f64 / roots.len() as f64, residual: None })?;
        }
        // The search from another root has settled this one.
        if !is_root[root as usize] {
            continue;
        }
        let bound = (1.0 + SLACK) * best.length;
        let closing = search.closing(root, bound);
        if let Some(Closing { edge, .. }) = closing {
            let found = closed_loop(graph, edge, |v| search.before[v as usize]);
            if found.length < best.length {
                best = found;
            }
        }
        let through_root = closing.map_or(bound, |closing| closing.length);
        let around = 0.5 * (through_root - best.length / (1.0 + TOLERANCE));
        search.settled_within(around).for_each(|v| is_root[v as usize] = false);
        search.clear();
    }
    Ok(Some(best))
}

/// The shortest loop from a root and back, over shortest paths, that does not separate.
#[derive(Clone, Copy)]
struct Closing {
    /// The edge that closes it.
    edge: u32,
    /// Its length.
    length: f64,
}

/// Shortest paths from one vertex as far as they are of use, with what they cross.
struct Search<'a> {
    graph: &'a Graph,
    of_edge: &'a [u128],
    /// The distances of the vertices that were reached.
    distance: Vec<f64>,
    before: Vec<u32>,
    crossed: Vec<u128>,
    is_settled: Vec<bool>,
    /// The vertices that were reached.
    reached: Vec<u32>,
    queue: MinQueue<u32>,
}

impl<'a> Search<'a> {
    fn new(graph: &'a Graph, of_edge: &'a [u128]) -> Self {
        let n = graph.vertices();
        Self {
            graph,
            of_edge,
            distance: vec![f64::INFINITY; n],
            before: vec![NO_EDGE; n],
            crossed: vec![0; n],
            is_settled: vec![false; n],
            reached: Vec::new(),
            queue: MinQueue::default(),
        }
    }

    /// The shortest loop from a root, if it is shorter than `bound`.
    fn closing(&mut self, root: u32, bound: f64) -> Option<Closing> {
        let (mut bound, mut closing) = (bound, None);
        self.distance[root as usize] = 0.0;
        self.reached.push(root);
        self.queue.push(0.0, root, ());
        while let Some(next) = self.queue.pop() {
            let (v, here) = (next.key, next.cost);
            // All vertices of a loop are within half of its length.
            if 2.0 * here >= bound {
                break;
            }
            if std::mem::replace(&mut self.is_settled[v as usize], true) {
                continue;
            }
            for (w, length, edge) in self.graph.links(v) {
                let crossed = self.crossed[v as usize] ^ self.of_edge[edge as usize];
                if self.is_settled[w as usize] {
                    let around = here + length + self.distance[w as usize];
                    if crossed != self.crossed[w as usize] && around < bound {
                        (bound, closing) = (around, Some(Closing { edge, length: around }));
                    }
                } else if here + length < self.distance[w as usize] {
                    if self.distance[w as usize] == f64::INFINITY {
                        self.reached.push(w);
                    }
                    self.distance[w as usize] = here + length;
                    self.before[w as usize] = edge;
                    self.crossed[w as usize] = crossed;
                    self.queue.push(here + length, w, ());
                }
            }
        }
        closing
    }

    /// The vertices within a distance of the root, as far as they were settled.
    fn settled_within(&self, distance: f64) -> impl Iterator<Item = u32> + '_ {
        let is_within = move |v: &u32| self.is_settled[*v as usize] && self.distance[*v as usize] <= distance;
        self.reached.iter().copied().filter(is_within)
    }

    /// Forgets the last search.
    fn clear(&mut self) {
        for v in self.reached.drain(..).map(|v| v as usize) {
            self.distance[v] = f64::INFINITY;
            self.before[v] = NO_EDGE;
            self.crossed[v] = 0;
            self.is_settled[v] = false;
        }
        self.queue.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;
    use crate::mesh::generators::torus;
    use crate::mesh::repair::draft::{Draft, DraftFace, FaceOrigin};
    use crate::monitor::Silent;
    use glam::DVec3;

    /// A torus whose vertices are off their places.
    fn shaken(around: usize, tube: usize, seed: u64) -> Draft {
        let (mesh, mut random) = (torus(around, tube), SplitMix::new(seed));
        let mut shaken = |p: &DVec3| *p + 0.5 * DVec3::from_array([0; 3].map(|_| random.unit()));
        let face = |corners: [u32; 3], number: u32| DraftFace {
            corners,
            file_corners: corners,
            origin: FaceOrigin::File { number, turned: false },
        };
        Draft {
            positions: mesh.positions().iter().map(&mut shaken).collect(),
            numbers: (0..mesh.vertex_count() as u32).map(Some).collect(),
            faces: mesh.triangles().iter().zip(0..).map(|(t, f)| face(t.map(|v| v.0), f)).collect(),
        }
    }

    #[test]
    fn no_vertex_has_a_shorter_loop_than_those_of_the_generators() {
        for seed in 0..30 {
            let draft = shaken(5 + seed as usize % 7, 4 + seed as usize % 5, seed);
            let graph = Graph::new(&draft).unwrap();
            let crossings = Crossings::new(&graph);
            assert_eq!(crossings.generators.len(), 2);
            let found = shortest_loop(&graph, &crossings, &mut Silent).unwrap().unwrap();
            let mut search = Search::new(&graph, &crossings.of_edge);
            let mut least = f64::INFINITY;
            for root in 0..graph.vertices() as u32 {
                if let Some(Closing { edge, .. }) = search.closing(root, f64::INFINITY) {
                    least = least.min(closed_loop(&graph, edge, |v| search.before[v as usize]).length);
                }
                search.clear();
            }
            let most = (1.0 + TOLERANCE) * least;
            assert!((least - 1e-12..=most).contains(&found.length), "seed {seed}: {} {least}", found.length);
            // Simple, closed, and crossing.
            let n = found.vertices.len();
            let mut once = found.vertices.clone();
            once.sort_unstable();
            once.dedup();
            assert_eq!((once.len(), found.edges.len()), (n, n));
            for (k, &edge) in found.edges.iter().enumerate() {
                assert_eq!(graph.other_end(edge, found.vertices[k]), found.vertices[(k + 1) % n]);
            }
            assert_ne!(found.edges.iter().fold(0, |bits, &e| bits ^ crossings.of_edge[e as usize]), 0);
        }
    }

    #[test]
    fn the_way_around_a_face_crosses_nothing() {
        let draft = shaken(9, 7, 3);
        let graph = Graph::new(&draft).unwrap();
        let bits = Crossings::new(&graph).of_edge;
        let edge = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            graph.ends.iter().position(|e| *e == ends).unwrap()
        };
        for face in &draft.faces {
            let [a, b, c] = face.corners;
            assert_eq!(bits[edge(a, b)] ^ bits[edge(b, c)] ^ bits[edge(c, a)], 0);
        }
        assert!(bits.iter().any(|bits| *bits != 0));
    }
}

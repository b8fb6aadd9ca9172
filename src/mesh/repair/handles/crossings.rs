//! Which loops do not separate a surface: a tree of edges, a tree of faces beside it, and the edges that are left.

use super::graph::Graph;
use crate::math::disjoint_sets::DisjointSets;
use crate::math::min_queue::shortest_paths;

/// The number that stands for no edge.
pub(super) const NO_EDGE: u32 = u32::MAX;

/// The classes of loops on a closed surface.
pub(super) struct Crossings {
    /// For each edge the closed ways over faces that cross it, one bit for each way; each of the edges left over makes one way. A loop
    /// separates the surface exactly if the bits of its edges, added without carry, are 0.
    pub of_edge: Vec<u128>,
    /// The loops that the edges left over close in the tree, shortest first: two for each handle. No loop that does not separate
    /// passes by all of their vertices.
    pub generators: Vec<Generator>,
}

/// A loop of a shortest path tree and one edge.
pub(super) struct Generator {
    /// Its length.
    pub length: f64,
    /// Its edges.
    pub edges: Vec<u32>,
    /// Its vertices: vertex i is between edges i - 1 and i.
    pub vertices: Vec<u32>,
}

/// The largest number of handles that are told apart.
pub(in crate::mesh::repair) const MOST_HANDLES: usize = u128::BITS as usize / 2;

impl Crossings {
    /// The classes of a connected surface of genus 1 to [`MOST_HANDLES`].
    pub fn new(graph: &Graph) -> Self {
        let tree = Tree::new(graph);
        let (cotree, left) = cotree(graph, &tree);
        let of_edge = crossed(graph, &cotree, &left);
        let mut generators: Vec<Generator> = left.iter().map(|&edge| tree.generator(graph, edge)).collect();
        generators.sort_by(|a, b| a.length.total_cmp(&b.length));
        Self { of_edge, generators }
    }
}

/// Shortest paths from one vertex.
struct Tree {
    distance: Vec<f64>,
    /// The edge of each vertex towards the root.
    before: Vec<u32>,
}

impl Tree {
    fn new(graph: &Graph) -> Self {
        let root = graph.ends.first().map_or(0, |ends| ends[0]);
        let mut before = vec![NO_EDGE; graph.vertices()];
        let reached = |v: u32, edge: u32| before[v as usize] = edge;
        let distance = shortest_paths(graph.vertices(), root, |v| graph.links(v), reached);
        Self { distance, before }
    }

    fn generator(&self, graph: &Graph, edge: u32) -> Generator {
        closed_loop(graph, edge, |v| self.before[v as usize])
    }

    /// Length of the way from the root over an edge and back.
    fn round_trip(&self, graph: &Graph, edge: usize) -> f64 {
        let [a, b] = graph.ends[edge].map(|v| self.distance[v as usize]);
        a + b + graph.lengths[edge]
    }
}

/// The loop that an edge closes in a tree that is given by the edge from each vertex towards the root, without the way from the root
/// that both its halves share.
pub(super) fn closed_loop(graph: &Graph, edge: u32, before: impl Fn(u32) -> u32) -> Generator {
    let way = |mut v: u32| {
        let mut steps = Vec::new();
        while before(v) != NO_EDGE {
            steps.push((v, before(v)));
            v = graph.other_end(before(v), v);
        }
        steps.push((v, NO_EDGE));
        steps
    };
    let [mut there, mut back] = graph.ends[edge as usize].map(way);
    let mut meeting = None;
    while let (Some(&(a, _)), Some(&(b, _))) = (there.last(), back.last())
        && a == b
    {
        meeting = Some(a);
        there.pop();
        back.pop();
    }
    // From where the ways part to the edge's first end, over the edge, and back.
    let mut vertices: Vec<u32> = meeting.into_iter().collect();
    vertices.extend(there.iter().rev().map(|step| step.0));
    vertices.extend(back.iter().map(|step| step.0));
    let mut edges: Vec<u32> = there.iter().rev().map(|step| step.1).collect();
    edges.push(edge);
    edges.extend(back.iter().map(|step| step.1));
    let length = edges.iter().map(|&e| graph.lengths[e as usize]).sum();
    Generator { length, edges, vertices }
}

/// A spanning tree of the faces.
struct Cotree {
    /// Faces from the root on, each after the one before it.
    order: Vec<u32>,
    /// The edge of each face towards the root.
    before: Vec<u32>,
}

/// The spanning tree of the faces over edges beside the tree that are as far from the root as can be, and the edges in neither.
fn cotree(graph: &Graph, tree: &Tree) -> (Cotree, Vec<u32>) {
    let mut is_in_tree = vec![false; graph.ends.len()];
    tree.before.iter().filter(|&&e| e != NO_EDGE).for_each(|&e| is_in_tree[e as usize] = true);
    let mut beside: Vec<(f64, u32)> = (0..graph.ends.len())
        .filter(|&e| !is_in_tree[e])
        .map(|e| (tree.round_trip(graph, e), e as u32))
        .collect();
    beside.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut sets = DisjointSets::new(graph.faces);
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); graph.faces];
    let mut left = Vec::new();
    for (_, edge) in beside {
        let faces = faces_at(graph, edge);
        if sets.join(faces[0], faces[1]) {
            faces.into_iter().for_each(|f| around[f].push(edge));
        } else {
            left.push(edge);
        }
    }
    let mut before = vec![NO_EDGE; graph.faces];
    let mut order = vec![0_u32];
    let mut next = 0;
    while let Some(&face) = order.get(next) {
        next += 1;
        for &edge in &around[face as usize] {
            if edge != before[face as usize] {
                let other = across(graph, edge, face);
                before[other as usize] = edge;
                order.push(other);
            }
        }
    }
    (Cotree { order, before }, left)
}

fn faces_at(graph: &Graph, edge: u32) -> [usize; 2] {
    graph.halfedges[edge as usize].map(|h| h as usize / 3)
}

fn across(graph: &Graph, edge: u32, face: u32) -> u32 {
    let [a, b] = faces_at(graph, edge);
    (if a == face as usize { b } else { a }) as u32
}

/// The bits of all edges: bit i for the way over faces that the i-th edge left over closes in the tree of faces.
fn crossed(graph: &Graph, cotree: &Cotree, left: &[u32]) -> Vec<u128> {
    let mut of_edge = vec![0_u128; graph.ends.len()];
    let mut of_face = vec![0_u128; graph.faces];
    for (i, &edge) in left.iter().enumerate().take(u128::BITS as usize) {
        of_edge[edge as usize] = 1 << i;
        faces_at(graph, edge).into_iter().for_each(|f| of_face[f] ^= 1 << i);
    }
    // Ways that go on towards the root; those of both ends cancel where they meet.
    for &face in cotree.order.iter().rev() {
        let edge = cotree.before[face as usize];
        if edge != NO_EDGE {
            let bits = of_face[face as usize];
            of_edge[edge as usize] = bits;
            of_face[across(graph, edge, face) as usize] ^= bits;
        }
    }
    of_edge
}

//! The edges of a closed surface as a graph with lengths.

use super::super::draft::{Draft, edges};

/// The edges of a closed, oriented surface.
pub(super) struct Graph {
    /// The ends of each edge, the lesser number first.
    pub ends: Vec<[u32; 2]>,
    /// Both halfedges 3 f + k along each edge, the lesser first.
    pub halfedges: Vec<[u32; 2]>,
    /// The lengths of the edges.
    pub lengths: Vec<f64>,
    /// Number of faces.
    pub faces: usize,
    /// The place of the first link of each vertex, and the end of the last one.
    first: Vec<u32>,
    /// The edges of each vertex, one vertex after the other.
    links: Vec<u32>,
}

impl Graph {
    /// The graph of a surface; `None` where an edge has not two faces.
    pub fn new(draft: &Draft) -> Option<Self> {
        let edges = edges(&draft.faces);
        let ends: Vec<[u32; 2]> = edges.iter().map(|edge| edge.ends).collect();
        let halfedges: Option<Vec<[u32; 2]>> =
            edges.iter().map(|edge| <[u32; 2]>::try_from(&edge.halfedges[..]).ok()).collect();
        let at = |v: u32| draft.positions[v as usize];
        let lengths = ends.iter().map(|&[a, b]| at(a).distance(at(b))).collect();
        let mut first = vec![0_u32; draft.positions.len() + 1];
        ends.iter().flatten().for_each(|&v| first[v as usize + 1] += 1);
        for v in 1..first.len() {
            first[v] += first[v - 1];
        }
        let mut next = first.clone();
        let mut links = vec![0; 2 * ends.len()];
        for (edge, &both) in (0_u32..).zip(&ends) {
            for v in both {
                links[next[v as usize] as usize] = edge;
                next[v as usize] += 1;
            }
        }
        Some(Self { ends, halfedges: halfedges?, lengths, faces: draft.faces.len(), first, links })
    }

    /// Number of vertices, also of those without an edge.
    pub fn vertices(&self) -> usize {
        self.first.len() - 1
    }

    /// The edges at a vertex.
    pub fn edges_at(&self, v: u32) -> &[u32] {
        &self.links[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }

    /// The end of an edge across from one of its ends.
    pub fn other_end(&self, edge: u32, v: u32) -> u32 {
        let [a, b] = self.ends[edge as usize];
        if a == v { b } else { a }
    }

    /// The vertices beside a vertex, each with the length of the edge there and the edge.
    pub fn links(&self, v: u32) -> impl Iterator<Item = (u32, f64, u32)> + '_ {
        self.edges_at(v).iter().map(move |&e| (self.other_end(e, v), self.lengths[e as usize], e))
    }
}

//! The edges of a triangle soup: whether each has two triangles, and whether these are all of one part.

use super::fault::{Elements, MeshFault};
use super::triangulated::Triangle;
use rustc_hash::FxHashMap;

/// Each undirected edge with its one or two halfedges, in order of first appearance.
pub(super) struct EdgeTable {
    pub ends: Vec<[u32; 2]>,
    /// Halfedge 3 t + k of each edge's two triangles; `u32::MAX` where the second is missing.
    pub halfedges: Vec<[u32; 2]>,
    /// Edge of each halfedge.
    pub edge_of: Vec<u32>,
}

impl EdgeTable {
    pub fn new(triangles: &[Triangle]) -> Result<Self, MeshFault> {
        let mut numbers: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        numbers.reserve(triangles.len() * 3 / 2);
        let mut table = Self {
            ends: Vec::new(),
            halfedges: Vec::new(),
            edge_of: Vec::with_capacity(triangles.len() * 3),
        };
        let mut crowded = Vec::new();
        for (h, (a, b)) in
            triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).enumerate()
        {
            let ends = [a.min(b), a.max(b)];
            let next = table.ends.len() as u32;
            let edge = *numbers.entry(ends).or_insert(next);
            table.edge_of.push(edge);
            if edge == next {
                table.ends.push(ends);
                table.halfedges.push([h as u32, u32::MAX]);
            } else if table.halfedges[edge as usize][1] == u32::MAX {
                table.halfedges[edge as usize][1] = h as u32;
            } else {
                crowded.push(ends.map(|v| v as usize));
            }
        }
        crowded.sort_unstable();
        crowded.dedup();
        if crowded.is_empty() {
            return Ok(table);
        }
        let is_crowded = |ends: [u32; 2]| crowded.binary_search(&ends.map(|v| v as usize)).is_ok();
        let parts = table.components(|e| is_crowded(table.ends[e])).len();
        Err(MeshFault::NonManifoldEdges { edges: crowded.iter().copied().collect(), parts })
    }

    pub fn count(&self) -> usize {
        self.ends.len()
    }

    pub fn check_closed(&self) -> Result<(), MeshFault> {
        let open = (0..self.count()).filter(|&e| self.halfedges[e][1] == u32::MAX);
        let faults: Elements<_> = open.map(|e| self.ends[e].map(|v| v as usize)).collect();
        if faults.count > 0 { Err(MeshFault::OpenEdges(faults)) } else { Ok(()) }
    }

    /// Faces of each part that is connected across edges with two faces and without a cut, largest first.
    fn components(&self, is_cut: impl Fn(usize) -> bool) -> Vec<usize> {
        let triangles = self.edge_of.len() / 3;
        let mut seen = vec![false; triangles];
        let (mut faces, mut stack) = (Vec::new(), Vec::new());
        for start in 0..triangles {
            if std::mem::replace(&mut seen[start], true) {
                continue;
            }
            stack.push(start);
            let mut size = 0;
            while let Some(t) = stack.pop() {
                size += 1;
                for h in 3 * t..3 * t + 3 {
                    let edge = self.edge_of[h] as usize;
                    if self.halfedges[edge][1] == u32::MAX || is_cut(edge) {
                        continue;
                    }
                    let other = self.across(h) / 3;
                    if !std::mem::replace(&mut seen[other], true) {
                        stack.push(other);
                    }
                }
            }
            faces.push(size);
        }
        faces.sort_unstable_by(|a, b| b.cmp(a));
        faces
    }

    /// The halfedge across.
    pub fn across(&self, h: usize) -> usize {
        let [a, b] = self.halfedges[self.edge_of[h] as usize];
        if a as usize == h { b as usize } else { a as usize }
    }
}

/// All triangles are of one part.
pub(super) fn check_components(edges: &EdgeTable) -> Result<(), MeshFault> {
    let faces = edges.components(|_| false);
    if faces.len() > 1 { Err(MeshFault::Components { faces }) } else { Ok(()) }
}

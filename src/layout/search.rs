//! Shortest paths over vertices and edge midpoints, within sectors at both ends.
//!
//! A* with the Euclidean distance to the goal. Nodes are vertices off all paths and midpoints of edges off all paths;
//! links run inside triangles. Midpoints cannot be blocked: a path exists whenever both ends lie on one face of the
//! layout.

use super::refinable::RefinableMesh;
use crate::mesh::{HalfedgeId, VertexId};
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A node of a path, named so that it survives splits elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Node {
    Vertex(VertexId),
    /// The midpoint of the edge between two vertices.
    Midpoint(VertexId, VertexId),
}

/// A path between two landmarks.
#[derive(Clone, Debug)]
pub(super) struct FoundPath {
    /// All nodes, both landmarks included.
    pub nodes: Vec<Node>,
    pub length: f64,
    /// Where it leaves its start and reaches its end.
    pub start_step: EndStep,
    pub end_step: EndStep,
}

/// The link of a path at one of its landmarks, by the outgoing halfedge that bounds it clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EndStep {
    /// Along the edge to this neighbour.
    Along(VertexId),
    /// Through the triangle counter-clockwise after the edge to this neighbour.
    After(VertexId),
}

/// Which halfedges around a landmark a path may use: those strictly between two embedded paths.
pub(super) struct Sector {
    /// First outgoing halfedge; its triangle is inside.
    pub first: HalfedgeId,
    /// The outgoing halfedge that ends the sector.
    pub last: HalfedgeId,
    /// Whether `first` and `last` are edges of paths, not to be used.
    pub bounded: Bounded,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bounded {
    ByPaths,
    WholeStar,
}

#[derive(PartialEq)]
struct Entry {
    priority: f64,
    node: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.priority.total_cmp(&self.priority).then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

const NONE: u32 = u32::MAX;

/// Reusable search memory.
#[derive(Default)]
pub(super) struct PathSearch {
    stamp: Vec<u32>,
    now: u32,
    distance: Vec<f64>,
    before: Vec<u32>,
    goal_cost: Vec<f64>,
    goal_stamp: Vec<u32>,
    goal_step: Vec<EndStep>,
    queue: BinaryHeap<Entry>,
}

impl PathSearch {
    /// The shortest path from `start` to `end` that leaves and arrives inside the given sectors.
    ///
    /// `midpoint_penalty` multiplies the length of links that touch a midpoint.
    pub fn shortest(
        &mut self,
        mesh: &RefinableMesh,
        ends: [VertexId; 2],
        sectors: [&[Sector]; 2],
        midpoint_penalty: f64,
    ) -> Option<FoundPath> {
        let [start, end] = ends;
        self.begin(mesh);
        let goal = mesh.positions[end];
        self.mark_goal(mesh, end, sectors[1], midpoint_penalty);
        let mut best = f64::INFINITY;
        let mut best_last = NONE;
        self.seed(mesh, start, sectors[0], (goal, midpoint_penalty));
        if let Some(length) = direct(mesh, start, end, sectors) {
            best = length;
        }
        while let Some(Entry { priority, node }) = self.queue.pop() {
            if priority >= best {
                break;
            }
            let here = self.distance[node as usize];
            let place = position(mesh, node);
            if priority > here + place.distance(goal) + 1e-15 {
                continue;
            }
            if self.goal_stamp[node as usize] == self.now && here + self.goal_cost[node as usize] < best {
                best = here + self.goal_cost[node as usize];
                best_last = node;
            }
            for_each_link(mesh, node, |next, touches_midpoint| {
                let there = position(mesh, next);
                let factor = if touches_midpoint { midpoint_penalty } else { 1.0 };
                let through = here + factor * place.distance(there);
                self.relax(next, node, through, there.distance(goal));
            });
        }
        best.is_finite().then(|| self.path(mesh, ends, best_last))
    }

    fn begin(&mut self, mesh: &RefinableMesh) {
        let nodes = mesh.positions.len() + mesh.twins.len();
        self.stamp.resize(nodes, 0);
        self.distance.resize(nodes, 0.0);
        self.before.resize(nodes, NONE);
        self.goal_stamp.resize(nodes, 0);
        self.goal_cost.resize(nodes, 0.0);
        self.goal_step.resize(nodes, EndStep::Along(VertexId(NONE)));
        self.now += 1;
        self.queue.clear();
    }

    fn relax(&mut self, node: u32, before: u32, distance: f64, to_goal: f64) {
        let i = node as usize;
        if self.stamp[i] != self.now || distance < self.distance[i] {
            self.stamp[i] = self.now;
            self.distance[i] = distance;
            self.before[i] = before;
            self.queue.push(Entry { priority: distance + to_goal, node });
        }
    }

    fn seed(
        &mut self,
        mesh: &RefinableMesh,
        start: VertexId,
        sectors: &[Sector],
        (goal, penalty): (DVec3, f64),
    ) {
        let from = mesh.positions[start];
        for_each_end(mesh, start, sectors, |node, _, is_midpoint| {
            let there = position(mesh, node);
            let factor = if is_midpoint { penalty } else { 1.0 };
            self.relax(node, NONE, factor * from.distance(there), there.distance(goal));
        });
    }

    fn mark_goal(&mut self, mesh: &RefinableMesh, end: VertexId, sectors: &[Sector], penalty: f64) {
        let to = mesh.positions[end];
        for_each_end(mesh, end, sectors, |node, step, is_midpoint| {
            let factor = if is_midpoint { penalty } else { 1.0 };
            self.goal_stamp[node as usize] = self.now;
            self.goal_cost[node as usize] = factor * to.distance(position(mesh, node));
            self.goal_step[node as usize] = step;
        });
    }

    fn path(&self, mesh: &RefinableMesh, [start, end]: [VertexId; 2], last: u32) -> FoundPath {
        let mut nodes = vec![Node::Vertex(end)];
        let mut at = last;
        while at != NONE {
            nodes.push(named(mesh, at));
            at = self.before[at as usize];
        }
        nodes.push(Node::Vertex(start));
        nodes.reverse();
        let end_step = if last == NONE { EndStep::Along(start) } else { self.goal_step[last as usize] };
        let start_step = first_step(mesh, start, nodes[1]);
        let length = nodes.windows(2).map(|w| place_of(mesh, w[0]).distance(place_of(mesh, w[1]))).sum();
        FoundPath { nodes, length, start_step, end_step }
    }
}

/// The step from a landmark to the first node of a path.
fn first_step(mesh: &RefinableMesh, start: VertexId, node: Node) -> EndStep {
    match node {
        Node::Vertex(v) => EndStep::Along(v),
        Node::Midpoint(a, b) => {
            let inside = |h: &HalfedgeId| {
                let (v, w) = (mesh.head(*h), mesh.apex(*h));
                (v, w) == (a, b) || (v, w) == (b, a)
            };
            let h = mesh.star(start).find(inside);
            EndStep::After(h.map_or(a, |h| mesh.head(h)))
        }
    }
}

fn direct(mesh: &RefinableMesh, start: VertexId, end: VertexId, sectors: [&[Sector]; 2]) -> Option<f64> {
    let h = mesh.halfedge_between(start, end)?;
    let allowed = |v, sectors: &[Sector], h| {
        sectors.iter().any(|s| {
            let mut found = false;
            for_each_halfedge(mesh, v, s, |inside, is_edge| found |= inside == h && is_edge);
            found
        })
    };
    let free = !mesh.on_path[h] && allowed(start, sectors[0], h) && allowed(end, sectors[1], mesh.twins[h]);
    free.then(|| mesh.positions[start].distance(mesh.positions[end]))
}

/// Calls back with every halfedge whose triangle is in the sector, and whether the halfedge itself is inside too.
fn for_each_halfedge(mesh: &RefinableMesh, _v: VertexId, s: &Sector, mut call: impl FnMut(HalfedgeId, bool)) {
    let mut h = s.first;
    loop {
        call(h, s.bounded == Bounded::WholeStar || h != s.first);
        h = mesh.turn(h);
        if h == s.last || h == s.first {
            break;
        }
    }
}

/// Calls back with every free node next to a landmark inside the sectors.
fn for_each_end(
    mesh: &RefinableMesh,
    v: VertexId,
    sectors: &[Sector],
    mut call: impl FnMut(u32, EndStep, bool),
) {
    for sector in sectors {
        for_each_halfedge(mesh, v, sector, |h, edge_inside| {
            let neighbour = mesh.head(h);
            if edge_inside && !mesh.used[neighbour] {
                call(neighbour.0, EndStep::Along(neighbour), false);
            }
            let opposite = h.next();
            if !mesh.on_path[opposite] {
                call(midpoint_node(mesh, opposite), EndStep::After(neighbour), true);
            }
        });
    }
}

fn midpoint_node(mesh: &RefinableMesh, h: HalfedgeId) -> u32 {
    mesh.positions.len() as u32 + h.min(mesh.twins[h]).0
}

fn position(mesh: &RefinableMesh, node: u32) -> DVec3 {
    let vertices = mesh.positions.len() as u32;
    if node < vertices { mesh.positions[VertexId(node)] } else { mesh.midpoint(HalfedgeId(node - vertices)) }
}

fn named(mesh: &RefinableMesh, node: u32) -> Node {
    let vertices = mesh.positions.len() as u32;
    if node < vertices {
        Node::Vertex(VertexId(node))
    } else {
        let h = HalfedgeId(node - vertices);
        Node::Midpoint(mesh.tail(h), mesh.head(h))
    }
}

pub(super) fn place_of(mesh: &RefinableMesh, node: Node) -> DVec3 {
    match node {
        Node::Vertex(v) => mesh.positions[v],
        Node::Midpoint(a, b) => 0.5 * (mesh.positions[a] + mesh.positions[b]),
    }
}

/// Calls back with every free node linked to `node`, and whether the link touches a midpoint.
#[inline]
fn for_each_link(mesh: &RefinableMesh, node: u32, mut call: impl FnMut(u32, bool)) {
    let vertices = mesh.positions.len() as u32;
    if node < vertices {
        for h in mesh.star(VertexId(node)) {
            let neighbour = mesh.head(h);
            if !mesh.used[neighbour] && !mesh.on_path[h] {
                call(neighbour.0, false);
            }
            if !mesh.on_path[h.next()] {
                call(midpoint_node(mesh, h.next()), true);
            }
        }
        return;
    }
    let h = HalfedgeId(node - vertices);
    for side in [h, mesh.twins[h]] {
        let apex = mesh.apex(side);
        if !mesh.used[apex] {
            call(apex.0, true);
        }
        for other in [side.next(), side.prev()] {
            if !mesh.on_path[other] {
                call(midpoint_node(mesh, other), true);
            }
        }
    }
}

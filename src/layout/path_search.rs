//! Shortest paths over vertices and edge midpoints, within sectors at both ends.
//!
//! A* towards the goal's distances on the mesh without paths. Nodes are vertices off all paths and midpoints of edges off
//! all paths; links run inside triangles. Midpoints cannot be blocked: a path exists whenever both ends lie on one face of
//! the layout.

use super::allowance::Allowance;
use super::refinable::RefinableMesh;
use crate::math::min_queue::{MinQueue, Queued};
use crate::mesh::{HalfedgeId, VertexId};
use glam::DVec3;
use typed_index_collections::TiSlice;

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
    /// The link by which the path leaves its start.
    pub start_step: EndStep,
    /// The link by which the path reaches its end.
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

/// The halfedges around a landmark that a path may use: those strictly between two drawn paths.
pub(super) struct Sector {
    /// First outgoing halfedge; its triangle is inside.
    pub first: HalfedgeId,
    /// The outgoing halfedge that ends the sector.
    pub last: HalfedgeId,
    /// The kind of the sector's bounds.
    pub bounded: Bounded,
}

/// The kind of the bounds of a sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bounded {
    /// Both bounds are edges of paths, which a path may not use.
    ByPaths,
    /// There are no bounds: the sector is the whole star.
    WholeStar,
}

/// A query for a shortest path between two landmarks.
#[derive(Clone, Copy)]
pub(super) struct Query<'a> {
    pub ends: [VertexId; 2],
    /// The sectors in which the path may leave the start and reach the end.
    pub sectors: [&'a [Sector]; 2],
    /// Multiplies the length of links that touch a midpoint.
    pub midpoint_penalty: f64,
    /// Distance of each input vertex to the end on the mesh without paths; without it a search goes everywhere.
    pub to_end: Option<&'a TiSlice<VertexId, f64>>,
    /// The largest length of a path (the mesh has area 1).
    pub limit: f64,
}

/// No node.
const NONE: u32 = u32::MAX;

/// Queue entries that a search takes per node, at most, before it begins again without estimates. The estimate of A* is interpolated
/// from a mesh without paths, so a node may be settled before its distance is the least and come up again, mostly once or twice. On
/// meshes that winding paths have refined fivefold, two or three searches of a drawing had their nodes come up up to a hundred times,
/// and took all of its steps. Without estimates each node is settled once.
const MOST_TURNS: usize = 4;

/// The error of a search that took more queue entries than it may.
struct TooLong;

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
    /// Nodes with their distances, by estimated length of a path through them.
    queue: MinQueue<u32, f64>,
}

impl PathSearch {
    /// The shortest path from start to end that leaves and arrives inside the given sectors; `None` where there is none
    /// within the limit, or the allowance is used up.
    pub fn shortest(
        &mut self,
        mesh: &RefinableMesh,
        query: &Query<'_>,
        allowance: &mut Allowance<'_>,
    ) -> Option<FoundPath> {
        let turns = MOST_TURNS * (mesh.positions.len() + mesh.twins.len());
        self.within(turns, mesh, query, allowance).unwrap_or_else(|TooLong| {
            let without_estimate = Query { to_end: None, ..*query };
            self.within(usize::MAX, mesh, &without_estimate, allowance).unwrap_or(None)
        })
    }

    /// [`Self::shortest`] with at most this many queue entries (`turns`).
    fn within(
        &mut self,
        turns: usize,
        mesh: &RefinableMesh,
        query: &Query<'_>,
        allowance: &mut Allowance<'_>,
    ) -> Result<Option<FoundPath>, TooLong> {
        self.begin(mesh);
        self.mark_goal(mesh, query);
        let mut best = direct(mesh, query).unwrap_or(f64::INFINITY);
        let mut best_last = NONE;
        self.seed(mesh, query);
        let mut left = turns;
        while let Some(Queued { cost: priority, key: node, value: here }) = self.queue.pop() {
            if priority >= best || priority > query.limit {
                break;
            }
            if left == 0 {
                return Err(TooLong);
            }
            if !allowance.step() {
                return Ok(None);
            }
            left -= 1;
            if here > self.distance[node as usize] {
                continue;
            }
            if self.goal_stamp[node as usize] == self.now && here + self.goal_cost[node as usize] < best {
                best = here + self.goal_cost[node as usize];
                best_last = node;
            }
            let place = position(mesh, node);
            for_each_link(mesh, node, |next, touches_midpoint| {
                if self.is_nearer(next, here) {
                    return;
                }
                let factor = if touches_midpoint { query.midpoint_penalty } else { 1.0 };
                let through = here + factor * place.distance(position(mesh, next));
                self.relax(mesh, query, [next, node], through);
            });
        }
        Ok((best <= query.limit && best.is_finite()).then(|| self.path(mesh, query.ends, best_last)))
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

    /// Whether a node was reached by a way no longer than `here`, so that no way from there is shorter.
    fn is_nearer(&self, node: u32, here: f64) -> bool {
        self.stamp[node as usize] == self.now && self.distance[node as usize] <= here
    }

    fn relax(&mut self, mesh: &RefinableMesh, query: &Query<'_>, [node, before]: [u32; 2], distance: f64) {
        let i = node as usize;
        if self.stamp[i] != self.now || distance < self.distance[i] {
            let to_end = query.to_end.map_or(0.0, |to_end| estimate(mesh, to_end, node));
            let priority = distance + to_end;
            if priority > query.limit {
                return;
            }
            self.stamp[i] = self.now;
            self.distance[i] = distance;
            self.before[i] = before;
            self.queue.push(priority, node, distance);
        }
    }

    fn seed(&mut self, mesh: &RefinableMesh, query: &Query<'_>) {
        let from = mesh.positions[query.ends[0]];
        for_each_end(mesh, query.sectors[0], |node, _, is_midpoint| {
            let factor = if is_midpoint { query.midpoint_penalty } else { 1.0 };
            self.relax(mesh, query, [node, NONE], factor * from.distance(position(mesh, node)));
        });
    }

    fn mark_goal(&mut self, mesh: &RefinableMesh, query: &Query<'_>) {
        let to = mesh.positions[query.ends[1]];
        for_each_end(mesh, query.sectors[1], |node, step, is_midpoint| {
            let factor = if is_midpoint { query.midpoint_penalty } else { 1.0 };
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

/// Distance of a node to the end on the mesh without paths, interpolated from the input vertices.
fn estimate(mesh: &RefinableMesh, to_end: &TiSlice<VertexId, f64>, node: u32) -> f64 {
    let at = |v: VertexId| {
        if v.index() < to_end.len() {
            return to_end[v];
        }
        mesh.weights[v].iter().map(|&(input, weight)| weight * to_end[input]).sum()
    };
    let vertices = mesh.positions.len() as u32;
    if node < vertices {
        return at(VertexId(node));
    }
    let h = HalfedgeId(node - vertices);
    0.5 * (at(mesh.tail(h)) + at(mesh.head(h)))
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

fn direct(mesh: &RefinableMesh, query: &Query<'_>) -> Option<f64> {
    let ([start, end], sectors) = (query.ends, query.sectors);
    let h = mesh.halfedge_between(start, end)?;
    let allowed = |sectors: &[Sector], h| {
        sectors.iter().any(|s| {
            let mut found = false;
            for_each_halfedge(mesh, s, |inside, is_edge| found |= inside == h && is_edge);
            found
        })
    };
    let free = !mesh.on_path[h] && allowed(sectors[0], h) && allowed(sectors[1], mesh.twins[h]);
    free.then(|| mesh.positions[start].distance(mesh.positions[end]))
}

/// Calls back with every halfedge whose triangle is in the sector, and whether the halfedge itself is inside too.
fn for_each_halfedge(mesh: &RefinableMesh, s: &Sector, mut call: impl FnMut(HalfedgeId, bool)) {
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
fn for_each_end(mesh: &RefinableMesh, sectors: &[Sector], mut call: impl FnMut(u32, EndStep, bool)) {
    for sector in sectors {
        for_each_halfedge(mesh, sector, |h, edge_inside| {
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

pub(super) fn position(mesh: &RefinableMesh, node: u32) -> DVec3 {
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
pub(super) fn for_each_link(mesh: &RefinableMesh, node: u32, mut call: impl FnMut(u32, bool)) {
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
    for beside in [h, mesh.twins[h]] {
        let apex = mesh.apex(beside);
        if !mesh.used[apex] {
            call(apex.0, true);
        }
        for other in [beside.next(), beside.prev()] {
            if !mesh.on_path[other] {
                call(midpoint_node(mesh, other), true);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawing::Drawing;
    use super::super::twists::testing::figures;
    use super::*;
    use crate::landmarks::{LandmarkId, MeshSide};
    use crate::monitor::Silent;

    #[test]
    fn a_search_without_estimates_finds_no_longer_paths() {
        let (levels, landmarks) = figures();
        let drawing = Drawing::new(&levels[0].mesh, &levels[1].mesh, &landmarks);
        let distances = drawing.distances(&mut Silent).unwrap();
        let (mesh, at) = (&drawing.sides[0].mesh, &drawing.sides[0].landmarks);
        let star = |i: LandmarkId| {
            let any = mesh.outgoing[at[i]];
            [Sector { first: any, last: any, bounded: Bounded::WholeStar }]
        };
        let mut search = PathSearch::default();
        let mut silent = Silent;
        let mut allowance = Allowance::new(&mut silent);
        allowance.renew(usize::MAX);
        let first = LandmarkId(0);
        for end in at.keys().skip(1) {
            let query = Query {
                ends: [at[first], at[end]],
                sectors: [&star(first), &star(end)],
                midpoint_penalty: 1.0,
                to_end: Some(distances.field(MeshSide::Source, end)),
                limit: f64::INFINITY,
            };
            let usual = search.shortest(mesh, &query, &mut allowance).unwrap();
            let without = Query { to_end: None, ..query };
            let Ok(Some(found)) = search.within(usize::MAX, mesh, &without, &mut allowance) else {
                panic!("no path to {end:?}")
            };
            assert!(found.length <= usual.length * (1.0 + 1e-12));
            assert!(found.length > 0.98 * usual.length);
            assert!(search.within(0, mesh, &query, &mut allowance).is_err());
        }
    }
}

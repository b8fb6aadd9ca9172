//! The growing drawing of one graph on two meshes: the same rotation system at every landmark.

use super::allowance::Allowance;
use super::bounds::{Bounds, detour, worst};
use super::drawing_fault::DrawingFault;
use super::landmark_distances::LandmarkDistances;
use super::path_search::{Bounded, EndStep, FoundPath, Node, PathSearch, Query, Sector};
use super::refinable::RefinableMesh;
use crate::landmarks::{LandmarkId, Landmarks, MeshSide};
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor};
use typed_index_collections::{TiVec, ti_vec};

/// One of the two meshes with the paths drawn so far.
#[derive(Clone, Debug)]
pub(super) struct MeshWithPaths {
    pub mesh: RefinableMesh,
    /// Vertex of each landmark.
    pub landmarks: TiVec<LandmarkId, VertexId>,
    /// Vertices of each path, from its smaller landmark to its larger.
    pub paths: Vec<Vec<VertexId>>,
    /// Length of each path; the mesh has area 1.
    pub lengths: Vec<f64>,
}

/// A path between two landmarks planned on both meshes.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// The landmarks, smaller first.
    pub ends: [LandmarkId; 2],
    /// The path on the source and the one on the target.
    pub found: [FoundPath; 2],
}

/// Paths between landmarks drawn on both meshes.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    pub sides: [MeshWithPaths; 2],
    /// Landmarks of each path, smaller first.
    pub ends: Vec<[LandmarkId; 2]>,
    /// Paths around each landmark, counter-clockwise.
    pub rotation: TiVec<LandmarkId, Vec<usize>>,
}

/// The context in which paths are planned: search memory of both meshes, distances, the cost of midpoints, and the bounds of a drawing.
pub(super) struct Planner<'a> {
    searches: [PathSearch; 2],
    pub distances: &'a LandmarkDistances,
    pub midpoint_penalty: f64,
    /// A drawing whose detours sum to more is given up.
    pub most_detour: f64,
    bounds: Bounds,
    allowance: Allowance<'a>,
    /// Steps of the searches that were left to all drawings when the present one began.
    of_all: usize,
    /// Steps of the searches that were allowed to the present drawing.
    of_one: usize,
}

impl<'a> Planner<'a> {
    /// A planner with the allowance of one drawing; [`Self::begin`] allows another one.
    pub fn new(
        distances: &'a LandmarkDistances,
        midpoint_penalty: f64,
        monitor: &'a mut dyn Monitor,
    ) -> Self {
        let searches = [PathSearch::default(), PathSearch::default()];
        let bounds = Bounds::new(distances.landmark_count(), distances.vertex_counts());
        let allowance = Allowance::new(monitor);
        let most_detour = f64::INFINITY;
        let (of_all, of_one) = (usize::MAX, 0);
        let mut planner =
            Self { searches, distances, midpoint_penalty, most_detour, bounds, allowance, of_all, of_one };
        planner.begin();
        planner
    }

    /// Begins another drawing, with its own allowance.
    pub fn begin(&mut self) {
        self.of_all -= self.of_one - self.allowance.left();
        self.of_one = self.of_all.min(self.bounds.steps);
        self.allowance.renew(self.of_one);
    }

    /// Limits all drawings from here on, together, to the steps that one drawing may take.
    pub fn begin_together(&mut self) {
        (self.of_all, self.of_one) = (self.bounds.steps, self.bounds.steps);
        self.allowance.renew(self.of_one);
    }

    /// Tells the monitor how far the drawing is.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn tell(&mut self, fraction: f64) -> Result<(), Cancelled> {
        self.allowance.tell(fraction)
    }

    /// Draws the plan of a path; no plan, or a drawing beyond the bounds, is an error.
    ///
    /// # Errors
    /// [`DrawingFault`]; the drawing is unusable then.
    pub fn draw(
        &self,
        drawing: &mut Drawing,
        ends: [LandmarkId; 2],
        plan: Option<Plan>,
    ) -> Result<(), DrawingFault> {
        let no_path = DrawingFault::NoPath { landmarks: ends.map(usize::from) };
        let Some(plan) = plan else { return Err(self.fault(drawing).unwrap_or(no_path)) };
        drawing.draw(&plan).ok_or(no_path)?;
        let vertices = drawing.sides.each_ref().map(|side| side.mesh.positions.len());
        let is_worth_it =
            self.most_detour.is_infinite() || drawing.detour(self.distances) <= self.most_detour;
        if is_worth_it && self.bounds.has_room_for(vertices) {
            Ok(())
        } else {
            Err(drawing.tangled(self.distances))
        }
    }

    /// Checks that the paths of a spanning tree are within the bound of the detours.
    ///
    /// # Errors
    /// [`DrawingFault::Tangled`].
    pub fn check_tree(&self, drawing: &Drawing) -> Result<(), DrawingFault> {
        let is_straight = drawing.detour(self.distances) <= self.bounds.detour;
        if is_straight { Ok(()) } else { Err(drawing.tangled(self.distances)) }
    }

    /// Whether the monitor wants a result now.
    pub fn wants_result(&self) -> bool {
        self.allowance.wants_result()
    }

    /// Whether another search may find something: not when the allowance is used up.
    pub fn may_search(&self) -> bool {
        self.allowance.is_left()
    }

    /// Why searches found nothing, where the reason is the user's wish to stop or a used-up allowance.
    pub fn fault(&self, drawing: &Drawing) -> Option<DrawingFault> {
        match self.allowance.cancelled() {
            Some(stop) => Some(DrawingFault::Cancelled(stop)),
            None => (!self.allowance.is_left()).then(|| drawing.tangled(self.distances)),
        }
    }
}

/// Sectors at both ends of a path, named by their places in the rotation, that are joined by a face.
pub(super) type SlotPairs = [Vec<usize>; 2];

impl Drawing {
    /// Nothing drawn yet.
    pub fn new(source: &SurfaceMesh, target: &SurfaceMesh, landmarks: &Landmarks) -> Self {
        let bare = |mesh: &SurfaceMesh, vertices: &TiVec<LandmarkId, VertexId>| MeshWithPaths {
            mesh: RefinableMesh::new(mesh, &vertices.raw),
            landmarks: vertices.clone(),
            paths: Vec::new(),
            lengths: Vec::new(),
        };
        Self {
            sides: [bare(source, &landmarks.source), bare(target, &landmarks.target)],
            ends: Vec::new(),
            rotation: ti_vec![Vec::new(); landmarks.len()],
        }
    }

    /// Distances between the landmarks on both meshes; the drawing must have no paths.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn distances(&self, monitor: &mut dyn Monitor) -> Result<LandmarkDistances, Cancelled> {
        let [source, target] = &self.sides;
        let landmarks = [&source.landmarks.raw[..], &target.landmarks.raw];
        LandmarkDistances::without_paths([&source.mesh, &target.mesh], landmarks, monitor)
    }

    /// Plans a path: the shortest one on one mesh, and on the other the shortest one in the same sectors. Both meshes are tried as the
    /// first, and the shorter sum is kept.
    ///
    /// `limits` are the largest lengths of a path on source and target (areas are 1).
    pub fn plan(&self, planner: &mut Planner<'_>, ends: [LandmarkId; 2], limits: [f64; 2]) -> Option<Plan> {
        let allowed = ends.map(|i| (0..self.rotation[i].len().max(1)).collect());
        self.plan_within(planner, ends, &allowed, limits)
    }

    /// Like [`Self::plan`], with the sectors restricted to those given.
    pub fn plan_within(
        &self,
        planner: &mut Planner<'_>,
        ends: [LandmarkId; 2],
        allowed: &SlotPairs,
        limits: [f64; 2],
    ) -> Option<Plan> {
        let mut best: Option<Plan> = None;
        let mut tried: Option<[usize; 2]> = None;
        for free in MeshSide::BOTH {
            let sectors = [0, 1].map(|e| {
                let mut all = self.sectors(free, ends[e]).into_iter().enumerate().collect::<Vec<_>>();
                all.retain(|(slot, _)| allowed[e].contains(slot));
                all.into_iter().map(|(_, sector)| sector).collect::<Vec<_>>()
            });
            let found = self.search(planner, free, ends, [&sectors[0], &sectors[1]], limits[free]);
            let first = found?;
            let slots = self.slots(free, ends, &first)?;
            if tried == Some(slots) {
                continue;
            }
            tried = Some(slots);
            let other = free.other();
            let Some(second) = self.search_in_slots(planner, other, ends, slots, limits[other]) else {
                continue;
            };
            let found = match free {
                MeshSide::Source => [first, second],
                MeshSide::Target => [second, first],
            };
            let plan = Plan { ends, found };
            if best.as_ref().is_none_or(|b| plan.length() < b.length()) {
                best = Some(plan);
            }
        }
        best
    }

    /// Plans a path with its sectors given: it goes in after place `slots[e]` of the rotation at end `e`.
    pub fn plan_in_slots(
        &self,
        planner: &mut Planner<'_>,
        ends: [LandmarkId; 2],
        slots: [usize; 2],
    ) -> Option<Plan> {
        let source = self.search_in_slots(planner, MeshSide::Source, ends, slots, f64::INFINITY)?;
        let target = self.search_in_slots(planner, MeshSide::Target, ends, slots, f64::INFINITY)?;
        Some(Plan { ends, found: [source, target] })
    }

    /// The shortest path on one mesh that goes in after place `slots[e]` of the rotation at end `e`.
    pub fn search_in_slots(
        &self,
        planner: &mut Planner<'_>,
        side: MeshSide,
        ends: [LandmarkId; 2],
        slots: [usize; 2],
        limit: f64,
    ) -> Option<FoundPath> {
        let [a, b] = [0, 1].map(|e| self.sectors(side, ends[e]).swap_remove(slots[e]));
        self.search(planner, side, ends, [&[a], &[b]], limit)
    }

    fn search(
        &self,
        planner: &mut Planner<'_>,
        side: MeshSide,
        ends: [LandmarkId; 2],
        sectors: [&[Sector]; 2],
        limit: f64,
    ) -> Option<FoundPath> {
        let MeshWithPaths { mesh, landmarks, .. } = &self.sides[side];
        let query = Query {
            ends: ends.map(|i| landmarks[i]),
            sectors,
            midpoint_penalty: planner.midpoint_penalty,
            to_end: Some(planner.distances.field(side, ends[1])),
            limit,
        };
        planner.searches[side].shortest(mesh, &query, &mut planner.allowance)
    }

    /// The number of the face of the drawing that follows counter-clockwise after each place in the rotation of each landmark.
    ///
    /// Faces of a connected drawing are discs: two places can be joined when their face is the same.
    pub fn faces_by_slot(&self) -> TiVec<LandmarkId, Vec<usize>> {
        let mut faces: TiVec<LandmarkId, Vec<usize>> =
            self.rotation.iter().map(|r| vec![usize::MAX; r.len()]).collect();
        let mut count = 0;
        for i in self.rotation.keys() {
            for k in 0..faces[i].len() {
                let (mut at, mut slot) = (i, k);
                if faces[at][slot] != usize::MAX {
                    continue;
                }
                while faces[at][slot] == usize::MAX {
                    faces[at][slot] = count;
                    // Along the path whose left side is this face, then to the place before it at its other end.
                    let path = self.rotation[at][slot];
                    let [a, b] = self.ends[path];
                    at = if a == at { b } else { a };
                    let n = self.rotation[at].len();
                    let back = self.rotation[at].iter().position(|&p| p == path).unwrap_or(0);
                    slot = (back + n - 1) % n;
                }
                count += 1;
            }
        }
        faces
    }

    /// Whether a plan made earlier can still be drawn as it is: more paths only lengthen, so it is then still the best.
    pub fn still_valid(&self, plan: &Plan) -> bool {
        self.sides.iter().zip(&plan.found).all(|(drawn, found)| {
            let nodes = &found.nodes;
            let inner = &nodes[1..nodes.len() - 1];
            inner.iter().all(|&node| drawn.is_free(node))
                && nodes.windows(2).all(|link| drawn.is_linked(link[0], link[1]))
        }) && {
            let slots = MeshSide::BOTH.map(|side| self.slots(side, plan.ends, &plan.found[side]));
            slots[0].is_some() && slots[0] == slots[1]
        }
    }

    /// Draws a plan. Returns `None`, leaving the drawing unusable, where a node is not free any more.
    pub fn draw(&mut self, plan: &Plan) -> Option<()> {
        let slots = self.slots(MeshSide::Source, plan.ends, &plan.found[0])?;
        for (side, found) in self.sides.iter_mut().zip(&plan.found) {
            side.realise(&found.nodes)?;
        }
        let path = self.ends.len();
        self.ends.push(plan.ends);
        for (end, slot) in plan.ends.into_iter().zip(slots) {
            let around = &mut self.rotation[end];
            around.insert((slot + 1).min(around.len()), path);
        }
        Some(())
    }

    /// Takes a path away; the last path gets its number. The vertices that it made stay.
    pub fn erase(&mut self, path: usize) {
        for side in &mut self.sides {
            side.unmark(path);
            side.paths.swap_remove(path);
            side.lengths.swap_remove(path);
        }
        let ends = self.ends.swap_remove(path);
        ends.iter().for_each(|&i| self.rotation[i].retain(|&p| p != path));
        let last = self.ends.len();
        if path < last {
            for i in self.ends[path] {
                self.rotation[i].iter_mut().filter(|p| **p == last).for_each(|p| *p = path);
            }
        }
    }

    /// Takes the vertices that erased paths left behind out of both meshes. Plans made before are void.
    pub fn thin(&mut self) {
        for side in &mut self.sides {
            let numbers = side.mesh.thin();
            side.paths.iter_mut().flatten().for_each(|v| *v = numbers[*v]);
        }
    }

    /// The sum of the detours of all paths ([`super::LayoutReport::detour`]).
    pub fn detour(&self, distances: &LandmarkDistances) -> f64 {
        (0..self.ends.len()).map(|path| self.detour_of(path, distances)).sum()
    }

    /// The detour of a path, summed over both meshes ([`super::LayoutReport::detour`]).
    fn detour_of(&self, path: usize, distances: &LandmarkDistances) -> f64 {
        let shortest = distances.between(self.ends[path]);
        (0..2).map(|s| detour(self.sides[s].lengths[path] / shortest[s])).sum()
    }

    /// The error of a drawing beyond its bounds, with the landmarks whose paths have the largest detours.
    pub fn tangled(&self, distances: &LandmarkDistances) -> DrawingFault {
        let mut blame: TiVec<LandmarkId, f64> = ti_vec![0.0; self.rotation.len()];
        for (path, ends) in self.ends.iter().enumerate() {
            ends.iter().for_each(|&landmark| blame[landmark] += self.detour_of(path, distances));
        }
        DrawingFault::Tangled { near: worst(&blame.raw) }
    }

    /// Replaces a path on one mesh by another in the sector beside it.
    pub fn exchange(&mut self, side: MeshSide, path: usize, found: &FoundPath) -> Option<()> {
        let drawn = &mut self.sides[side];
        drawn.realise(&found.nodes)?;
        drawn.unmark(path);
        drawn.paths.swap_remove(path);
        drawn.lengths.swap_remove(path);
        Some(())
    }

    /// The outgoing halfedge of a path at one of its landmarks.
    pub fn path_halfedge(&self, side: MeshSide, landmark: LandmarkId, path: usize) -> Option<HalfedgeId> {
        let vertices = &self.sides[side].paths[path];
        let n = vertices.len();
        let at_start = self.ends[path][0] == landmark;
        let (from, to) =
            if at_start { (vertices[0], vertices[1]) } else { (vertices[n - 1], vertices[n - 2]) };
        self.sides[side].mesh.halfedge_between(from, to)
    }

    fn sectors(&self, side: MeshSide, landmark: LandmarkId) -> Vec<Sector> {
        let around = &self.rotation[landmark];
        let halfedges: Vec<_> =
            around.iter().filter_map(|&p| self.path_halfedge(side, landmark, p)).collect();
        if halfedges.is_empty() {
            let any = self.sides[side].mesh.outgoing[self.sides[side].landmarks[landmark]];
            return vec![Sector { first: any, last: any, bounded: Bounded::WholeStar }];
        }
        let next = |k: usize| halfedges[(k + 1) % halfedges.len()];
        (0..halfedges.len())
            .map(|k| Sector { first: halfedges[k], last: next(k), bounded: Bounded::ByPaths })
            .collect()
    }

    fn slots(&self, side: MeshSide, ends: [LandmarkId; 2], found: &FoundPath) -> Option<[usize; 2]> {
        Some([self.slot(side, ends[0], found.start_step)?, self.slot(side, ends[1], found.end_step)?])
    }

    /// The place of the rotation after which a path with this end step goes in.
    fn slot(&self, side: MeshSide, landmark: LandmarkId, step: EndStep) -> Option<usize> {
        let around = &self.rotation[landmark];
        if around.is_empty() {
            return Some(0);
        }
        let MeshWithPaths { mesh, landmarks, .. } = &self.sides[side];
        let (EndStep::Along(neighbour) | EndStep::After(neighbour)) = step;
        let start = mesh.halfedge_between(landmarks[landmark], neighbour)?;
        let mut h = start;
        while !mesh.on_path[h] {
            h = mesh.twins[h].next();
            if h == start {
                return None;
            }
        }
        if h == start && matches!(step, EndStep::Along(_)) {
            return None;
        }
        around.iter().position(|&p| self.path_halfedge(side, landmark, p) == Some(h))
    }
}

impl Plan {
    /// Sum of both lengths.
    pub fn length(&self) -> f64 {
        self.found[0].length + self.found[1].length
    }
}

impl MeshWithPaths {
    fn is_free(&self, node: Node) -> bool {
        match node {
            Node::Vertex(v) => !self.mesh.used[v],
            Node::Midpoint(a, b) => self.mesh.halfedge_between(a, b).is_some_and(|h| !self.mesh.on_path[h]),
        }
    }

    /// Whether two nodes still share a triangle that nothing cuts between them.
    fn is_linked(&self, from: Node, to: Node) -> bool {
        let mesh = &self.mesh;
        match (from, to) {
            (Node::Vertex(v), Node::Vertex(w)) => {
                mesh.halfedge_between(v, w).is_some_and(|h| !mesh.on_path[h])
            }
            (Node::Vertex(v), Node::Midpoint(a, b)) | (Node::Midpoint(a, b), Node::Vertex(v)) => mesh
                .halfedge_between(a, b)
                .is_some_and(|h| mesh.apex(h) == v || mesh.apex(mesh.twins[h]) == v),
            (Node::Midpoint(a, b), Node::Midpoint(c, d)) => mesh.halfedge_between(a, b).is_some_and(|h| {
                mesh.halfedge_between(c, d).is_some_and(|g| {
                    [h, mesh.twins[h]]
                        .iter()
                        .any(|x| x.face() == g.face() || x.face() == mesh.twins[g].face())
                })
            }),
        }
    }

    /// Makes the vertices and edges of a path free again.
    fn unmark(&mut self, path: usize) {
        let vertices = &self.paths[path];
        for pair in vertices.windows(2) {
            if let Some(h) = self.mesh.halfedge_between(pair[0], pair[1]) {
                self.mesh.unmark_path(h);
            }
        }
        vertices[1..vertices.len() - 1].iter().for_each(|&v| self.mesh.used[v] = false);
    }

    /// Splits the edges of the path's midpoints and marks its edges.
    fn realise(&mut self, nodes: &[Node]) -> Option<()> {
        let mut vertices = Vec::with_capacity(nodes.len());
        for &node in nodes {
            vertices.push(match node {
                Node::Vertex(v) => v,
                Node::Midpoint(a, b) => {
                    let h = self.mesh.halfedge_between(a, b)?;
                    self.mesh.split_edge(h)
                }
            });
        }
        let mut length = 0.0;
        for pair in vertices.windows(2) {
            let h = self.mesh.halfedge_between(pair[0], pair[1])?;
            self.mesh.mark_path(h);
            length += self.mesh.positions[pair[0]].distance(self.mesh.positions[pair[1]]);
        }
        vertices.iter().for_each(|&v| self.mesh.used[v] = true);
        self.paths.push(vertices);
        self.lengths.push(length);
        Some(())
    }
}

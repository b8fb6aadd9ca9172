//! The overlay's combinatorics: source and target edges cut at their crossings, as a planar map of darts.
//!
//! A dart is a piece of a halfedge between two neighbouring crossings or ends. The next dart around the cell on its left
//! follows from the crossing's orientation alone; at a landmark the source's star is merged into the target's wedges.

use super::OverlayError;
use super::seats::Seats;
use super::trace::Traces;
use crate::mesh::{HalfedgeId, VertexId};
use crate::surface_map::compose::Parametrised;
use glam::DVec2;
use typed_index_collections::TiVec;

/// Part `.1` (0 is the first) of a halfedge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dart {
    Source(HalfedgeId, u32),
    Target(HalfedgeId, u32),
}

/// Where a dart starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// A source vertex; landmarks are source vertices.
    Source(VertexId),
    /// A target vertex that is no landmark.
    Target(VertexId),
    /// A crossing, by its number.
    Crossing(u32),
}

/// The darts and how they follow each other.
#[derive(Clone, Debug, Default)]
pub(super) struct Arrangement {
    /// By target halfedge: the range of its edge in `order`.
    ranges: TiVec<HalfedgeId, [u32; 2]>,
    /// Crossings along each target edge, in the direction of its smaller halfedge.
    order: Vec<u32>,
    /// Place of each crossing on its target edge.
    ranks: Vec<u32>,
    /// Number of the first dart of each source halfedge.
    source_darts: TiVec<HalfedgeId, u32>,
    /// Number of the first dart of each target halfedge.
    target_darts: TiVec<HalfedgeId, u32>,
    /// At landmarks, by outgoing source halfedge: the next outgoing dart clockwise.
    source_turns: TiVec<HalfedgeId, Option<Dart>>,
    /// At landmarks, by outgoing target halfedge: the next outgoing dart clockwise.
    target_turns: TiVec<HalfedgeId, Option<Dart>>,
    /// At landmarks, by target halfedge: the last source halfedge in the wedge that it begins.
    last_in_wedge: TiVec<HalfedgeId, Option<HalfedgeId>>,
    /// By target vertex: its landmark as a source vertex.
    shared: TiVec<VertexId, Option<VertexId>>,
    darts: usize,
}

impl Arrangement {
    /// Sorts the crossings along the target edges and merges the stars of the landmarks.
    pub fn fill(
        &mut self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        (seats, traces): (&Seats, &Traces),
    ) -> Result<(), OverlayError> {
        self.sort(target, traces);
        self.number(source, target, traces);
        self.shared.clear();
        self.shared.resize(target.patched.mesh.vertex_count(), None);
        let landmarks = source.patched.landmark_vertices.iter().zip(&target.patched.landmark_vertices);
        for (&v, &w) in landmarks {
            self.shared[w] = Some(v);
        }
        self.merge_stars(source, target, seats)
    }

    /// Number of darts.
    pub fn dart_count(&self) -> usize {
        self.darts
    }

    /// The number of a dart.
    pub fn number_of(&self, dart: Dart) -> usize {
        match dart {
            Dart::Source(h, i) => self.source_darts[h] as usize + i as usize,
            Dart::Target(x, i) => self.target_darts[x] as usize + i as usize,
        }
    }

    /// Number of darts of a target halfedge.
    pub fn target_parts(&self, x: HalfedgeId) -> u32 {
        let [begin, end] = self.ranges[x];
        end - begin + 1
    }

    /// Counting sort by target edge, then by place on the edge; equal places by number.
    fn sort(&mut self, target: Parametrised<'_>, traces: &Traces) {
        let mesh = &target.patched.mesh;
        let edge = |x: HalfedgeId| x.min(mesh.twin(x));
        self.ranges.clear();
        self.ranges.resize(mesh.face_count() * 3, [0; 2]);
        for crossing in &traces.crossings {
            self.ranges[edge(crossing.exit)][1] += 1;
        }
        let mut begin = 0;
        for x in mesh.edges() {
            let count = self.ranges[x][1];
            // The end grows back as the crossings are put in.
            self.ranges[x] = [begin, begin];
            begin += count;
        }
        self.order.clear();
        self.order.resize(traces.crossings.len(), 0);
        for (c, crossing) in traces.crossings.iter().enumerate() {
            let range = &mut self.ranges[edge(crossing.exit)];
            self.order[range[1] as usize] = c as u32;
            range[1] += 1;
        }
        self.ranks.clear();
        self.ranks.resize(traces.crossings.len(), 0);
        for x in mesh.edges() {
            let [begin, end] = self.ranges[x];
            self.ranges[mesh.twin(x)] = [begin, end];
            let place = |c: u32| {
                let crossing = &traces.crossings[c as usize];
                if crossing.exit == x { crossing.along_target } else { 1.0 - crossing.along_target }
            };
            let along = &mut self.order[begin as usize..end as usize];
            along.sort_unstable_by(|&a, &b| place(a).total_cmp(&place(b)).then(a.cmp(&b)));
            for (rank, &c) in along.iter().enumerate() {
                self.ranks[c as usize] = rank as u32;
            }
        }
    }

    fn number(&mut self, source: Parametrised<'_>, target: Parametrised<'_>, traces: &Traces) {
        let mut next = 0;
        self.source_darts.clear();
        for h in source.patched.mesh.halfedges() {
            self.source_darts.push(next);
            let [begin, end] = traces.ranges[h];
            next += end - begin + 1;
        }
        self.target_darts.clear();
        for x in target.patched.mesh.halfedges() {
            self.target_darts.push(next);
            let [begin, end] = self.ranges[x];
            next += end - begin + 1;
        }
        self.darts = next as usize;
    }

    fn merge_stars(
        &mut self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        seats: &Seats,
    ) -> Result<(), OverlayError> {
        let [mesh, below] = [&source.patched.mesh, &target.patched.mesh];
        self.source_turns.clear();
        self.source_turns.resize(mesh.face_count() * 3, None);
        self.target_turns.clear();
        self.target_turns.resize(below.face_count() * 3, None);
        self.last_in_wedge.clear();
        self.last_in_wedge.resize(below.face_count() * 3, None);
        let landmarks = source.patched.landmark_vertices.iter().zip(&target.patched.landmark_vertices);
        for (&v, &w) in landmarks {
            let lost = OverlayError::Landmark { vertex: v.index() };
            for h in mesh.star(v) {
                let following = mesh.twin(h.prev());
                let [Some(wedge), Some(next)] = [h, following].map(|g| seats.wedges[g]) else {
                    return Err(lost);
                };
                let [along, turned] = [h, following].map(|g| heading(seats, g));
                if wedge == next && along.perp_dot(turned) >= 0.0 {
                    self.source_turns[following] = Some(Dart::Source(h, 0));
                } else {
                    self.source_turns[following] = Some(Dart::Target(next, 0));
                    if self.last_in_wedge[wedge].replace(h).is_some() {
                        return Err(lost);
                    }
                }
            }
            for x in below.star(w) {
                let before = below.twin(x).next();
                let last = self.last_in_wedge[before];
                let turn = last.map_or(Dart::Target(before, 0), |h| Dart::Source(h, 0));
                self.target_turns[x] = Some(turn);
            }
        }
        Ok(())
    }

    /// The dart that follows around the cell on the left of a dart.
    pub fn next(
        &self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        (traces, dart): (&Traces, Dart),
    ) -> Dart {
        match dart {
            Dart::Source(h, i) => {
                let twin = source.patched.mesh.twin(h);
                let [begin, end] = traces.ranges[h];
                if i == end - begin {
                    return self.source_turns[twin].unwrap_or(Dart::Source(h.next(), 0));
                }
                // A turn to the left onto the target edge: along `exit` for the trace's own direction, against it else.
                let c = if h < twin { begin + i } else { end - 1 - i };
                let exit = traces.crossings[c as usize].exit;
                let x = if h < twin { exit } else { target.patched.mesh.twin(exit) };
                Dart::Target(x, self.place(target, x, c) + 1)
            }
            Dart::Target(x, i) => {
                let twin = target.patched.mesh.twin(x);
                let [begin, end] = self.ranges[x];
                if i == end - begin {
                    return self.target_turns[twin].unwrap_or(Dart::Target(x.next(), 0));
                }
                let c = self.order[if x < twin { begin + i } else { end - 1 - i } as usize];
                let crossing = &traces.crossings[c as usize];
                let [first, last] = traces.ranges[crossing.edge];
                // Left of a walk along `exit` the trace comes from; left of a walk against it the trace goes on.
                if x == crossing.exit {
                    Dart::Source(source.patched.mesh.twin(crossing.edge), last - c)
                } else {
                    Dart::Source(crossing.edge, c - first + 1)
                }
            }
        }
    }

    /// Which crossing of a target halfedge c is, counted in the halfedge's direction.
    fn place(&self, target: Parametrised<'_>, x: HalfedgeId, c: u32) -> u32 {
        let rank = self.ranks[c as usize];
        let [begin, end] = self.ranges[x];
        if x < target.patched.mesh.twin(x) { rank } else { end - begin - 1 - rank }
    }

    /// Where a dart starts.
    pub fn origin(
        &self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        (traces, dart): (&Traces, Dart),
    ) -> Origin {
        match dart {
            Dart::Source(h, 0) => Origin::Source(source.patched.mesh.tail(h)),
            Dart::Source(h, i) => {
                let [begin, end] = traces.ranges[h];
                let is_forward = h < source.patched.mesh.twin(h);
                Origin::Crossing(if is_forward { begin + i - 1 } else { end - i })
            }
            Dart::Target(x, 0) => {
                let w = target.patched.mesh.tail(x);
                self.shared[w].map_or(Origin::Target(w), Origin::Source)
            }
            Dart::Target(x, i) => {
                let [begin, end] = self.ranges[x];
                let is_forward = x < target.patched.mesh.twin(x);
                Origin::Crossing(self.order[if is_forward { begin + i - 1 } else { end - i } as usize])
            }
        }
    }
}

/// Direction of a source halfedge at a landmark, in the plane of the target face that it points into.
fn heading(seats: &Seats, h: HalfedgeId) -> DVec2 {
    seats.seats[h].motion.rotate(seats.corners[h.next()] - seats.corners[h])
}

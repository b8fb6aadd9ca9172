//! The overlay's combinatorics: source and target edges cut at their crossings, as a planar map of darts.
//!
//! A dart is a piece of a halfedge between two neighbouring crossings or ends. The next dart around the cell on its left
//! follows from the crossing's orientation alone; at a landmark the source's star is merged into the target's wedges.

use super::OverlayError;
use super::seats::Seats;
use super::trace::Traces;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::surface_map::compose::Parametrised;
use glam::DVec2;
use typed_index_collections::TiVec;

/// A part of a halfedge between two neighbouring crossings or ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dart {
    /// The next dart around the cell on the left.
    pub next: u32,
    /// The overlay vertex where it starts.
    pub origin: u32,
    /// Its halfedge: of the source, or, increased by the number of source halfedges, of the target.
    halfedge: u32,
    /// Of a source dart the target face below it.
    pub below: FaceId,
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
    source_turns: TiVec<HalfedgeId, Option<u32>>,
    /// At landmarks, by outgoing target halfedge: the next outgoing dart clockwise.
    target_turns: TiVec<HalfedgeId, Option<u32>>,
    /// At landmarks, by target halfedge: the last source halfedge in the wedge that it begins.
    last_in_wedge: TiVec<HalfedgeId, Option<HalfedgeId>>,
    /// Overlay vertex of each target vertex; source vertices keep their numbers, so that landmarks have them.
    target_numbers: TiVec<VertexId, u32>,
    /// Overlay vertex of the first crossing.
    pub first_crossing: u32,
    source_halfedges: u32,
    /// All darts: those of each source halfedge in order, then those of each target halfedge.
    pub darts: Vec<Dart>,
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
        self.merge_stars(source, target, seats)?;
        self.link_ends(source, target, seats);
        self.link_crossings(traces);
        Ok(())
    }

    /// The source halfedge of a dart, or its target halfedge.
    pub fn halfedge(&self, dart: &Dart) -> Side {
        match dart.halfedge.checked_sub(self.source_halfedges) {
            None => Side::Source(HalfedgeId(dart.halfedge)),
            Some(x) => Side::Target(HalfedgeId(x)),
        }
    }

    /// Which part of its source halfedge a dart is.
    pub fn source_part(&self, h: HalfedgeId, number: u32) -> u32 {
        number - self.source_darts[h]
    }

    /// The first dart of a target halfedge.
    pub fn target_dart(&self, x: HalfedgeId) -> u32 {
        self.target_darts[x]
    }

    /// Counting sort by target edge, then by place on the edge; equal places by number.
    fn sort(&mut self, target: Parametrised<'_>, traces: &Traces) {
        let mesh = target.mesh;
        let edge = |[exit, entered]: [HalfedgeId; 2]| exit.min(entered);
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
                if crossing.exit[0] == x { crossing.along_target } else { 1.0 - crossing.along_target }
            };
            let along = &mut self.order[begin as usize..end as usize];
            along.sort_unstable_by(|&a, &b| place(a).total_cmp(&place(b)).then(a.cmp(&b)));
            for (rank, &c) in along.iter().enumerate() {
                self.ranks[c as usize] = rank as u32;
            }
        }
    }

    fn number(&mut self, source: Parametrised<'_>, target: Parametrised<'_>, traces: &Traces) {
        let [mesh, below] = [source.mesh, target.mesh];
        self.target_numbers.clear();
        self.target_numbers.resize(below.vertex_count(), u32::MAX);
        let landmarks = source.landmark_vertices.iter().zip(target.landmark_vertices);
        landmarks.for_each(|(&v, &w)| self.target_numbers[w] = v.0);
        let mut vertex = mesh.vertex_count() as u32;
        for number in self.target_numbers.iter_mut().filter(|n| **n == u32::MAX) {
            *number = vertex;
            vertex += 1;
        }
        self.first_crossing = vertex;
        self.source_halfedges = mesh.face_count() as u32 * 3;
        self.darts.clear();
        self.source_darts.clear();
        self.target_darts.clear();
        let mut put = |[begin, end]: [u32; 2], halfedge: u32, origin: u32| {
            let first = self.darts.len() as u32;
            let dart = Dart { next: 0, origin, halfedge, below: FaceId(0) };
            self.darts.extend(std::iter::repeat_n(dart, (end - begin + 1) as usize));
            first
        };
        for h in mesh.halfedges() {
            self.source_darts.push(put(traces.ranges[h], h.0, mesh.tail(h).0));
        }
        for x in below.halfedges() {
            let origin = self.target_numbers[below.tail(x)];
            self.target_darts.push(put(self.ranges[x], x.0 + self.source_halfedges, origin));
        }
    }

    fn merge_stars(
        &mut self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        seats: &Seats,
    ) -> Result<(), OverlayError> {
        let [mesh, below] = [source.mesh, target.mesh];
        self.source_turns.clear();
        self.source_turns.resize(mesh.face_count() * 3, None);
        self.target_turns.clear();
        self.target_turns.resize(below.face_count() * 3, None);
        self.last_in_wedge.clear();
        self.last_in_wedge.resize(below.face_count() * 3, None);
        let landmarks = source.landmark_vertices.iter().zip(target.landmark_vertices);
        for (&v, &w) in landmarks {
            let lost = OverlayError::Landmark { vertex: v.index() };
            for h in mesh.star(v) {
                let following = mesh.twin(h.prev());
                let [Some(wedge), Some(next)] = [h, following].map(|g| seats.wedges[g]) else {
                    return Err(lost);
                };
                let [along, turned] = [h, following].map(|g| heading(seats, g));
                if wedge == next && along.perp_dot(turned) >= 0.0 {
                    self.source_turns[following] = Some(self.source_darts[h]);
                } else {
                    self.source_turns[following] = Some(self.target_darts[next]);
                    if self.last_in_wedge[wedge].replace(h).is_some() {
                        return Err(lost);
                    }
                }
            }
            for x in below.star(w) {
                let before = below.twin(x).next();
                let last = self.last_in_wedge[before];
                let turn = last.map_or(self.target_darts[before], |h| self.source_darts[h]);
                self.target_turns[x] = Some(turn);
            }
        }
        Ok(())
    }

    /// What follows the last part of each halfedge, and the target faces below both ends of source edges.
    fn link_ends(&mut self, source: Parametrised<'_>, target: Parametrised<'_>, seats: &Seats) {
        let [mesh, below] = [source.mesh, target.mesh];
        let end = |darts: &TiVec<HalfedgeId, u32>, h: usize, after: usize| {
            darts.get(HalfedgeId::from(h + 1)).map_or(after, |&d| d as usize) - 1
        };
        let between = self.target_darts.first().map_or(0, |&d| d as usize);
        for h in mesh.halfedges() {
            let twin = mesh.twin(h);
            let last = end(&self.source_darts, h.index(), between);
            self.darts[last].next = self.source_turns[twin].unwrap_or(self.source_darts[h.next()]);
            // The trace begins at the smaller halfedge's seat: its first part and the other's last part lie there.
            let part = if h < twin { self.source_darts[h] as usize } else { last };
            self.darts[part].below = seats.seats[h.min(twin)].face;
        }
        let all = self.darts.len();
        for x in below.halfedges() {
            let last = end(&self.target_darts, x.index(), all);
            let turn = self.target_turns[below.twin(x)];
            self.darts[last].next = turn.unwrap_or(self.target_darts[x.next()]);
        }
    }

    /// The four darts that end and the four that start at each crossing. The trace, seen going east, crosses `exit` going
    /// north; each dart turns to its left.
    fn link_crossings(&mut self, traces: &Traces) {
        for (c, crossing) in traces.crossings.iter().enumerate() {
            let ([e, back], [x, down]) = (crossing.edge, crossing.exit);
            let [begin, end] = traces.ranges[e];
            // How many crossings lie behind and before on either edge.
            let (west, east) = (c as u32 - begin, end - 1 - c as u32);
            let [begin, end] = self.ranges[x];
            let (rank, others) = (self.ranks[c], end - begin - 1);
            let (south, north) = if x < down { (rank, others - rank) } else { (others - rank, rank) };
            let arriving = [
                self.source_darts[e] + west,
                self.target_darts[x] + south,
                self.source_darts[back] + east,
                self.target_darts[down] + north,
            ];
            for k in 0..4 {
                let leaving = arriving[(k + 1) % 4] + 1;
                self.darts[arriving[k] as usize].next = leaving;
                self.darts[leaving as usize].origin = self.first_crossing + c as u32;
            }
            let entered = down.face();
            self.darts[arriving[0] as usize + 1].below = entered;
            self.darts[arriving[2] as usize].below = entered;
        }
    }
}

/// A halfedge of one of the meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Source(HalfedgeId),
    Target(HalfedgeId),
}

/// Direction of a source halfedge at a landmark, in the plane of the target face that it points into.
fn heading(seats: &Seats, h: HalfedgeId) -> DVec2 {
    seats.seats[h].motion.rotate(seats.corners[h.next()] - seats.corners[h])
}

//! The overlay's combinatorics: source and target edges cut at their crossings, as a planar map of darts.
//!
//! A dart is a piece of a halfedge between two neighbouring crossings or ends. The next dart around the cell on its left
//! follows from the crossing's orientation alone; at a landmark the source's star is merged into the target's wedges.

use super::corner_locations::CornerLocations;
use super::pieces::OverlayError;
use super::trace::Traced;
use crate::landmarks::MeshSide;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::monitor::{Monitor, Step};
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;
use typed_index_collections::TiVec;

/// No number: of a vertex or of a face.
const NONE: u32 = u32::MAX;

/// A part of a halfedge between two neighbouring crossings or ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dart {
    /// The overlay vertex where it starts.
    pub origin: u32,
    /// The number of its source halfedge, or the number of its target halfedge plus the number of source halfedges.
    halfedge: u32,
    /// For a source dart the target face that it lies in.
    pub below: FaceId,
}

/// A crossing among those of its target edge.
#[derive(Clone, Copy, Debug, Default)]
struct OnTarget {
    /// The place on the edge's smaller halfedge, 0 to 1.
    along: f64,
    /// The number of the crossing.
    crossing: u32,
    /// Whether the trace leaves a face through the smaller halfedge.
    leaves: bool,
}

/// The darts of the planar map, each with the next one around its cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Arrangement {
    /// The range in `order` of the edge of each target halfedge.
    ranges: TiVec<HalfedgeId, [u32; 2]>,
    /// Crossings along each target edge, in the direction of its smaller halfedge.
    order: Vec<OnTarget>,
    /// The darts that arrive at each crossing on the target edge: along `exit`, and along its twin.
    arriving: Vec<[u32; 2]>,
    /// Number of the first dart of each source halfedge. Both halfedges of an edge follow each other.
    source_darts: TiVec<HalfedgeId, u32>,
    /// Number of the first dart of each target halfedge.
    target_darts: TiVec<HalfedgeId, u32>,
    /// At the present landmark, by target halfedge: the last source halfedge in the wedge that it begins.
    last_in_wedge: TiVec<HalfedgeId, Option<HalfedgeId>>,
    /// The next dart after each dart around the cell on its left. Source darts come first.
    pub next: Vec<u32>,
    /// Overlay vertex of each target vertex; source vertices keep their numbers, so that landmarks have them.
    target_numbers: TiVec<VertexId, u32>,
    /// Overlay vertex of the first crossing.
    pub first_crossing: u32,
    /// Number of the source's halfedges.
    source_halfedges: u32,
    /// All darts; filled by [`Self::describe`].
    pub darts: Vec<Dart>,
}

impl Arrangement {
    /// Sorts the crossings along the target edges, links the darts and merges the stars of the landmarks.
    pub fn fill(&mut self, traced: Traced<'_>, monitor: &mut dyn Monitor) -> Result<(), OverlayError> {
        self.sort(traced);
        monitor.step(Step::default())?;
        self.number(traced);
        self.link(traced);
        monitor.step(Step::default())?;
        self.merge_stars(traced)
    }

    /// The source halfedge of a dart, or its target halfedge.
    pub fn halfedge(&self, dart: &Dart) -> MeshHalfedge {
        match dart.halfedge.checked_sub(self.source_halfedges) {
            None => MeshHalfedge::Source(HalfedgeId(dart.halfedge)),
            Some(x) => MeshHalfedge::Target(HalfedgeId(x)),
        }
    }

    /// The place of a dart among the parts of its source halfedge, from 0.
    pub fn source_part(&self, h: HalfedgeId, number: u32) -> u32 {
        number - self.source_darts[h]
    }

    /// The first dart of a source halfedge.
    pub fn source_dart(&self, h: HalfedgeId) -> u32 {
        self.source_darts[h]
    }

    /// The first dart of a target halfedge.
    pub fn target_dart(&self, x: HalfedgeId) -> u32 {
        self.target_darts[x]
    }

    /// Number, for [`Self::along_target`], of the first crossing of a target edge; 0 for an edge of the source.
    pub fn crossings_on_target(&self, x: HalfedgeId, side: MeshSide) -> u32 {
        match side {
            MeshSide::Source => 0,
            MeshSide::Target => self.ranges[x][0],
        }
    }

    /// The place of a crossing on the smaller halfedge of its target edge, 0 to 1; crossings are numbered along the edges.
    pub fn along_target(&self, number: u32) -> f64 {
        self.order[number as usize].along
    }

    /// Counting sort by target edge, then by place on the edge; equal places by number.
    fn sort(&mut self, Traced { target, traces, .. }: Traced<'_>) {
        let mesh = target.mesh;
        self.ranges.clear();
        self.ranges.resize(mesh.face_count() * 3, [0; 2]);
        for crossing in &traces.crossings {
            self.ranges[crossing.exit.min(crossing.entered)][1] += 1;
        }
        let mut begin = 0;
        for x in mesh.edges() {
            let count = self.ranges[x][1];
            // The end grows back as the crossings are put in.
            self.ranges[x] = [begin, begin];
            begin += count;
        }
        self.order.resize(traces.crossings.len(), OnTarget::default());
        for (c, crossing) in traces.crossings.iter().enumerate() {
            let leaves = crossing.exit < crossing.entered;
            let along = if leaves { crossing.along_target } else { 1.0 - crossing.along_target };
            let range = &mut self.ranges[crossing.exit.min(crossing.entered)];
            self.order[range[1] as usize] = OnTarget { along, crossing: c as u32, leaves };
            range[1] += 1;
        }
        for x in mesh.edges() {
            let [begin, end] = self.ranges[x];
            self.ranges[mesh.twin(x)] = [begin, end];
            if end - begin > 1 {
                self.order[begin as usize..end as usize]
                    .sort_unstable_by(|a, b| a.along.total_cmp(&b.along).then(a.crossing.cmp(&b.crossing)));
            }
        }
    }

    /// Numbers the darts, edge by edge, each in both directions: first those of the source.
    fn number(&mut self, Traced { source, target, traces, .. }: Traced<'_>) {
        let mut dart = 0;
        let mut put =
            |darts: &mut TiVec<HalfedgeId, u32>, [h, twin]: [HalfedgeId; 2], [begin, end]: [u32; 2]| {
                let parts = end - begin + 1;
                darts[h] = dart;
                darts[twin] = dart + parts;
                dart += 2 * parts;
            };
        let [mesh, below] = [source.mesh, target.mesh];
        self.source_darts.resize(mesh.face_count() * 3, 0);
        for h in mesh.edges() {
            put(&mut self.source_darts, [h, mesh.twin(h)], traces.ranges[h]);
        }
        self.target_darts.resize(below.face_count() * 3, 0);
        for x in below.edges() {
            put(&mut self.target_darts, [x, below.twin(x)], self.ranges[x]);
        }
        self.next.resize(dart as usize, 0);
        self.arriving.resize(traces.crossings.len(), [0; 2]);
        for x in below.edges() {
            let [begin, end] = self.ranges[x];
            let (ahead, back) = (self.target_darts[x], self.target_darts[below.twin(x)]);
            for (k, site) in self.order[begin as usize..end as usize].iter().enumerate() {
                let (along, against) = (ahead + k as u32, back + (end - 1 - begin - k as u32));
                self.arriving[site.crossing as usize] =
                    if site.leaves { [along, against] } else { [against, along] };
            }
        }
    }

    /// Links each dart to the next one around its cell: at the end of its halfedge that is the first dart of the face's next halfedge, at a
    /// crossing the dart to its left. With the trace going east, `exit` goes north.
    fn link(&mut self, Traced { source, target, traces, .. }: Traced<'_>) {
        let [mesh, below] = [source.mesh, target.mesh];
        for h in mesh.edges() {
            let twin = mesh.twin(h);
            let [begin, end] = traces.ranges[h];
            let crossings = end - begin;
            let (ahead, back) = (self.source_darts[h], self.source_darts[twin]);
            self.next[(ahead + crossings) as usize] = self.source_darts[h.next()];
            self.next[(back + crossings) as usize] = self.source_darts[twin.next()];
            for c in begin..end {
                let [south, north] = self.arriving[c as usize];
                let (west, east) = (ahead + (c - begin), back + (end - 1 - c));
                self.next[west as usize] = south + 1;
                self.next[south as usize] = east + 1;
                self.next[east as usize] = north + 1;
                self.next[north as usize] = west + 1;
            }
        }
        for x in below.halfedges() {
            let [begin, end] = self.ranges[x];
            self.next[(self.target_darts[x] + (end - begin)) as usize] = self.target_darts[x.next()];
        }
    }

    /// At landmarks both stars share a vertex: around it, the next outgoing dart clockwise may be of the other mesh.
    fn merge_stars(&mut self, traced: Traced<'_>) -> Result<(), OverlayError> {
        let Traced { source, target, located, traces } = traced;
        let [mesh, below] = [source.mesh, target.mesh];
        self.last_in_wedge.resize(below.face_count() * 3, None);
        let landmarks = source.landmark_vertices.iter().zip(target.landmark_vertices);
        for (&v, &w) in landmarks {
            let lost = OverlayError::Landmark { vertex: v.index() };
            below.star(w).for_each(|x| self.last_in_wedge[x] = None);
            for h in mesh.star(v) {
                let before = h.prev();
                let following = mesh.twin(before);
                let [Some(wedge), Some(next)] = [h, following].map(|g| located.wedges[g]) else {
                    return Err(lost);
                };
                let [along, turned] = [h, following].map(|g| heading(located, g));
                if wedge == next && along.perp_dot(turned) >= 0.0 {
                    continue;
                }
                let [begin, end] = traces.ranges[before];
                let last = self.source_darts[before] + (end - begin);
                self.next[last as usize] = self.target_darts[next];
                if self.last_in_wedge[wedge].replace(h).is_some() {
                    return Err(lost);
                }
            }
            for x in below.star(w) {
                let arriving = below.twin(x);
                if let Some(h) = self.last_in_wedge[arriving.next()] {
                    let [begin, end] = self.ranges[arriving];
                    let last = self.target_darts[arriving] + (end - begin);
                    self.next[last as usize] = self.source_darts[h];
                }
            }
        }
        Ok(())
    }

    /// Fills [`Self::darts`].
    pub fn describe(&mut self, Traced { source, target, located, traces }: Traced<'_>) {
        let [mesh, below] = [source.mesh, target.mesh];
        self.number_vertices(source, target);
        self.source_halfedges = mesh.face_count() as u32 * 3;
        let first = self.first_crossing;
        self.darts.clear();
        for h in mesh.edges() {
            let twin = mesh.twin(h);
            let [begin, end] = traces.ranges[h];
            let origins = |vertex: VertexId, c: Option<u32>| c.map_or(vertex.0, |c| first + c);
            let face = |c: Option<u32>| match c {
                Some(c) => traces.crossings[c as usize].entered.face(),
                None => located.locations[h].face,
            };
            for k in begin..=end {
                let before = (k > begin).then(|| k - 1);
                let origin = origins(mesh.tail(h), before);
                self.darts.push(Dart { origin, halfedge: h.0, below: face(before) });
            }
            for k in (begin..=end).rev() {
                let origin = origins(mesh.tail(twin), (k < end).then_some(k));
                let below = face((k > begin).then(|| k - 1));
                self.darts.push(Dart { origin, halfedge: twin.0, below });
            }
        }
        for x in below.edges() {
            let twin = below.twin(x);
            let [begin, end] = self.ranges[x];
            let crossings = &self.order[begin as usize..end as usize];
            let mut put = |origin: u32, x: HalfedgeId| {
                let halfedge = x.0 + self.source_halfedges;
                self.darts.push(Dart { origin, halfedge, below: FaceId(NONE) });
            };
            put(self.target_numbers[below.tail(x)], x);
            crossings.iter().for_each(|site| put(first + site.crossing, x));
            put(self.target_numbers[below.tail(twin)], twin);
            crossings.iter().rev().for_each(|site| put(first + site.crossing, twin));
        }
    }

    fn number_vertices(&mut self, source: Parametrised<'_>, target: Parametrised<'_>) {
        self.target_numbers.clear();
        self.target_numbers.resize(target.mesh.vertex_count(), NONE);
        let landmarks = source.landmark_vertices.iter().zip(target.landmark_vertices);
        landmarks.for_each(|(&v, &w)| self.target_numbers[w] = v.0);
        let mut vertex = source.mesh.vertex_count() as u32;
        for number in self.target_numbers.iter_mut().filter(|n| **n == NONE) {
            *number = vertex;
            vertex += 1;
        }
        self.first_crossing = vertex;
    }
}

/// A halfedge of one of the meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MeshHalfedge {
    Source(HalfedgeId),
    Target(HalfedgeId),
}

/// Direction of a source halfedge at a landmark, in the plane of the target face that it points into.
fn heading(located: &CornerLocations, h: HalfedgeId) -> DVec2 {
    located.locations[h].motion.rotate(located.corners[h.next()] - located.corners[h])
}

//! The overlay as far as the energy of a map needs it: pieces with their faces, areas and rotations, and the edges between
//! them. No coordinates are computed, so that it takes a third of the time of an [`super::Overlay`].
//!
//! Areas are sums over the edges: seen from corner 0 of the target face, each part of a source edge sweeps a triangle, and
//! of the target's edges only the one opposite does. They add up exactly, whatever the order of the cells.

use super::arrangement::Arrangement;
use super::corner_locations::CornerLocations;
use super::location::Locations;
use super::pieces::{OverlayError, face_area};
use super::trace::{Traced, Traces};
use crate::landmarks::MeshSide;
use crate::math::rigid2::{Rigid2, complex_mul};
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh};
use crate::monitor::{Monitor, Pulse, Step};
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;

/// No number: of a piece or of a face.
const NONE: u32 = u32::MAX;

/// Halfedges or faces between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 16384;

/// A convex polygon inside one source triangle and one target triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredPiece {
    /// Face of the source.
    pub source_face: FaceId,
    /// Face of the target.
    pub target_face: FaceId,
    /// Area on the cone surface, never negative.
    pub area: f64,
    /// The rotation from the plane of the source face to that of the target face, as (cos, sin) of its angle.
    pub rotation: DVec2,
}

/// A part of an edge with a piece on either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// The edge's smaller halfedge.
    pub halfedge: HalfedgeId,
    /// The place at which the part begins: 0 at the start of the halfedge, 1 at its end.
    pub begin: f64,
    /// The place at which the part ends, 0 to 1.
    pub end: f64,
    /// The piece on the left, in the face of the halfedge.
    pub left: u32,
    /// The piece on the right, in the face of its twin.
    pub right: u32,
}

/// The pieces of an overlay and its working memory, used again by the next one.
#[derive(Clone, Debug, Default)]
pub struct Measure {
    located: CornerLocations,
    traces: Traces,
    arrangement: Arrangement,
    /// The number of the piece that each dart bounds.
    cells: Vec<u32>,
    pieces: Vec<MeasuredPiece>,
    /// Pieces that no source edge bounds.
    whole: Vec<u32>,
    stack: Vec<u32>,
    /// Whether source and target were exchanged since the overlay was made.
    is_exchanged: bool,
}

impl Measure {
    /// Measures the overlay of source and target; `locations` are those of [`super::location::locate`] for the
    /// same sides.
    ///
    /// The pieces are those of [`super::Overlayer::fill`] without shifts, in the same order; where that would shift the
    /// source to end coincidences, this is an error.
    ///
    /// # Errors
    /// [`OverlayError`], with the pieces left in an unfinished state.
    pub fn fill(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        locations: &Locations,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        self.is_exchanged = false;
        let Self { located, traces, arrangement, .. } = self;
        located.fill(source, target, locations, 0)?;
        monitor.step(Step::default())?;
        traces.fill([source, target], located, monitor)?;
        arrangement.fill(Traced { source, target, located, traces }, monitor)?;
        monitor.step(Step::default())?;
        self.label(source.mesh, target.mesh, monitor)?;
        monitor.step(Step::default())?;
        self.sweep_source(source, target)?;
        monitor.step(Step::default())?;
        self.sweep_target(target)?;
        self.spread(target)?;
        let meshes = [source, target].map(|side| side.mesh.vertex_count());
        let vertices = meshes[0] + meshes[1] - source.landmark_vertices.len() + self.traces.crossings.len();
        let euler = vertices as i64 - self.cells.len() as i64 / 2 + self.pieces.len() as i64;
        if euler != 2 {
            return Err(OverlayError::NotASphere { euler });
        }
        self.finish(target)
    }

    /// The pieces.
    pub fn pieces(&self) -> &[MeasuredPiece] {
        &self.pieces
    }

    /// Exchanges the roles of source and target.
    pub fn exchange_roles(&mut self) {
        self.is_exchanged = !self.is_exchanged;
        for piece in &mut self.pieces {
            std::mem::swap(&mut piece.source_face, &mut piece.target_face);
            piece.rotation.y = -piece.rotation.y;
        }
    }

    /// The parts of all edges of one mesh: edge by edge in the order of [`SurfaceMesh::edges`], each from its start to its
    /// end. `mesh` is that side's mesh.
    ///
    /// When an end of an edge moves, the piece on the left gains what the one on the right loses: with n the edge's part
    /// turned clockwise by a right angle and m its middle parameter, (1 - m) n per motion of the start and m n per motion of
    /// the end, all in the plane of the halfedge's face.
    pub fn segments<'a>(
        &'a self,
        mesh: &'a SurfaceMesh,
        side: MeshSide,
    ) -> impl Iterator<Item = Segment> + use<'a> {
        let side = if self.is_exchanged { side.other() } else { side };
        mesh.edges().flat_map(move |h| self.segments_of(mesh, side, h))
    }

    fn segments_of(
        &self,
        mesh: &SurfaceMesh,
        side: MeshSide,
        h: HalfedgeId,
    ) -> impl Iterator<Item = Segment> + use<'_> {
        let first = |h: HalfedgeId| match side {
            MeshSide::Source => self.arrangement.source_dart(h),
            MeshSide::Target => self.arrangement.target_dart(h),
        };
        // The twin's darts follow, against the direction of the edge.
        let (ahead, back) = (first(h), first(mesh.twin(h)));
        let parts = back - ahead;
        let [from, _] = self.traces.ranges.get(h).copied().unwrap_or_default();
        let on_target = self.arrangement.crossings_on_target(h, side);
        let place = move |k: u32| match side {
            MeshSide::Source => self.traces.crossings[(from + k) as usize].along_source,
            MeshSide::Target => self.arrangement.along_target(on_target + k),
        };
        (0..parts).map(move |k| Segment {
            halfedge: h,
            begin: if k == 0 { 0.0 } else { place(k - 1) },
            end: if k + 1 == parts { 1.0 } else { place(k) },
            left: self.cells[(ahead + k) as usize],
            right: self.cells[(back + parts - 1 - k) as usize],
        })
    }

    /// Numbers the cells in the order of the source halfedges; then those that are whole target faces.
    fn label(
        &mut self,
        source: &SurfaceMesh,
        target: &SurfaceMesh,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        self.cells.clear();
        self.cells.resize(self.arrangement.next.len(), NONE);
        self.pieces.clear();
        self.whole.clear();
        for h in source.halfedges() {
            pulse.beat()?;
            let first = self.arrangement.source_dart(h);
            let [begin, end] = self.traces.ranges[h];
            for dart in first..=first + (end - begin) {
                self.follow(dart)?;
            }
        }
        let bounded = self.pieces.len() as u32;
        for f in target.faces() {
            pulse.beat()?;
            self.follow(self.arrangement.target_dart(HalfedgeId::of(f, 0)))?;
        }
        self.whole.extend(bounded..self.pieces.len() as u32);
        match self.cells.contains(&NONE) {
            true => Err(OverlayError::NotASphere { euler: 0 }),
            false => Ok(()),
        }
    }

    /// Numbers the cell on the left of a dart, unless it has a number.
    fn follow(&mut self, first: u32) -> Result<(), OverlayError> {
        if self.cells[first as usize] != NONE {
            return Ok(());
        }
        let cell = self.pieces.len() as u32;
        let mut dart = first;
        loop {
            let slot = &mut self.cells[dart as usize];
            if *slot != NONE {
                return Err(mixed(FaceId(NONE), FaceId(NONE)));
            }
            *slot = cell;
            dart = self.arrangement.next[dart as usize];
            if dart == first {
                break;
            }
        }
        let unknown = FaceId(NONE);
        let rotation = Rigid2::IDENTITY.rotation;
        self.pieces.push(MeasuredPiece { source_face: unknown, target_face: unknown, area: 0.0, rotation });
        Ok(())
    }

    /// Finds the faces and rotations of the pieces, and adds twice the areas that source edges sweep.
    fn sweep_source(
        &mut self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
    ) -> Result<(), OverlayError> {
        let Self { located, traces, arrangement, cells, pieces, .. } = self;
        let mesh = source.mesh;
        for h in mesh.edges() {
            let twin = mesh.twin(h);
            let [begin, end] = traces.ranges[h].map(|c| c as usize);
            let [ahead, back] = [h, twin].map(|h| arrangement.source_dart(h) as usize);
            let parts = end - begin + 1;
            let (left, right) = (&cells[ahead..ahead + parts], &cells[back..back + parts]);
            let ends = [located.corners[h], located.corners[h.next()]];
            // The rotation from the plane of the twin's face, as the inverse: the twin's own is far away in memory.
            let onwards = source.embedding.transitions[h].rotation;
            let across = DVec2::new(onwards.x, -onwards.y);
            let location = &located.locations[h];
            let (mut face, mut motion, mut from) = (location.face, &location.motion, 0.0);
            let mut line = [motion.apply(ends[0]), motion.apply(ends[1])];
            let mut turned = complex_mul(motion.rotation, across);
            for (k, (&left, &right)) in left.iter().zip(right.iter().rev()).enumerate() {
                let crossing = traces.crossings[begin..end].get(k);
                let to = crossing.map_or(1.0, |crossing| crossing.along_source);
                let apex = target.embedding.corners[HalfedgeId::of(face, 0)];
                let swept = (to - from) * signed_double_area(apex, line[0], line[1]);
                pieces[left as usize].meet(h.face(), face, motion.rotation)?.area += swept;
                pieces[right as usize].meet(twin.face(), face, turned)?.area -= swept;
                let Some(crossing) = crossing else { break };
                (face, from) = (crossing.entered.face(), to);
                let next = traces.motion(located, crossing);
                if !std::ptr::eq(next, motion) {
                    motion = next;
                    line = [motion.apply(ends[0]), motion.apply(ends[1])];
                    turned = complex_mul(motion.rotation, across);
                }
            }
        }
        Ok(())
    }

    /// Finds the target faces of the pieces, and adds twice the areas that target edges sweep.
    fn sweep_target(&mut self, target: Parametrised<'_>) -> Result<(), OverlayError> {
        let Self { arrangement, cells, pieces, .. } = self;
        let mesh = target.mesh;
        for x in mesh.edges() {
            let twin = mesh.twin(x);
            let (ahead, back) = (arrangement.target_dart(x), arrangement.target_dart(twin));
            let parts = back - ahead;
            let sweeps = [x, twin].map(|x| match x.corner() {
                1 => 2.0 * face_area(&target.embedding.corners, x.face()),
                _ => 0.0,
            });
            let first = arrangement.crossings_on_target(x, MeshSide::Target);
            let mut from = 0.0;
            for k in 0..parts {
                let to = if k + 1 < parts { arrangement.along_target(first + k) } else { 1.0 };
                let sides = [(x, ahead + k), (twin, back + parts - 1 - k)];
                for ((x, dart), sweep) in sides.into_iter().zip(sweeps) {
                    let piece = &mut pieces[cells[dart as usize] as usize];
                    if piece.target_face == FaceId(NONE) {
                        piece.target_face = x.face();
                    } else if piece.target_face != x.face() {
                        return Err(mixed(piece.source_face, x.face()));
                    }
                    piece.area += (to - from) * sweep;
                }
                from = to;
            }
        }
        Ok(())
    }

    /// Gives whole target triangles the source face of their neighbours.
    fn spread(&mut self, target: Parametrised<'_>) -> Result<(), OverlayError> {
        let Self { arrangement, cells, pieces, whole, stack, .. } = self;
        for &start in whole.iter() {
            stack.clear();
            stack.push(start);
            while let Some(cell) = stack.pop() {
                let piece = pieces[cell as usize];
                if piece.source_face != FaceId(NONE) {
                    continue;
                }
                let neighbour = |k: usize| {
                    let twin = target.mesh.twin(HalfedgeId::of(piece.target_face, k));
                    (twin, cells[arrangement.target_dart(twin) as usize])
                };
                let neighbours = [0, 1, 2].map(neighbour);
                let is_known = |cell: u32| pieces[cell as usize].source_face != FaceId(NONE);
                let Some(&(twin, other)) = neighbours.iter().find(|n| is_known(n.1)) else { continue };
                stack.extend(neighbours.iter().map(|n| n.1).filter(|&n| !is_known(n)));
                let MeasuredPiece { source_face, rotation, .. } = pieces[other as usize];
                let rotation = complex_mul(target.embedding.transitions[twin].rotation, rotation);
                pieces[cell as usize] = MeasuredPiece { source_face, rotation, ..piece };
            }
        }
        let lone = whole.iter().map(|&cell| &pieces[cell as usize]).find(|p| p.source_face == FaceId(NONE));
        lone.map_or(Ok(()), |piece| Err(mixed(piece.source_face, piece.target_face)))
    }

    /// Computes the areas from the swept triangles; a negative one is rounding or an error.
    fn finish(&mut self, target: Parametrised<'_>) -> Result<(), OverlayError> {
        for piece in &mut self.pieces {
            let area = 0.5 * piece.area;
            if area > 0.0 {
                piece.area = area;
                continue;
            }
            let (s, t) = (piece.source_face, piece.target_face);
            let sizes = [(&self.located.corners, s), (&target.embedding.corners, t)];
            let [on_source, on_target] = sizes.map(|(corners, f)| face_area(corners, f));
            // The bound is that in `cells`: rounding of shares, and of coordinates of order 1 along an edge.
            let slack = 1e-9 * on_source.min(on_target) + 1e-14 * on_source.max(on_target).sqrt();
            if area.is_nan() || area < -slack {
                let (source_face, target_face) = (s.index(), t.index());
                return Err(OverlayError::Negative { source_face, target_face, area });
            }
            piece.area = 0.0;
        }
        Ok(())
    }
}

impl MeasuredPiece {
    /// Sets the faces and the rotation of a piece that has none; another piece must have these faces.
    #[inline]
    fn meet(&mut self, s: FaceId, t: FaceId, rotation: DVec2) -> Result<&mut Self, OverlayError> {
        if self.source_face == FaceId(NONE) {
            (self.source_face, self.target_face, self.rotation) = (s, t, rotation);
        } else if (self.source_face, self.target_face) != (s, t) {
            return Err(mixed(s, t));
        }
        Ok(self)
    }
}

fn mixed(source_face: FaceId, target_face: FaceId) -> OverlayError {
    let number = |f: FaceId| if f == FaceId(NONE) { usize::MAX } else { f.index() };
    OverlayError::Mixed { source_face: number(source_face), target_face: number(target_face) }
}

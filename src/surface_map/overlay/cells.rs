//! The cells of the arrangement as pieces: walked, given coordinates on both meshes, and checked.

use super::arrangement::{Arrangement, Dart, Origin};
use super::seats::Seats;
use super::trace::Traces;
use super::{Overlay, OverlayError, OverlayPoint, Piece, SideOf, corners_of, face_area};
use crate::math::rigid2::Rigid2;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::surface_map::compose::{Parametrised, barycentric_in};
use typed_index_collections::TiVec;

const NONE: u32 = u32::MAX;

/// The parts that cells are made of.
pub(super) type Parts<'a> = (&'a Seats, &'a Traces, &'a Arrangement);

/// A vertex of one mesh in a face of the other.
#[derive(Clone, Copy, Debug)]
struct Inside {
    face: FaceId,
    barycentric: [f64; 3],
}

/// Working memory of the walk.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    cell_of_dart: Vec<u32>,
    /// Cells whose border has no source dart: whole target triangles inside a source triangle.
    whole: Vec<u32>,
    stack: Vec<u32>,
    /// By source vertex, its place on the target.
    source_inside: TiVec<VertexId, Option<Inside>>,
    /// By target vertex, its place on the source.
    target_inside: TiVec<VertexId, Option<Inside>>,
    /// Overlay vertex of each target vertex that is no landmark.
    target_numbers: TiVec<VertexId, u32>,
    /// Overlay vertex of the first crossing.
    first_crossing: u32,
    areas: [TiVec<FaceId, f64>; 2],
    covered: [TiVec<FaceId, f64>; 2],
    /// Darts of all cells, cell by cell, in the order of the pieces' points.
    darts: Vec<Dart>,
}

/// Source and target with the parts of their arrangement.
#[derive(Clone, Copy)]
struct View<'a> {
    source: Parametrised<'a>,
    target: Parametrised<'a>,
    seats: &'a Seats,
    traces: &'a Traces,
    arrangement: &'a Arrangement,
}

impl Cells {
    /// Makes the pieces and checks them.
    pub fn fill(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        (seats, traces, arrangement): Parts<'_>,
        overlay: &mut Overlay,
    ) -> Result<(), OverlayError> {
        let view = View { source, target, seats, traces, arrangement };
        self.reset(view, overlay);
        for h in source.patched.mesh.halfedges() {
            let [begin, end] = traces.ranges[h];
            for i in 0..=end - begin {
                self.walk(view, Dart::Source(h, i), overlay)?;
            }
        }
        for x in target.patched.mesh.halfedges() {
            for i in 0..arrangement.target_parts(x) {
                self.walk(view, Dart::Target(x, i), overlay)?;
            }
        }
        self.spread(view, overlay)?;
        let edges = arrangement.dart_count() / 2;
        let euler = overlay.vertex_count as i64 - edges as i64 + overlay.pieces.len() as i64;
        if euler != 2 {
            return Err(OverlayError::NotASphere { euler });
        }
        self.place(view, overlay)
    }

    fn reset(&mut self, view: View<'_>, overlay: &mut Overlay) {
        let [source, target] = [view.source, view.target].map(|side| &side.patched.mesh);
        self.cell_of_dart.clear();
        self.cell_of_dart.resize(view.arrangement.dart_count(), NONE);
        self.whole.clear();
        self.darts.clear();
        self.source_inside.clear();
        self.source_inside.resize(source.vertex_count(), None);
        self.target_inside.clear();
        self.target_inside.resize(target.vertex_count(), None);
        self.target_numbers.clear();
        self.target_numbers.resize(target.vertex_count(), 0);
        for &w in &view.target.patched.landmark_vertices {
            self.target_numbers[w] = NONE;
        }
        let mut next = source.vertex_count() as u32;
        for number in self.target_numbers.iter_mut().filter(|n| **n != NONE) {
            *number = next;
            next += 1;
        }
        self.first_crossing = next;
        overlay.vertex_count = next as usize + view.traces.crossings.len();
        overlay.pieces.clear();
        overlay.points.clear();
        overlay.degenerate = 0;
        let corners = [&view.seats.corners, &view.target.embedding.corners];
        for (k, mesh) in [source, target].into_iter().enumerate() {
            self.areas[k].clear();
            self.areas[k].extend(mesh.faces().map(|f| face_area(corners[k], f)));
            self.covered[k].clear();
            self.covered[k].resize(mesh.face_count(), 0.0);
        }
    }

    /// Walks the cell on the left of a dart, unless it was walked before.
    fn walk(&mut self, view: View<'_>, first: Dart, overlay: &mut Overlay) -> Result<(), OverlayError> {
        if self.cell_of_dart[view.arrangement.number_of(first)] != NONE {
            return Ok(());
        }
        let cell = overlay.pieces.len() as u32;
        let begin = self.darts.len();
        let (mut source_face, mut target_face, mut motion) = (None, None, None);
        let mut dart = first;
        loop {
            let slot = &mut self.cell_of_dart[view.arrangement.number_of(dart)];
            let mut is_mixed = *slot != NONE;
            *slot = cell;
            self.darts.push(dart);
            match dart {
                Dart::Source(h, i) => {
                    let (below, onto) = view.below(h, i);
                    is_mixed |= *source_face.get_or_insert(h.face()) != h.face();
                    is_mixed |= *target_face.get_or_insert(below) != below;
                    motion.get_or_insert(onto);
                }
                Dart::Target(x, _) => is_mixed |= *target_face.get_or_insert(x.face()) != x.face(),
            }
            if is_mixed {
                return Err(mixed(source_face, target_face));
            }
            dart = view.arrangement.next(view.source, view.target, (view.traces, dart));
            if dart == first {
                break;
            }
        }
        if source_face.is_none() {
            self.whole.push(cell);
        }
        overlay.pieces.push(Piece {
            source_face: source_face.unwrap_or(FaceId(NONE)),
            target_face: target_face.unwrap_or(FaceId(NONE)),
            points: begin..self.darts.len(),
            area: 0.0,
            motion: motion.unwrap_or(Rigid2::IDENTITY),
        });
        Ok(())
    }

    /// Gives whole target triangles the source face of their neighbours.
    fn spread(&mut self, view: View<'_>, overlay: &mut Overlay) -> Result<(), OverlayError> {
        let mesh = &view.target.patched.mesh;
        for k in 0..self.whole.len() {
            self.stack.clear();
            self.stack.push(self.whole[k]);
            while let Some(cell) = self.stack.pop() {
                let piece = &overlay.pieces[cell as usize];
                if piece.source_face != FaceId(NONE) {
                    continue;
                }
                let darts = &self.darts[piece.points.clone()];
                let across = |dart: &Dart| match *dart {
                    Dart::Target(x, 0) => {
                        let twin = mesh.twin(x);
                        let other = self.cell_of_dart[view.arrangement.number_of(Dart::Target(twin, 0))];
                        Some((twin, other))
                    }
                    _ => None,
                };
                let known = |(_, other): &(HalfedgeId, u32)| {
                    overlay.pieces[*other as usize].source_face != FaceId(NONE)
                };
                let Some((twin, other)) = darts.iter().filter_map(across).find(known) else { continue };
                self.stack.extend(darts.iter().filter_map(across).filter(|n| !known(n)).map(|n| n.1));
                let neighbour = &overlay.pieces[other as usize];
                let source_face = neighbour.source_face;
                let motion = view.target.embedding.transitions[twin].after(&neighbour.motion);
                let piece = &mut overlay.pieces[cell as usize];
                piece.source_face = source_face;
                piece.motion = motion;
            }
        }
        let lone = overlay.pieces.iter().find(|p| p.source_face == FaceId(NONE));
        lone.map_or(Ok(()), |piece| Err(mixed(None, Some(piece.target_face))))
    }

    /// Coordinates of all corners, areas and their sums.
    fn place(&mut self, view: View<'_>, overlay: &mut Overlay) -> Result<(), OverlayError> {
        let Overlay { pieces, points, degenerate, .. } = overlay;
        for piece in pieces.iter_mut() {
            for k in piece.points.clone() {
                let point = self.point(view, piece, self.darts[k])?;
                points.push(point);
            }
            let ring = &points[piece.points.clone()];
            let (s, t) = (piece.source_face, piece.target_face);
            let on_source = share(ring, |p| &p.source) * self.areas[0][s];
            let on_target = share(ring, |p| &p.target) * self.areas[1][t];
            let area = on_source;
            let size = self.areas[0][s].min(self.areas[1][t]);
            let slack = 1e-9 * size + 1e-14 * size.sqrt();
            if !(on_source >= -slack && on_target >= -slack) {
                let (source_face, target_face) = (s.index(), t.index());
                let area = on_source.min(on_target);
                return Err(OverlayError::Negative { source_face, target_face, area });
            }
            piece.area = area.max(0.0);
            *degenerate += usize::from(area < 1e-12 * size);
            self.covered[0][s] += piece.area;
            self.covered[1][t] += piece.area;
        }
        let defect = |k: usize| {
            let pairs = self.covered[k].iter().zip(&self.areas[k]);
            pairs.map(|(sum, area)| (sum - area).abs() / area).fold(0.0, f64::max)
        };
        overlay.source_area_defect = defect(0);
        overlay.target_area_defect = defect(1);
        Ok(())
    }

    fn point(&mut self, view: View<'_>, piece: &Piece, dart: Dart) -> Result<OverlayPoint, OverlayError> {
        let side = if matches!(dart, Dart::Source(..)) { SideOf::Source } else { SideOf::Target };
        let [mesh, below] = [view.source, view.target].map(|s| &s.patched.mesh);
        let (s, t) = (piece.source_face, piece.target_face);
        let origin = view.arrangement.origin(view.source, view.target, (view.traces, dart));
        let (source, target, vertex) = match origin {
            Origin::Source(v) => {
                let target = match dart {
                    Dart::Target(x, _) => unit(x.corner()),
                    Dart::Source(h, _) => match view.seats.wedges[h] {
                        Some(wedge) => unit(corner_in(below, t, below.tail(wedge))),
                        None => self.source_in_target(view, (v, h), t)?,
                    },
                };
                (unit(corner_in(mesh, s, v)), target, v.0)
            }
            Origin::Target(w) => {
                let source = self.target_in_source(view, w, piece)?;
                (source, unit(corner_in(below, t, w)), self.target_numbers[w])
            }
            Origin::Crossing(c) => {
                let crossing = &view.traces.crossings[c as usize];
                let source = on_edge(mesh, crossing.edge, s, crossing.along_source);
                let target = on_edge(below, crossing.exit, t, crossing.along_target);
                (source, target, self.first_crossing + c)
            }
        };
        Ok(OverlayPoint { source, target, vertex, side })
    }

    fn source_in_target(
        &mut self,
        view: View<'_>,
        (v, h): (VertexId, HalfedgeId),
        t: FaceId,
    ) -> Result<[f64; 3], OverlayError> {
        let inside = self.source_inside[v].get_or_insert_with(|| {
            let seat = &view.seats.seats[h];
            let at = seat.motion.apply(view.seats.corners[h]);
            let corners = corners_of(&view.target.embedding.corners, seat.face);
            Inside { face: seat.face, barycentric: barycentric_in(corners, at) }
        });
        if inside.face == t { Ok(inside.barycentric) } else { Err(mixed(Some(h.face()), Some(t))) }
    }

    fn target_in_source(
        &mut self,
        view: View<'_>,
        w: VertexId,
        piece: &Piece,
    ) -> Result<[f64; 3], OverlayError> {
        let s = piece.source_face;
        let inside = self.target_inside[w].get_or_insert_with(|| {
            let x = corner_in(&view.target.patched.mesh, piece.target_face, w);
            let at = view.target.embedding.corners[HalfedgeId::of(piece.target_face, x)];
            let at = piece.motion.inverse().apply(at);
            Inside { face: s, barycentric: barycentric_in(corners_of(&view.seats.corners, s), at) }
        });
        if inside.face == s { Ok(inside.barycentric) } else { Err(mixed(Some(s), Some(piece.target_face))) }
    }
}

impl View<'_> {
    /// The target face below part i of a source halfedge, and the motion from the halfedge's source face.
    fn below(&self, h: HalfedgeId, i: u32) -> (FaceId, Rigid2) {
        let mesh = &self.source.patched.mesh;
        let twin = mesh.twin(h);
        let [begin, end] = self.traces.ranges[h];
        // Parts counted along the trace: part 0 begins at the seat, part k at crossing k - 1.
        let along = if h < twin { i } else { end - begin - i };
        let edge = h.min(twin);
        let (face, motion) = if along == 0 {
            let seat = &self.seats.seats[edge];
            (seat.face, seat.motion)
        } else {
            let crossing = &self.traces.crossings[(begin + along - 1) as usize];
            (self.target.patched.mesh.twin(crossing.exit).face(), crossing.motion)
        };
        let transition = &self.source.embedding.transitions[h];
        let is_plain = h == edge || *transition == Rigid2::IDENTITY;
        (face, if is_plain { motion } else { motion.after(transition) })
    }
}

fn mixed(source_face: Option<FaceId>, target_face: Option<FaceId>) -> OverlayError {
    let number = |f: Option<FaceId>| f.map_or(usize::MAX, FaceId::index);
    OverlayError::Mixed { source_face: number(source_face), target_face: number(target_face) }
}

fn unit(k: usize) -> [f64; 3] {
    let mut barycentric = [0.0; 3];
    barycentric[k] = 1.0;
    barycentric
}

/// Which corner of a face a vertex is.
fn corner_in(mesh: &SurfaceMesh, f: FaceId, v: VertexId) -> usize {
    mesh.triangles()[f].iter().position(|&c| c == v).unwrap_or(0)
}

/// A point of an edge as seen from one of its two faces.
fn on_edge(mesh: &SurfaceMesh, edge: HalfedgeId, f: FaceId, along: f64) -> [f64; 3] {
    let (h, along) = if edge.face() == f { (edge, along) } else { (mesh.twin(edge), 1.0 - along) };
    let mut barycentric = [0.0; 3];
    barycentric[h.corner()] = 1.0 - along;
    barycentric[h.next().corner()] = along;
    barycentric
}

/// Share of its triangle that a polygon in barycentric coordinates covers; positive when counter-clockwise.
fn share(ring: &[OverlayPoint], coordinates: impl Fn(&OverlayPoint) -> &[f64; 3]) -> f64 {
    let mut sum = 0.0;
    let origin = coordinates(&ring[0]);
    for k in 2..ring.len() {
        let (p, q) = (coordinates(&ring[k - 1]), coordinates(&ring[k]));
        sum += (p[1] - origin[1]) * (q[2] - origin[2]) - (p[2] - origin[2]) * (q[1] - origin[1]);
    }
    sum
}

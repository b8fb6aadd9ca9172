//! The cells of the arrangement made into pieces: their borders followed, coordinates computed on both meshes, and checked.

use super::arrangement::{Arrangement, MeshHalfedge};
use super::corner_locations::CornerLocations;
use super::pieces::{Overlay, OverlayError, OverlayPoint, Piece, face_area};
use super::trace::Traces;
use crate::landmarks::MeshSide;
use crate::math::barycentric;
use crate::math::rigid2::Rigid2;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Monitor, Pulse, Step};
use crate::surface_map::parametrisation::embedding::Parametrised;
use crate::surface_map::parametrisation::embedding::triangle;
use typed_index_collections::TiVec;

/// No number: of a cell or of a face.
const NONE: u32 = u32::MAX;

/// Pieces and halfedges between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 8192;

/// A vertex of one mesh in a face of the other.
#[derive(Clone, Copy, Debug)]
struct Inside {
    face: FaceId,
    barycentric: [f64; 3],
}

/// Working memory of the cells.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    cell_of_dart: Vec<u32>,
    /// Cells whose border has no source dart: whole target triangles inside a source triangle.
    whole: Vec<u32>,
    stack: Vec<u32>,
    /// The place of each source vertex on the target.
    source_inside: TiVec<VertexId, Option<Inside>>,
    /// The place of each target vertex on the source.
    target_inside: TiVec<VertexId, Option<Inside>>,
    areas: [TiVec<FaceId, f64>; 2],
    covered: [TiVec<FaceId, f64>; 2],
    /// Darts of all cells, cell by cell, in the order of the pieces' points.
    darts: Vec<u32>,
}

/// Source and target with the parts of their arrangement.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub source: Parametrised<'a>,
    pub target: Parametrised<'a>,
    pub located: &'a CornerLocations,
    pub traces: &'a Traces,
    pub arrangement: &'a Arrangement,
}

impl Cells {
    /// Makes the pieces and checks them.
    pub fn fill(
        &mut self,
        view: View<'_>,
        overlay: &mut Overlay,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        let View { source, target, traces, arrangement, .. } = view;
        self.reset(view, overlay);
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        // Source darts in the order of their faces, so that neighbouring pieces have neighbouring numbers; then the rest.
        for h in source.mesh.halfedges() {
            pulse.beat()?;
            let [begin, end] = traces.ranges[h];
            for part in 0..=end - begin {
                self.walk(view, arrangement.source_dart(h) + part, overlay)?;
            }
        }
        for f in target.mesh.faces() {
            pulse.beat()?;
            self.walk(view, arrangement.target_dart(HalfedgeId::of(f, 0)), overlay)?;
        }
        if self.cell_of_dart.contains(&NONE) {
            return Err(OverlayError::NotASphere { euler: 0 });
        }
        self.spread(view, overlay)?;
        let edges = arrangement.next.len() / 2;
        let euler = overlay.vertex_count as i64 - edges as i64 + overlay.pieces.len() as i64;
        if euler != 2 {
            return Err(OverlayError::NotASphere { euler });
        }
        monitor.step(Step::default())?;
        self.place(view, overlay, monitor)
    }

    fn reset(&mut self, view: View<'_>, overlay: &mut Overlay) {
        let [source, target] = [view.source, view.target].map(|side| side.mesh);
        self.cell_of_dart.clear();
        self.cell_of_dart.resize(view.arrangement.next.len(), NONE);
        self.whole.clear();
        self.darts.clear();
        self.source_inside.clear();
        self.source_inside.resize(source.vertex_count(), None);
        self.target_inside.clear();
        self.target_inside.resize(target.vertex_count(), None);
        overlay.vertex_count = view.arrangement.first_crossing as usize + view.traces.crossings.len();
        overlay.pieces.clear();
        overlay.points.clear();
        overlay.degenerate = 0;
        let corners = [&view.located.corners, &view.target.embedding.corners];
        for (k, mesh) in [source, target].into_iter().enumerate() {
            self.areas[k].clear();
            self.areas[k].extend(mesh.faces().map(|f| face_area(corners[k], f)));
            self.covered[k].clear();
            self.covered[k].resize(mesh.face_count(), 0.0);
        }
    }

    /// Walks the cell on the left of a dart, unless that was done.
    fn walk(&mut self, view: View<'_>, first: u32, overlay: &mut Overlay) -> Result<(), OverlayError> {
        if self.cell_of_dart[first as usize] != NONE {
            return Ok(());
        }
        let cell = overlay.pieces.len() as u32;
        let begin = self.darts.len();
        let (mut source_face, mut target_face, mut motion) = (None, None, None);
        let mut number = first;
        loop {
            let slot = &mut self.cell_of_dart[number as usize];
            let mut is_mixed = *slot != NONE;
            *slot = cell;
            self.darts.push(number);
            let dart = &view.arrangement.darts[number as usize];
            match view.arrangement.halfedge(dart) {
                MeshHalfedge::Source(h) => {
                    is_mixed |= *source_face.get_or_insert(h.face()) != h.face();
                    is_mixed |= *target_face.get_or_insert(dart.below) != dart.below;
                    motion.get_or_insert_with(|| view.motion(h, view.arrangement.source_part(h, number)));
                }
                MeshHalfedge::Target(x) => is_mixed |= *target_face.get_or_insert(x.face()) != x.face(),
            }
            if is_mixed {
                return Err(mixed(source_face, target_face));
            }
            number = view.arrangement.next[number as usize];
            if number == first {
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
        let mesh = &view.target.mesh;
        for k in 0..self.whole.len() {
            self.stack.clear();
            self.stack.push(self.whole[k]);
            while let Some(cell) = self.stack.pop() {
                let piece = &overlay.pieces[cell as usize];
                if piece.source_face != FaceId(NONE) {
                    continue;
                }
                let darts = &self.darts[piece.points.clone()];
                let across =
                    |&dart: &u32| match view.arrangement.halfedge(&view.arrangement.darts[dart as usize]) {
                        MeshHalfedge::Target(x) => {
                            let twin = mesh.twin(x);
                            Some((twin, self.cell_of_dart[view.arrangement.target_dart(twin) as usize]))
                        }
                        MeshHalfedge::Source(_) => None,
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

    /// Computes the coordinates of all corners, the areas, and their sums over faces.
    fn place(
        &mut self,
        view: View<'_>,
        overlay: &mut Overlay,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        let Overlay { pieces, points, degenerate, .. } = overlay;
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        for piece in pieces.iter_mut() {
            pulse.beat()?;
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
            // Rounding: of the barycentric coordinates, and of coordinates of order 1 (up to 7e-15) along an edge.
            let slack = 1e-9 * size + 1e-14 * size.sqrt();
            if !(on_source >= -slack && on_target >= -slack) {
                let (source_face, target_face) = (s.index(), t.index());
                let area = on_source.min(on_target);
                return Err(OverlayError::Negative { source_face, target_face, area });
            }
            piece.area = area.max(0.0);
            // Such pieces are only counted: rounding alone makes shares as small.
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

    fn point(&mut self, view: View<'_>, piece: &Piece, number: u32) -> Result<OverlayPoint, OverlayError> {
        let dart = &view.arrangement.darts[number as usize];
        let halfedge = view.arrangement.halfedge(dart);
        let edge_of =
            if matches!(halfedge, MeshHalfedge::Source(_)) { MeshSide::Source } else { MeshSide::Target };
        let vertex = dart.origin;
        let (s, t) = (piece.source_face, piece.target_face);
        if let Some(c) = vertex.checked_sub(view.arrangement.first_crossing) {
            let crossing = &view.traces.crossings[c as usize];
            let edge = [crossing.edge, view.source.mesh.twin(crossing.edge)];
            let exit = [crossing.exit, crossing.entered];
            let source = on_edge(edge, s, crossing.along_source);
            let target = on_edge(exit, t, crossing.along_target);
            return Ok(OverlayPoint { source, target, vertex, edge_of });
        }
        let [mesh, below] = [view.source, view.target].map(|s| s.mesh);
        let is_source = (vertex as usize) < mesh.vertex_count();
        let (source, target) = match halfedge {
            MeshHalfedge::Source(h) => match view.located.wedges[h] {
                Some(wedge) => (unit(h.corner()), unit(corner_in(below, t, below.tail(wedge)))),
                None => (unit(h.corner()), self.source_in_target(view, h, t)?),
            },
            MeshHalfedge::Target(x) if is_source => {
                (unit(corner_in(mesh, s, VertexId(vertex))), unit(x.corner()))
            }
            MeshHalfedge::Target(x) => (self.target_in_source(view, x, piece)?, unit(x.corner())),
        };
        Ok(OverlayPoint { source, target, vertex, edge_of })
    }

    fn source_in_target(
        &mut self,
        view: View<'_>,
        h: HalfedgeId,
        t: FaceId,
    ) -> Result<[f64; 3], OverlayError> {
        let v = view.source.mesh.tail(h);
        let inside = self.source_inside[v].get_or_insert_with(|| {
            let location = &view.located.locations[h];
            let at = location.motion.apply(view.located.corners[h]);
            let corners = view.target.embedding.triangle(location.face);
            Inside { face: location.face, barycentric: barycentric::clamped_in(corners, at) }
        });
        if inside.face == t { Ok(inside.barycentric) } else { Err(mixed(Some(h.face()), Some(t))) }
    }

    fn target_in_source(
        &mut self,
        view: View<'_>,
        x: HalfedgeId,
        piece: &Piece,
    ) -> Result<[f64; 3], OverlayError> {
        let s = piece.source_face;
        let w = view.target.mesh.tail(x);
        let inside = self.target_inside[w].get_or_insert_with(|| {
            let at = piece.motion.inverse().apply(view.target.embedding.corners[x]);
            Inside { face: s, barycentric: barycentric::clamped_in(triangle(&view.located.corners, s), at) }
        });
        if inside.face == s { Ok(inside.barycentric) } else { Err(mixed(Some(s), Some(piece.target_face))) }
    }
}

impl View<'_> {
    /// The motion from the source face of a halfedge to the target face that holds part `i` of it.
    fn motion(&self, h: HalfedgeId, i: u32) -> Rigid2 {
        let edge = h.min(self.source.mesh.twin(h));
        let [begin, end] = self.traces.ranges[h];
        // Parts counted along the trace: part 0 begins at the location, part k at crossing k - 1.
        let along = if h == edge { i } else { end - begin - i };
        let motion = match along.checked_sub(1) {
            Some(k) => self.traces.motion(self.located, &self.traces.crossings[(begin + k) as usize]),
            None => &self.located.locations[edge].motion,
        };
        let transition = &self.source.embedding.transitions[h];
        if h == edge || *transition == Rigid2::IDENTITY { *motion } else { motion.after(transition) }
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

/// The number, 0 to 2, of the corner of a face at which a vertex is.
fn corner_in(mesh: &SurfaceMesh, f: FaceId, v: VertexId) -> usize {
    mesh.corner_at(f, v).map_or(0, HalfedgeId::corner)
}

/// A point of an edge, given by both its halfedges, as seen from one of its two faces.
fn on_edge([h, twin]: [HalfedgeId; 2], f: FaceId, along: f64) -> [f64; 3] {
    let (h, along) = if h.face() == f { (h, along) } else { (twin, 1.0 - along) };
    SurfacePoint::on_halfedge(h, along).barycentric
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

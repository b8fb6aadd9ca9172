//! One mesh drawn on the charts of the base domain: the parts of its faces, each in its chart.

use super::cutting::{Crossing, Cuts, Neighbours, Node, Part, PartOfEdge, PolygonEdge};
use crate::math::barycentric;
use crate::math::rigid2::Rigid2;
use crate::mesh::{Carrier, FaceId, HalfedgeId, Place, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse, Step};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;
use rustc_hash::FxHashMap;
use std::ops::Range;
use typed_index_collections::{TiVec, ti_vec};

/// One mesh on the flat triangles of its base domain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlatDrawing {
    /// Corners of the polygons; a place on an edge of the base domain occurs once per chart.
    pub vertices: Vec<FlatVertex>,
    /// Parts of faces, each in one chart. Together they cover all faces and all charts.
    pub polygons: Vec<FlatPolygon>,
    /// Corners of all polygons: numbers in `vertices`.
    pub corners: Vec<u32>,
}

/// A corner of a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatVertex {
    /// Its place on the mesh.
    pub place: Place,
    /// Its barycentric coordinates in its chart, the base face of its polygons; exactly 0 for the corner opposite an edge that it lies on.
    pub weights: [f64; 3],
}

/// A part of a face in a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatPolygon {
    /// The face of the mesh.
    pub face: FaceId,
    /// The base face.
    pub chart: FaceId,
    /// Its corners in [`FlatDrawing::corners`], counter-clockwise.
    pub corners: Range<usize>,
}

impl FlatDrawing {
    /// The edges of the base domain as they run over the mesh, once each: numbers of vertices in order.
    pub fn side_lines(&self, base: &SurfaceMesh) -> Vec<Vec<u32>> {
        let mut by_side: Vec<Vec<u32>> = vec![Vec::new(); 3 * base.face_count()];
        let mut charts = vec![None; self.vertices.len()];
        for polygon in &self.polygons {
            self.corners[polygon.corners.clone()]
                .iter()
                .for_each(|&v| charts[v as usize] = Some(polygon.chart));
        }
        for (v, vertex) in self.vertices.iter().enumerate() {
            let Some(chart) = charts[v] else { continue };
            for h in chart.halfedges().into_iter().filter(|h| vertex.weights[h.prev().corner()] == 0.0) {
                by_side[h.index()].push(v as u32);
            }
        }
        let line = |h: HalfedgeId| {
            let mut line = by_side[h.index()].clone();
            let along = |v: u32| self.vertices[v as usize].weights[h.next().corner()];
            line.sort_by(|&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
            line
        };
        base.edges().map(line).collect()
    }

    /// The parts of the mesh as triangles, chart after chart, and where each chart starts among them, with one past the end. Corners
    /// are numbers of vertices; a part is convex, and cut from its first corner.
    pub fn triangles_by_chart(&self, charts: usize) -> TrianglesByChart {
        let mut by_chart: Vec<Vec<[u32; 3]>> = vec![Vec::new(); charts];
        let mut faces: Vec<Vec<FaceId>> = vec![Vec::new(); charts];
        for polygon in &self.polygons {
            let corners = &self.corners[polygon.corners.clone()];
            let fan = corners.windows(2).skip(1).map(|side| [corners[0], side[0], side[1]]);
            by_chart[polygon.chart.index()].extend(fan);
            faces[polygon.chart.index()].resize(by_chart[polygon.chart.index()].len(), polygon.face);
        }
        let mut starts = vec![0];
        starts.extend(by_chart.iter().scan(0, |end, chart| {
            *end += chart.len();
            Some(*end)
        }));
        TrianglesByChart { triangles: by_chart.concat(), faces: faces.concat(), starts }
    }

    /// The parts of the edges of the base domain inside each face, from both of their charts.
    pub fn border_parts(&self) -> Vec<BorderPart> {
        let mut parts = Vec::new();
        for polygon in &self.polygons {
            let corners = &self.corners[polygon.corners.clone()];
            for (k, &from) in corners.iter().enumerate() {
                let to = corners[(k + 1) % corners.len()];
                let is_on = |v: u32, border: HalfedgeId| {
                    self.vertices[v as usize].weights[border.prev().corner()] == 0.0
                };
                let borders = polygon.chart.halfedges();
                if let Some(border) = borders.into_iter().find(|&h| is_on(from, h) && is_on(to, h)) {
                    parts.push(BorderPart { border, face: polygon.face, from, to });
                }
            }
        }
        parts
    }

    /// The face in the middle of each chart; face 0 for a chart without parts.
    pub fn middle_faces(&self, charts: usize) -> Vec<FaceId> {
        let mut middles = vec![(f64::INFINITY, FaceId(0)); charts];
        for polygon in &self.polygons {
            let corners = &self.corners[polygon.corners.clone()];
            let mean = |k: usize| {
                let sum: f64 = corners.iter().map(|&v| self.vertices[v as usize].weights[k]).sum();
                sum / corners.len() as f64 - 1.0 / 3.0
            };
            let off: f64 = (0..3).map(|k| mean(k) * mean(k)).sum();
            let nearest = &mut middles[polygon.chart.index()];
            if off < nearest.0 {
                *nearest = (off, polygon.face);
            }
        }
        middles.into_iter().map(|(_, face)| face).collect()
    }

    /// The place on the mesh of each vertex of the base domain; `None` for one that the drawing does not have.
    pub fn cones(&self, base: &SurfaceMesh) -> TiVec<VertexId, Option<Place>> {
        let mut cones = ti_vec![None; base.vertex_count()];
        for polygon in &self.polygons {
            for &v in &self.corners[polygon.corners.clone()] {
                let FlatVertex { place, weights } = self.vertices[v as usize];
                if let Some(corner) = weights.iter().position(|&weight| weight == 1.0) {
                    cones[base.triangles()[polygon.chart][corner]] = Some(place);
                }
            }
        }
        cones
    }

    /// The same drawing with places on the mesh that its mesh refines.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn carried(&self, carrier: Carrier<'_>, monitor: &mut dyn Monitor) -> Result<Self, Cancelled> {
        let vertex = |v: &FlatVertex| FlatVertex { place: carrier.place(v.place), ..*v };
        let polygon = |p: &FlatPolygon| FlatPolygon { face: (carrier.frame)(p.face).face, ..p.clone() };
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        let mut vertices = Vec::with_capacity(self.vertices.len());
        for given in &self.vertices {
            pulse.beat()?;
            vertices.push(vertex(given));
        }
        monitor.step(Step::default())?;
        let polygons = self.polygons.iter().map(polygon).collect();
        Ok(Self { vertices, polygons, corners: self.corners.clone() })
    }
}

/// The parts of a mesh, sorted by the chart that they lie in.
#[derive(Clone, Debug, PartialEq)]
pub struct TrianglesByChart {
    /// The triangles' corners: numbers of the drawing's vertices.
    pub triangles: Vec<[u32; 3]>,
    /// The face of the mesh that each triangle is a part of.
    pub faces: Vec<FaceId>,
    /// The number of the first triangle of each chart, and one past the end.
    pub starts: Vec<usize>,
}

/// The part of an edge of the base domain inside a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BorderPart {
    /// The base halfedge, in the chart of the part.
    pub border: HalfedgeId,
    /// The face of the mesh.
    pub face: FaceId,
    /// The number of the drawing's vertex at which it begins, in the chart's counter-clockwise order.
    pub from: u32,
    /// The number of the drawing's vertex at which it ends.
    pub to: u32,
}

/// A chart with the motion that takes the plane of a face to it.
#[derive(Clone, Copy)]
struct Seen {
    chart: FaceId,
    /// From the plane of the face to the chart.
    motion: Rigid2,
}

/// Faces and parts of faces between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 8192;

/// Draws a mesh on the charts; `None` where a base edge does not arrive, or base edges cross.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn draw(
    side: Parametrised<'_>,
    surface: &ConeSurface,
    monitor: &mut dyn Monitor,
) -> Result<Option<FlatDrawing>, Cancelled> {
    let mesh = side.mesh;
    let Some(cuts) = Cuts::new(side, surface) else { return Ok(None) };
    monitor.step(Step::default())?;
    let mut parts = Vec::new();
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    for f in mesh.faces() {
        pulse.beat()?;
        let Some(of_face) = cuts.parts(mesh, &surface.base.mesh, f) else { return Ok(None) };
        parts.extend(of_face);
    }
    let neighbours = neighbours_of(&parts, mesh, monitor)?;
    let Some(charts) = charts_of(&parts, &neighbours, side, Charts { surface, cuts: &cuts }, monitor)? else {
        return Ok(None);
    };
    drop(neighbours);
    monitor.step(Step::default())?;
    let mut pen =
        Pen { side, surface, cuts: &cuts, numbers: FxHashMap::default(), drawing: FlatDrawing::default() };
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    for (part, seen) in parts.iter().zip(charts) {
        pulse.beat()?;
        pen.draw(part, seen);
    }
    Ok(Some(pen.drawing))
}

/// The numbers of the parts of faces beside each part of an edge.
fn neighbours_of(
    parts: &[Part],
    mesh: &SurfaceMesh,
    monitor: &mut dyn Monitor,
) -> Result<Neighbours, Cancelled> {
    let mut neighbours = Neighbours::default();
    // Each part of a face has three sides, shared by two.
    neighbours.reserve(parts.len() * 3 / 2);
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    for (k, part) in parts.iter().enumerate() {
        pulse.beat()?;
        for corner in &part.corners {
            if let Some(key) = part_of_edge(mesh, corner.edge) {
                neighbours.entry(key).or_default().push(k as u32);
            }
        }
    }
    Ok(neighbours)
}

/// The charts and the lines between them.
#[derive(Clone, Copy)]
struct Charts<'a> {
    surface: &'a ConeSurface,
    cuts: &'a Cuts,
}

/// The chart of each part: known at base edges, and spread from there across the mesh's edges.
fn charts_of(
    parts: &[Part],
    neighbours: &Neighbours,
    side: Parametrised<'_>,
    Charts { surface, cuts }: Charts<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Option<Vec<Seen>>, Cancelled> {
    let mesh = side.mesh;
    let mut seen: Vec<Option<Seen>> = parts.iter().map(|part| beside_line(part, surface, cuts)).collect();
    let mut stack: Vec<u32> = (0..parts.len() as u32).filter(|&k| seen[k as usize].is_some()).collect();
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    while let Some(k) = stack.pop() {
        pulse.beat()?;
        let Some(here) = seen[k as usize] else { continue };
        for corner in &parts[k as usize].corners {
            let (Some(key), PolygonEdge::OfMesh { halfedge, .. }) =
                (part_of_edge(mesh, corner.edge), corner.edge)
            else {
                continue;
            };
            for &other in neighbours.get(&key).into_iter().flatten() {
                if seen[other as usize].is_none() {
                    let back = &side.embedding.transitions[mesh.twin(halfedge)];
                    seen[other as usize] = Some(Seen { chart: here.chart, motion: here.motion.after(back) });
                    stack.push(other);
                }
            }
        }
    }
    Ok(seen.into_iter().collect())
}

fn part_of_edge(mesh: &SurfaceMesh, side: PolygonEdge) -> Option<PartOfEdge> {
    match side {
        PolygonEdge::OfMesh { halfedge, part } => {
            Some(PartOfEdge { edge: halfedge.min(mesh.twin(halfedge)), part })
        }
        PolygonEdge::OfBase(_) => None,
    }
}

/// The chart of a part that has a base edge on its border.
fn beside_line(part: &Part, surface: &ConeSurface, cuts: &Cuts) -> Option<Seen> {
    let line = part.corners.iter().find_map(|corner| match corner.edge {
        PolygonEdge::OfBase(h) => Some(h),
        PolygonEdge::OfMesh { .. } => None,
    })?;
    let twin = surface.base.mesh.twin(line);
    let chord = cuts.chords[part.face].iter().find(|chord| chord.line == line || chord.line == twin)?;
    let [p, q] = chord.ends;
    let ends = if chord.line == line { [p, q] } else { [q, p] };
    let chart = surface.charts[line.face()];
    let onto = [chart[line.corner()], chart[line.next().corner()]];
    Some(Seen { chart: line.face(), motion: Rigid2::between_segments(ends, onto) })
}

/// The key of a vertex of a drawing: a point has one vertex in each chart.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct VertexKey {
    chart: FaceId,
    node: Node,
}

/// A drawing under way.
struct Pen<'a> {
    side: Parametrised<'a>,
    surface: &'a ConeSurface,
    cuts: &'a Cuts,
    numbers: FxHashMap<VertexKey, u32>,
    drawing: FlatDrawing,
}

impl Pen<'_> {
    fn draw(&mut self, part: &Part, seen: Seen) {
        // The part between a base edge and an edge along which it runs has no area.
        if part.corners.len() < 3 {
            return;
        }
        let begin = self.drawing.corners.len();
        for corner in &part.corners {
            let key = VertexKey { chart: seen.chart, node: corner.node };
            let number = match self.numbers.get(&key) {
                Some(&number) => number,
                None => {
                    let number = self.drawing.vertices.len() as u32;
                    let vertex = self.vertex(part.face, corner.node, seen);
                    self.drawing.vertices.push(vertex);
                    self.numbers.insert(key, number);
                    number
                }
            };
            self.drawing.corners.push(number);
        }
        let corners = begin..self.drawing.corners.len();
        self.drawing.polygons.push(FlatPolygon { face: part.face, chart: seen.chart, corners });
    }

    fn vertex(&self, face: FaceId, node: Node, seen: Seen) -> FlatVertex {
        match node {
            Node::Crossing(number) => {
                let crossing = &self.cuts.crossings[number as usize];
                FlatVertex { place: self.crossed_at(crossing), weights: self.on_side(crossing, seen.chart) }
            }
            Node::Vertex(v) => {
                let weights = self.at_cone(v, seen.chart).unwrap_or_else(|| self.inside(face, v, seen));
                FlatVertex { place: Place::Vertex(v), weights }
            }
        }
    }

    fn crossed_at(&self, crossing: &Crossing) -> Place {
        let Crossing { edge, along_edge, .. } = *crossing;
        Place::of(self.side.mesh, SurfacePoint::on_halfedge(edge, along_edge))
    }

    /// Barycentric coordinates of a point of a base edge in one of the two charts beside it.
    fn on_side(&self, crossing: &Crossing, chart: FaceId) -> [f64; 3] {
        let Crossing { line, along_line, .. } = *crossing;
        let (h, along) = if line.face() == chart {
            (line, along_line)
        } else {
            (self.surface.base.mesh.twin(line), 1.0 - along_line)
        };
        SurfacePoint::on_halfedge(h, along).barycentric
    }

    /// Barycentric coordinates of a landmark in a chart that has it as a corner.
    fn at_cone(&self, v: VertexId, chart: FaceId) -> Option<[f64; 3]> {
        let base = &self.surface.base;
        let is_it = |h: &HalfedgeId| self.side.landmark_vertices[base.tail(*h)] == v;
        let corner = chart.halfedges().into_iter().find(is_it)?.corner();
        Some([0, 1, 2].map(|k| if k == corner { 1.0 } else { 0.0 }))
    }

    fn inside(&self, face: FaceId, v: VertexId, seen: Seen) -> [f64; 3] {
        let corner = self.side.mesh.corner_at(face, v);
        let at: DVec2 = corner.map_or(DVec2::ZERO, |h| self.side.embedding.corners[h]);
        barycentric::clamped_in(self.surface.charts[seen.chart], seen.motion.apply(at))
    }
}

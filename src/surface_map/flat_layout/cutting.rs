//! The faces of one mesh cut along the base domain's edges: the points on the border of each face, the chords that cross it, and the
//! polygons between them.

use crate::landmarks::LandmarkId;
use crate::math::segment::nearest_share_in_plane;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::surface_map::overlay::base_lines::{BaseLine, base_line};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;
use rustc_hash::FxHashMap;
use typed_index_collections::{TiVec, ti_vec};

/// A crossing of an edge of the base domain and an edge of the mesh.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// The base halfedge that is followed: the smaller one of its edge.
    pub line: HalfedgeId,
    /// The place along the base edge, 0 at its start and 1 at its end.
    pub along_line: f64,
    /// The smaller halfedge of the mesh's edge.
    pub edge: HalfedgeId,
    /// The place along the edge, 0 to 1.
    pub along_edge: f64,
}

/// A point on the border of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A vertex of the mesh.
    Vertex(VertexId),
    /// A crossing, by its number.
    Crossing(u32),
}

/// The edge on which an edge of a polygon lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PolygonEdge {
    /// Part `part` of the mesh's edge, counted along its smaller halfedge.
    OfMesh {
        /// The halfedge of the polygon's face.
        halfedge: HalfedgeId,
        /// The number of the part.
        part: u32,
    },
    /// A base edge, run along this base halfedge: its face is that of the polygon.
    OfBase(HalfedgeId),
}

/// A corner of a polygon, and the edge that begins there.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// The point at the corner.
    pub node: Node,
    /// The edge to the next corner.
    pub edge: PolygonEdge,
}

/// A part of a face.
#[derive(Clone, Debug)]
pub struct Part {
    /// The face.
    pub face: FaceId,
    /// Its corners, counter-clockwise.
    pub corners: Vec<Corner>,
}

/// A base edge inside a face.
#[derive(Clone, Copy, Debug)]
pub struct Chord {
    /// The base halfedge.
    pub line: HalfedgeId,
    /// The point at which the base edge enters the face, or starts.
    pub from: Node,
    /// The point at which it leaves the face, or ends.
    pub to: Node,
    /// Both ends of the whole edge in the plane of the face.
    pub ends: [DVec2; 2],
}

/// All base edges on one mesh.
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// All crossings.
    pub crossings: Vec<Crossing>,
    /// The crossings of each edge in order along it, by its smaller halfedge.
    on_edge: TiVec<HalfedgeId, Vec<u32>>,
    /// The chords that cross each face.
    pub chords: TiVec<FaceId, Vec<Chord>>,
}

impl Cuts {
    /// Follows all base edges over the mesh; `None` where one does not arrive at its landmark.
    pub fn new(side: Parametrised<'_>, surface: &ConeSurface) -> Option<Self> {
        let mesh = side.mesh;
        let mut cuts = Self {
            crossings: Vec::new(),
            on_edge: ti_vec![Vec::new(); mesh.face_count() * 3],
            chords: ti_vec![Vec::new(); mesh.face_count()],
        };
        for h in surface.base.mesh.edges() {
            let line = base_line(side, surface, h);
            line.arrival?;
            cuts.add(side, surface, h, &line);
        }
        let crossings = &cuts.crossings;
        for on_edge in &mut cuts.on_edge {
            let along = |c: u32| crossings[c as usize].along_edge;
            on_edge.sort_by(|&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
        }
        Some(cuts)
    }

    fn add(&mut self, side: Parametrised<'_>, surface: &ConeSurface, h: HalfedgeId, line: &BaseLine) {
        let mesh = side.mesh;
        let base = &surface.base;
        let ends: [LandmarkId; 2] = [base.tail(h), base.head(h)];
        let [first, last] = ends.map(|l| Node::Vertex(side.landmark_vertices[l]));
        let mut from = first;
        for (section, point) in line.sections.iter().zip(&line.points[1..]) {
            let to = match section.exit {
                None => last,
                Some(exit) => {
                    let twin = mesh.twin(exit);
                    let along = point.barycentric[exit.next().corner()];
                    let corners = [exit, exit.next()].map(|x| side.embedding.corners[x]);
                    let at = corners[0].lerp(corners[1], along);
                    let along_line = nearest_share_in_plane(at, section.ends);
                    let (edge, along_edge) = if exit < twin { (exit, along) } else { (twin, 1.0 - along) };
                    let number = self.crossings.len() as u32;
                    self.crossings.push(Crossing { line: h, along_line, edge, along_edge });
                    self.on_edge[edge].push(number);
                    Node::Crossing(number)
                }
            };
            self.chords[section.face].push(Chord { line: h, from, to, ends: section.ends });
            from = to;
        }
    }

    /// The parts of a face, cut along its chords; `None` where chords cross.
    pub fn parts(&self, mesh: &SurfaceMesh, base: &SurfaceMesh, face: FaceId) -> Option<Vec<Part>> {
        let mut parts = vec![self.border(mesh, face)];
        for chord in &self.chords[face] {
            let place = |part: &[Corner], node: Node| part.iter().position(|c| c.node == node);
            let cut = parts
                .iter()
                .enumerate()
                .find_map(|(k, part)| Some((k, place(part, chord.from)?, place(part, chord.to)?)));
            let (k, from, to) = cut?;
            let part = parts.swap_remove(k);
            let [left, right] = split(&part, [from, to], [chord.line, base.twin(chord.line)]);
            parts.extend([left, right]);
        }
        Some(parts.into_iter().map(|corners| Part { face, corners }).collect())
    }

    /// The corners of a face and the crossings on its edges, counter-clockwise.
    fn border(&self, mesh: &SurfaceMesh, face: FaceId) -> Vec<Corner> {
        let mut border = Vec::new();
        for halfedge in face.halfedges() {
            let twin = mesh.twin(halfedge);
            let is_smaller = halfedge < twin;
            let crossings = &self.on_edge[halfedge.min(twin)];
            let count = crossings.len();
            let edge = |k: usize| {
                let part = if is_smaller { k } else { count - k } as u32;
                PolygonEdge::OfMesh { halfedge, part }
            };
            border.push(Corner { node: Node::Vertex(mesh.tail(halfedge)), edge: edge(0) });
            for k in 0..count {
                let number = crossings[if is_smaller { k } else { count - 1 - k }];
                border.push(Corner { node: Node::Crossing(number), edge: edge(k + 1) });
            }
        }
        border
    }
}

/// Cuts a polygon from corner `from` to corner `to`: the part left of the cut, then the part right of it, each with the base halfedge
/// along which it borders on the cut.
fn split(part: &[Corner], [from, to]: [usize; 2], [left, right]: [HalfedgeId; 2]) -> [Vec<Corner>; 2] {
    let n = part.len();
    let around = |begin: usize, end: usize| {
        let count = (end + n - begin) % n;
        (0..count).map(move |k| part[(begin + k) % n])
    };
    let start = |at: usize, line| Corner { node: part[at].node, edge: PolygonEdge::OfBase(line) };
    let left = std::iter::once(start(from, left)).chain(around(to, from)).collect();
    let right = std::iter::once(start(to, right)).chain(around(from, to)).collect();
    [left, right]
}

/// The numbers of the parts of faces on both sides of each part of an edge.
pub type Neighbours = FxHashMap<PartOfEdge, Vec<u32>>;

/// A part of an edge between neighbouring crossings or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PartOfEdge {
    /// The edge's smaller halfedge.
    pub edge: HalfedgeId,
    /// The number of the part, counted along the smaller halfedge.
    pub part: u32,
}

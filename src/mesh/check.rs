//! From a polygon soup to one closed, oriented, manifold surface of genus 0, or to a sentence that says why not.

use super::polygon::triangulate;
use super::soup::PolygonSoup;
use super::{FaceId, FileFrame, SurfaceMesh, SurfacePoint, VertexId};
use crate::math::disjoint_sets::DisjointSets;
use crate::math::triangle;
use glam::DVec3;
use rustc_hash::FxHashMap;
use serde::Serialize;
use std::borrow::Cow;
use std::fmt;
use typed_index_collections::{TiSlice, TiVec};

/// A mesh that the pipeline takes.
///
/// Its elements have numbers in the user's file. Vertices and faces that a repair ([`crate::mesh::repair`]) added have none
/// there: they count on from the last number of the file, vertices and faces apart, in the order of the mesh.
#[derive(Clone, Debug)]
pub struct CheckedMesh {
    /// One closed component of genus 0, oriented outwards, in coordinates that formulas can take.
    pub mesh: SurfaceMesh,
    /// From these coordinates to those of the file; the same for usual meshes.
    pub frame: FileFrame,
    /// The mesh's vertex for each vertex of the file; `None` for vertices that no face uses, which are left out.
    pub vertex_from_file: Vec<Option<VertexId>>,
    /// Whether each face was turned, its last two corners exchanged, to agree with its neighbours or to face outwards.
    pub turned: TiVec<FaceId, bool>,
    /// The faces' numbers in the file and their marks, where a repair made or dropped some; `None` where face i of the mesh is
    /// face i of the triangulated file.
    pub repaired_faces: Option<RepairedFaces>,
}

/// Faces of a repaired mesh, beside those of the file.
#[derive(Clone, Debug)]
pub struct RepairedFaces {
    /// Number of faces of the triangulated file.
    pub in_file: usize,
    /// The number of each face of the mesh in the triangulated file, rising; `in_file` or more for faces that the repair made.
    pub number: TiVec<FaceId, u32>,
    /// Whether each face is part of a cap: a surface made up to close a hole.
    pub is_cap: TiVec<FaceId, bool>,
}

impl CheckedMesh {
    /// The number in the file of each of the mesh's vertices, the first one where several became one. Copies of a vertex that
    /// a repair split, and vertices that it added, have numbers from the file's number of vertices on.
    pub fn file_from_vertex(&self) -> Vec<usize> {
        let mut numbers = vec![usize::MAX; self.mesh.vertex_count()];
        for (number, vertex) in self.vertex_from_file.iter().enumerate().rev() {
            if let Some(v) = vertex {
                numbers[v.index()] = number;
            }
        }
        let added = numbers.iter_mut().filter(|number| **number == usize::MAX);
        added.zip(self.vertex_from_file.len()..).for_each(|(number, next)| *number = next);
        numbers
    }

    /// The mesh with the coordinates of the file.
    pub fn mesh_in_file(&self) -> Cow<'_, SurfaceMesh> {
        if self.frame.is_the_files() {
            return Cow::Borrowed(&self.mesh);
        }
        let places = self.mesh.positions().iter().map(|p| self.frame.in_file(*p)).collect();
        Cow::Owned(self.mesh.with_positions(places))
    }

    /// Whether a face is part of a cap.
    pub fn is_cap(&self, face: FaceId) -> bool {
        self.repaired_faces.as_ref().is_some_and(|faces| faces.is_cap.get(face) == Some(&true))
    }

    /// Which faces are part of a cap; `None` where none is.
    pub fn caps(&self) -> Option<&TiSlice<FaceId, bool>> {
        self.repaired_faces.as_ref().filter(|_| self.has_caps()).map(|faces| faces.is_cap.as_slice())
    }

    /// Whether any face is part of a cap.
    pub fn has_caps(&self) -> bool {
        self.repaired_faces.as_ref().is_some_and(|faces| faces.is_cap.raw.contains(&true))
    }

    /// Number of faces of the triangulated file.
    pub fn file_faces(&self) -> usize {
        self.repaired_faces.as_ref().map_or(self.mesh.face_count(), |faces| faces.in_file)
    }

    /// The number of a face of the mesh in the triangulated file, or after its last one where the repair made the face.
    pub fn file_from_face(&self, face: FaceId) -> FaceId {
        let number = self.repaired_faces.as_ref().and_then(|faces| faces.number.get(face));
        number.map_or(face, |number| FaceId(*number))
    }

    /// The face of the mesh that has a number, as [`Self::file_from_face`] gives it; `None` where none has.
    pub fn face_from_file(&self, number: FaceId) -> Option<FaceId> {
        match &self.repaired_faces {
            None => (number.index() < self.mesh.face_count()).then_some(number),
            Some(faces) => faces.number.raw.binary_search(&number.0).ok().map(FaceId::from),
        }
    }

    /// A point of the mesh as one of the file: its face's number there, and the corners in the file's order.
    pub fn on_file(&self, point: SurfacePoint) -> SurfacePoint {
        SurfacePoint { face: self.file_from_face(point.face), ..self.with_file_corners(point) }
    }

    /// Values by vertex of the mesh as values by vertex of the file; `None` for vertices that no face uses.
    pub fn by_file_vertex<T: Copy>(&self, values: &[T]) -> Vec<Option<T>> {
        self.vertex_from_file.iter().map(|v| v.and_then(|v| values.get(v.index()).copied())).collect()
    }

    /// A point of the mesh with its face's corners in the file's order, or the other way round: its own inverse. The face keeps
    /// the mesh's number, see [`Self::on_file`].
    pub fn with_file_corners(&self, point: SurfacePoint) -> SurfacePoint {
        let [a, b, c] = point.barycentric;
        match self.turned.get(point.face) {
            Some(true) => SurfacePoint { barycentric: [a, c, b], ..point },
            _ => point,
        }
    }

    /// How many faces were turned.
    pub fn turned_faces(&self) -> usize {
        self.turned.iter().filter(|turned| **turned).count()
    }
}

/// Elements at fault: how many, and the first few by number.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Elements<T> {
    /// How many.
    pub count: usize,
    /// At most ten of them, in the file's 0-based numbers.
    pub first: Vec<T>,
}

impl<T> Elements<T> {
    /// None at all.
    pub(super) fn none() -> Self {
        Self { count: 0, first: Vec::new() }
    }

    /// These and others.
    pub(super) fn and(mut self, other: Self) -> Self {
        self.count += other.count;
        self.first.extend(other.first);
        self.first.truncate(10);
        self
    }
}

impl<T> FromIterator<T> for Elements<T> {
    fn from_iter<I: IntoIterator<Item = T>>(all: I) -> Self {
        let mut elements = Self::none();
        for element in all {
            elements.count += 1;
            if elements.first.len() < 10 {
                elements.first.push(element);
            }
        }
        elements
    }
}

/// Why a soup is not a closed surface of genus 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFault {
    /// No faces.
    #[error("the mesh has no faces")]
    Empty,
    /// Faces with a repeated vertex or without area.
    #[error("{} without area ({}): remove degenerate faces or merge their vertices", Count::new(&.0.count, "face is", "faces are"), List("face", &.0.first))]
    DegenerateFaces(Elements<usize>),
    /// Edges with three or more faces.
    #[error(
        "{} more than two faces ({}){}: separate or remove the extra faces there",
        Count::new(&.edges.count, "edge has", "edges have"),
        Edges(&.edges.first),
        Parts(*.parts)
    )]
    NonManifoldEdges {
        /// The edges.
        edges: Elements<[usize; 2]>,
        /// Parts into which the surface falls when it is cut there.
        parts: usize,
    },
    /// Edges with one face.
    #[error("the surface is open: {} only one face ({}): close the holes", Count::new(&.0.count, "edge has", "edges have"), Edges(&.0.first))]
    OpenEdges(Elements<[usize; 2]>),
    /// Neighbouring faces that cannot be oriented alike.
    #[error("the surface cannot be oriented: it is one-sided near edge {}-{}", edge[0], edge[1])]
    NotOrientable {
        /// Vertices of the edge.
        edge: [usize; 2],
    },
    /// Vertices where several fans of faces touch.
    #[error("at {} of the surface only touch ({}): split the vertex into one per part", Count::new(&.0.count, "vertex several parts", "vertices several parts"), List("vertex", &.0.first))]
    PinchedVertices(Elements<usize>),
    /// Several components.
    #[error("the mesh has {} separate parts (largest first: {} faces): keep only one of them", .faces.len(), Sizes(.faces))]
    Components {
        /// Faces of each, largest first.
        faces: Vec<usize>,
    },
    /// Handles.
    #[error("the surface has {genus} handle{} (genus {genus}): only surfaces without handles, like a sphere, can be mapped; cut and close the handles", if *.genus == 1 { "" } else { "s" })]
    Genus {
        /// Number of handles.
        genus: usize,
    },
    /// The file says more than fits.
    #[error("the mesh has {faces} faces; the limit is {MAX_FACES}")]
    TooManyFaces {
        /// How many.
        faces: usize,
    },
}

impl MeshFault {
    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Empty => "empty",
            Self::DegenerateFaces(_) => "degenerate_faces",
            Self::NonManifoldEdges { .. } => "non_manifold_edges",
            Self::OpenEdges(_) => "open_edges",
            Self::NotOrientable { .. } => "not_orientable",
            Self::PinchedVertices(_) => "pinched_vertices",
            Self::Components { .. } => "components",
            Self::Genus { .. } => "genus",
            Self::TooManyFaces { .. } => "too_many_faces",
        }
    }
}

/// More faces than this are refused.
pub const MAX_FACES: usize = 20_000_000;

pub(super) struct Count(usize, &'static str, &'static str);

impl Count {
    pub(super) fn new(count: &usize, one: &'static str, many: &'static str) -> Self {
        Self(*count, one, many)
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.0, if self.0 == 1 { self.1 } else { self.2 })
    }
}

struct List<'a>(&'static str, &'a [usize]);

impl fmt::Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers: Vec<_> = self.1.iter().map(usize::to_string).collect();
        write!(f, "{} {}", self.0, numbers.join(", "))
    }
}

struct Edges<'a>(&'a [[usize; 2]]);

impl fmt::Display for Edges<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pairs: Vec<_> = self.0.iter().map(|[a, b]| format!("{a}-{b}")).collect();
        write!(f, "between vertices {}", pairs.join(", "))
    }
}

struct Parts(usize);

impl fmt::Display for Parts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 > 1 { write!(f, ", where {} separate parts meet", self.0) } else { Ok(()) }
    }
}

struct Sizes<'a>(&'a [usize]);

impl fmt::Display for Sizes<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sizes: Vec<_> = self.0.iter().take(10).map(usize::to_string).collect();
        f.write_str(&sizes.join(", "))
    }
}

pub(crate) type Triangle = [u32; 3];

/// Judges a soup: polygons are triangulated, orientations made to agree and to face outwards, unused vertices left out.
///
/// # Errors
/// The first [`MeshFault`] in the order of the enum, with counts and file numbers.
pub fn closed_genus_zero(soup: &PolygonSoup) -> Result<CheckedMesh, MeshFault> {
    closed_genus_zero_asking(soup, &mut || Ok(()))
}

/// The same, and asks between its parts whether to go on.
///
/// # Errors
/// As [`closed_genus_zero`], and what the question answers.
pub(crate) fn closed_genus_zero_asking<E: From<MeshFault>>(
    soup: &PolygonSoup,
    ask: &mut dyn FnMut() -> Result<(), E>,
) -> Result<CheckedMesh, E> {
    let frame = FileFrame::of(soup);
    let checked = judged(&frame.soup(soup), ask)?;
    Ok(CheckedMesh { frame, ..checked })
}

/// Judges a soup of usual coordinates.
fn judged<E: From<MeshFault>>(
    soup: &PolygonSoup,
    ask: &mut dyn FnMut() -> Result<(), E>,
) -> Result<CheckedMesh, E> {
    let (mut triangles, polygon_of) = triangulated(soup)?;
    check_degenerate(soup, &triangles, &polygon_of)?;
    ask()?;
    let edges = EdgeTable::new(&triangles)?;
    ask()?;
    edges.check_closed()?;
    let mut turned = orient(&mut triangles, &edges)?;
    let (vertex_from_file, positions) = used_vertices(soup, &triangles);
    ask()?;
    check_fans(&triangles, &edges, soup.positions.len())?;
    check_components(&edges)?;
    ask()?;
    let euler = positions.len() as i64 - edges.count() as i64 + triangles.len() as i64;
    if euler != 2 {
        return Err(MeshFault::Genus { genus: ((2 - euler) / 2) as usize }.into());
    }
    if signed_volume(soup, &triangles) < 0.0 {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
        turned.iter_mut().for_each(|turned| *turned = !*turned);
    }
    let vertex = |v: u32| vertex_from_file[v as usize].unwrap_or(VertexId(0));
    let faces: TiVec<FaceId, _> = triangles.iter().map(|t| t.map(vertex)).collect();
    let mesh = SurfaceMesh::from_triangles(positions, faces);
    // Everything that could be refused was refused above with better words.
    let mesh = mesh.map_err(|_| MeshFault::PinchedVertices(Elements { count: 1, first: Vec::new() }))?;
    Ok(CheckedMesh { mesh, frame: FileFrame::default(), vertex_from_file, turned, repaired_faces: None })
}

/// Triangles, and the polygon that each comes from.
///
/// # Errors
/// [`MeshFault::Empty`] or [`MeshFault::TooManyFaces`].
pub(crate) fn triangulated(soup: &PolygonSoup) -> Result<(Vec<Triangle>, Vec<usize>), MeshFault> {
    let faces: usize = soup.polygons.iter().map(|p| p.len().saturating_sub(2)).sum();
    if faces == 0 {
        return Err(MeshFault::Empty);
    }
    if faces > MAX_FACES {
        return Err(MeshFault::TooManyFaces { faces });
    }
    let (mut triangles, mut polygon_of) = (Vec::with_capacity(faces), Vec::with_capacity(faces));
    for (f, polygon) in soup.polygons.iter().enumerate() {
        triangulate(&soup.positions, polygon, &mut triangles);
        polygon_of.resize(triangles.len(), f);
    }
    Ok((triangles, polygon_of))
}

fn check_degenerate(
    soup: &PolygonSoup,
    triangles: &[Triangle],
    polygon_of: &[usize],
) -> Result<(), MeshFault> {
    let degenerate = |t: &Triangle| is_degenerate(&soup.positions, t);
    let found = triangles.iter().enumerate().filter(|(_, t)| degenerate(t)).map(|(k, _)| polygon_of[k]);
    let faults: Elements<usize> = found.collect();
    if faults.count > 0 { Err(MeshFault::DegenerateFaces(faults)) } else { Ok(()) }
}

/// Whether a triangle has a vertex twice or no area.
pub(super) fn is_degenerate(positions: &[DVec3], t: &Triangle) -> bool {
    let [p, q, r] = t.map(|v| positions[v as usize]);
    let longest = p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p));
    // Height below 2e-14 of the longest edge: rounding of the coordinates.
    t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || triangle::area(p, q, r) <= 1e-14 * longest
}

/// Each undirected edge with its one or two triangle sides, in order of first appearance.
struct EdgeTable {
    ends: Vec<[u32; 2]>,
    /// Side 3 t + k of each edge's two triangles; `u32::MAX` where the second is missing.
    sides: Vec<[u32; 2]>,
    /// Edge of each side.
    edge_of: Vec<u32>,
}

impl EdgeTable {
    fn new(triangles: &[Triangle]) -> Result<Self, MeshFault> {
        let mut numbers: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        numbers.reserve(triangles.len() * 3 / 2);
        let mut table =
            Self { ends: Vec::new(), sides: Vec::new(), edge_of: Vec::with_capacity(triangles.len() * 3) };
        let mut crowded = Vec::new();
        for (side, (a, b)) in
            triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).enumerate()
        {
            let ends = [a.min(b), a.max(b)];
            let next = table.ends.len() as u32;
            let edge = *numbers.entry(ends).or_insert(next);
            table.edge_of.push(edge);
            if edge == next {
                table.ends.push(ends);
                table.sides.push([side as u32, u32::MAX]);
            } else if table.sides[edge as usize][1] == u32::MAX {
                table.sides[edge as usize][1] = side as u32;
            } else {
                crowded.push(ends.map(|v| v as usize));
            }
        }
        crowded.sort_unstable();
        crowded.dedup();
        if crowded.is_empty() {
            return Ok(table);
        }
        let is_crowded = |ends: [u32; 2]| crowded.binary_search(&ends.map(|v| v as usize)).is_ok();
        let parts = table.components(|e| is_crowded(table.ends[e])).len();
        Err(MeshFault::NonManifoldEdges { edges: crowded.iter().copied().collect(), parts })
    }

    fn count(&self) -> usize {
        self.ends.len()
    }

    fn check_closed(&self) -> Result<(), MeshFault> {
        let open = (0..self.count()).filter(|&e| self.sides[e][1] == u32::MAX);
        let faults: Elements<_> = open.map(|e| self.ends[e].map(|v| v as usize)).collect();
        if faults.count > 0 { Err(MeshFault::OpenEdges(faults)) } else { Ok(()) }
    }

    /// Faces of each part that is connected across edges with two faces and without a cut, largest first.
    fn components(&self, is_cut: impl Fn(usize) -> bool) -> Vec<usize> {
        let triangles = self.edge_of.len() / 3;
        let mut seen = vec![false; triangles];
        let (mut faces, mut stack) = (Vec::new(), Vec::new());
        for start in 0..triangles {
            if std::mem::replace(&mut seen[start], true) {
                continue;
            }
            stack.push(start);
            let mut size = 0;
            while let Some(t) = stack.pop() {
                size += 1;
                for side in 3 * t..3 * t + 3 {
                    let edge = self.edge_of[side] as usize;
                    if self.sides[edge][1] == u32::MAX || is_cut(edge) {
                        continue;
                    }
                    let other = self.across(side) / 3;
                    if !std::mem::replace(&mut seen[other], true) {
                        stack.push(other);
                    }
                }
            }
            faces.push(size);
        }
        faces.sort_unstable_by(|a, b| b.cmp(a));
        faces
    }

    /// The side across.
    fn across(&self, side: usize) -> usize {
        let [a, b] = self.sides[self.edge_of[side] as usize];
        if a as usize == side { b as usize } else { a as usize }
    }
}

/// Turns triangles so that neighbours agree; returns which were turned. Side numbers stay those of the table.
fn orient(triangles: &mut [Triangle], edges: &EdgeTable) -> Result<TiVec<FaceId, bool>, MeshFault> {
    let original = triangles.to_vec();
    let start_of = |side: usize| original[side / 3][side % 3];
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut stack = Vec::new();
    for root in 0..triangles.len() {
        if turned[root].is_some() {
            continue;
        }
        turned[root] = Some(false);
        stack.push(root);
        while let Some(t) = stack.pop() {
            for side in 3 * t..3 * t + 3 {
                let other = edges.across(side);
                // Agreeing neighbours run along their edge in opposite directions.
                let opposed = start_of(side) == start_of(other);
                let wanted = turned[t].map(|x| x != opposed);
                match turned[other / 3] {
                    None => {
                        turned[other / 3] = wanted;
                        stack.push(other / 3);
                    }
                    found if found != wanted => {
                        let edge = edges.ends[edges.edge_of[side] as usize].map(|v| v as usize);
                        return Err(MeshFault::NotOrientable { edge });
                    }
                    _ => {}
                }
            }
        }
    }
    let turned: TiVec<FaceId, bool> = turned.into_iter().map(|x| x == Some(true)).collect();
    for (triangle, _) in triangles.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
        triangle.swap(1, 2);
    }
    Ok(turned)
}

/// The vertex of each vertex of the file, `None` where no triangle has it, and the vertices' positions.
fn used_vertices(
    soup: &PolygonSoup,
    triangles: &[Triangle],
) -> (Vec<Option<VertexId>>, TiVec<VertexId, DVec3>) {
    let mut used = vec![false; soup.positions.len()];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut positions = TiVec::new();
    let number = |(used, p): (bool, &DVec3)| used.then(|| positions.push_and_get_key(*p));
    let mut from_file: Vec<Option<VertexId>> = used.into_iter().zip(&soup.positions).map(number).collect();
    for (vertex, first) in soup.joined_with.iter().enumerate().take(soup.positions.len()) {
        from_file[vertex] = from_file.get(*first as usize).copied().flatten();
    }
    (from_file, positions)
}

/// Every vertex has one fan: its corners are connected through edges at the vertex.
fn check_fans(triangles: &[Triangle], edges: &EdgeTable, vertices: usize) -> Result<(), MeshFault> {
    // Sides belong to the triangles as they were before turning: a corner is named by its vertex instead.
    let corners = triangles.len() * 3;
    let mut sets = DisjointSets::new(corners);
    let corner = |t: usize, v: u32| 3 * t + triangles[t].iter().position(|&w| w == v).unwrap_or(0);
    for (ends, sides) in edges.ends.iter().zip(&edges.sides) {
        for &v in ends {
            let [a, b] = sides.map(|s| corner(s as usize / 3, v));
            sets.join(a, b);
        }
    }
    let mut fans = vec![0_u32; vertices];
    for c in (0..corners).filter(|&c| sets.root(c) == c) {
        fans[triangles[c / 3][c % 3] as usize] += 1;
    }
    let faults: Elements<usize> = (0..vertices).filter(|&v| fans[v] > 1).collect();
    if faults.count > 0 { Err(MeshFault::PinchedVertices(faults)) } else { Ok(()) }
}

fn check_components(edges: &EdgeTable) -> Result<(), MeshFault> {
    let faces = edges.components(|_| false);
    if faces.len() > 1 { Err(MeshFault::Components { faces }) } else { Ok(()) }
}

fn signed_volume(soup: &PolygonSoup, triangles: &[Triangle]) -> f64 {
    let origin = soup.positions[triangles[0][0] as usize];
    let volume = |t: &Triangle| {
        let [p, q, r] = t.map(|v| soup.positions[v as usize] - origin);
        p.dot(q.cross(r))
    };
    triangles.iter().map(volume).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{icosphere, torus};

    #[test]
    fn a_sphere_passes_whatever_its_orientation() {
        let sphere = PolygonSoup::from(&icosphere(2));
        let mut mixed = sphere.clone();
        mixed.polygons.iter_mut().step_by(3).for_each(|p| p.reverse());
        let mut inside_out = sphere.clone();
        inside_out.polygons.iter_mut().for_each(|p| p.reverse());
        for (soup, turned) in [(&sphere, 0), (&mixed, 107), (&inside_out, 320)] {
            let checked = closed_genus_zero(soup).unwrap();
            assert_eq!(checked.turned_faces(), turned);
            let there = |point: SurfacePoint, polygon: &[u32]| {
                let corners = polygon.iter().zip(point.barycentric);
                corners.map(|(&v, w)| soup.positions[v as usize] * w).sum::<DVec3>()
            };
            for (face, polygon) in checked.mesh.faces().zip(&soup.polygons) {
                let point = SurfacePoint { face, barycentric: [0.2, 0.3, 0.5] };
                let in_file = checked.with_file_corners(point);
                assert!(there(in_file, polygon).distance(point.position(&checked.mesh)) < 1e-15);
                assert_eq!(checked.with_file_corners(in_file), point);
            }
            let [p, q, r] = checked.mesh.corners(FaceId(0));
            assert!((q - p).cross(r - p).dot(p) > 0.0);
        }
    }

    #[test]
    fn quads_are_cut_and_unused_vertices_left_out() {
        let positions = (0..8).map(|k| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64));
        let mut soup = PolygonSoup {
            positions: std::iter::once(DVec3::splat(9.0)).chain(positions).collect(),
            polygons: vec![
                vec![0, 2, 3, 1],
                vec![4, 5, 7, 6],
                vec![0, 1, 5, 4],
                vec![2, 6, 7, 3],
                vec![0, 4, 6, 2],
                vec![1, 3, 7, 5],
            ],
            ..PolygonSoup::default()
        };
        soup.polygons.iter_mut().flatten().for_each(|v| *v += 1);
        let checked = closed_genus_zero(&soup).unwrap();
        assert_eq!((checked.mesh.vertex_count(), checked.mesh.face_count()), (8, 12));
        assert!((checked.mesh.area() - 6.0).abs() < 1e-12);
        assert_eq!(checked.vertex_from_file[0], None);
        assert_eq!(checked.vertex_from_file[8], Some(VertexId(7)));
        let numbers = checked.file_from_vertex();
        assert_eq!((numbers[0], numbers[7]), (1, 8));
        let values: Vec<f64> = checked.mesh.positions().iter().map(|p| p.x).collect();
        let by_file = checked.by_file_vertex(&values);
        assert_eq!(by_file[0], None);
        assert!(by_file[1..].iter().zip(&soup.positions[1..]).all(|(x, p)| *x == Some(p.x)));
    }

    #[test]
    fn a_concave_polygon_is_cut_inside() {
        // A prism over an L.
        let l = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
        let positions = [0.0, 1.0].iter().flat_map(|&z| l.map(|(x, y)| DVec3::new(x, y, z))).collect();
        let mut polygons = vec![vec![5, 4, 3, 2, 1, 0], vec![6, 7, 8, 9, 10, 11]];
        polygons.extend((0..6_u32).map(|k| vec![k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k]));
        let checked =
            closed_genus_zero(&PolygonSoup { positions, polygons, ..PolygonSoup::default() }).unwrap();
        assert!((checked.mesh.area() - (2.0 * 3.0 + 8.0)).abs() < 1e-12);
    }

    #[test]
    fn faults_are_named() {
        let sphere = PolygonSoup::from(&icosphere(1));
        let mut open = sphere.clone();
        open.polygons.pop();
        assert!(matches!(closed_genus_zero(&open), Err(MeshFault::OpenEdges(e)) if e.count == 3));
        let mut doubled = sphere.clone();
        doubled.polygons.push(doubled.polygons[0].clone());
        assert!(
            matches!(closed_genus_zero(&doubled), Err(MeshFault::NonManifoldEdges { edges, .. }) if edges.count == 3)
        );
        let mut needle = sphere.clone();
        needle.polygons[7][1] = needle.polygons[7][0];
        assert!(matches!(closed_genus_zero(&needle), Err(MeshFault::DegenerateFaces(e)) if e.first == [7]));
        assert_eq!(
            closed_genus_zero(&PolygonSoup::from(&torus(8, 8))).unwrap_err(),
            MeshFault::Genus { genus: 1 }
        );
        let mut two = sphere.clone();
        let shift = sphere.positions.len() as u32;
        two.positions.extend(sphere.positions.iter().map(|p| *p + DVec3::X * 5.0));
        two.polygons.extend(sphere.polygons.iter().map(|p| p.iter().map(|v| v + shift).collect::<Vec<_>>()));
        assert_eq!(closed_genus_zero(&two).unwrap_err(), MeshFault::Components { faces: vec![80, 80] });
        // Joined at one vertex.
        two.polygons[80..].iter_mut().flatten().filter(|v| **v == shift).for_each(|v| *v = 0);
        assert!(matches!(closed_genus_zero(&two), Err(MeshFault::PinchedVertices(e)) if e.first == [0]));
        assert_eq!(closed_genus_zero(&PolygonSoup::default()).unwrap_err(), MeshFault::Empty);
    }
}

//! Distances on both meshes before any path is drawn: between all landmarks, and from every vertex to every landmark.

use super::path_search::{for_each_link, position};
use super::refinable::RefinableMesh;
use crate::landmarks::{LandmarkId, Landmarks, MeshSide};
use crate::math::min_queue::shortest_paths;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::{TiSlice, TiVec};

/// Lengths of shortest paths over vertices and edge midpoints that pass no other landmark, both areas scaled to 1.
#[derive(Clone, Debug)]
pub struct LandmarkDistances {
    /// The distances from each landmark to every vertex, on each mesh.
    fields: [TiVec<LandmarkId, TiVec<VertexId, f64>>; 2],
    landmarks: [TiVec<LandmarkId, VertexId>; 2],
}

impl LandmarkDistances {
    /// Measures the distances on both meshes.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        meshes: [&SurfaceMesh; 2],
        landmarks: &Landmarks,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let vertices = [&landmarks.source.raw[..], &landmarks.target.raw];
        let refinable = [0, 1].map(|s| RefinableMesh::new(meshes[s], vertices[s]));
        Self::without_paths([&refinable[0], &refinable[1]], vertices, monitor)
    }

    /// Measures the distances on meshes without paths.
    pub(super) fn without_paths(
        meshes: [&RefinableMesh; 2],
        landmarks: [&[VertexId]; 2],
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut fields: [TiVec<LandmarkId, _>; 2] = Default::default();
        let count = (landmarks[0].len() + landmarks[1].len()).max(1) as f64;
        for s in 0..2 {
            monitor.step(Step::default())?;
            let links = Links::new(meshes[s]);
            for &v in landmarks[s] {
                let done = (s * landmarks[0].len() + fields[s].len()) as f64;
                monitor.step(Step { fraction: done / count, residual: None })?;
                fields[s].push(links.distances_to(meshes[s], v));
            }
        }
        Ok(Self { fields, landmarks: landmarks.map(|vertices| vertices.iter().copied().collect()) })
    }

    /// Numbers of vertices of source and target; 0 without landmarks.
    pub(super) fn vertex_counts(&self) -> [usize; 2] {
        self.fields.each_ref().map(|fields| fields.first().map_or(0, |field| field.len()))
    }

    /// Number of landmarks.
    pub fn landmark_count(&self) -> usize {
        self.landmarks[0].len()
    }

    /// Distance of every vertex of one mesh to a landmark.
    pub fn field(&self, side: MeshSide, landmark: LandmarkId) -> &TiSlice<VertexId, f64> {
        &self.fields[side][landmark]
    }

    /// Distances between two landmarks on source and target.
    pub fn between(&self, [i, j]: [LandmarkId; 2]) -> [f64; 2] {
        [0, 1].map(|s| self.fields[s][i][self.landmarks[s][j]])
    }

    /// Sum of the distances on both meshes.
    pub fn sum(&self, ends: [LandmarkId; 2]) -> f64 {
        let [s, t] = self.between(ends);
        s + t
    }
}

/// The path graph of a mesh without paths as one array.
struct Links {
    begin: Vec<u32>,
    links: Vec<Link>,
}

/// A link of the path graph.
struct Link {
    /// The node that it leads to.
    node: u32,
    length: f64,
}

impl Links {
    fn new(mesh: &RefinableMesh) -> Self {
        let nodes = mesh.positions.len() + mesh.twins.len();
        let mut graph = Self { begin: vec![0], links: Vec::with_capacity(15 * nodes) };
        for node in 0..nodes as u32 {
            let from = position(mesh, node);
            for_each_link(mesh, node, |next, _| {
                graph.links.push(Link { node: next, length: from.distance(position(mesh, next)) });
            });
            graph.begin.push(graph.links.len() as u32);
        }
        graph
    }

    fn of(&self, node: usize) -> &[Link] {
        &self.links[self.begin[node] as usize..self.begin[node + 1] as usize]
    }

    /// Lengths of the shortest paths of all vertices to a landmark; other landmarks end paths.
    ///
    /// Not inlined: a browser optimises a function from one call to the next, never within a call.
    #[inline(never)]
    fn distances_to(&self, mesh: &RefinableMesh, landmark: VertexId) -> TiVec<VertexId, f64> {
        let links = |node: u32| self.of(node as usize).iter().map(|link| (link.node, link.length, ()));
        let distance = shortest_paths(self.begin.len() - 1, landmark.0, links, |_, ()| ());
        let vertices = mesh.positions.len();
        let mut field: TiVec<VertexId, f64> = distance[..vertices].iter().copied().collect();
        self.reach_landmarks(mesh, landmark, &distance, &mut field);
        field
    }

    /// Links do not lead into landmarks: their distances come from their neighbours.
    fn reach_landmarks(
        &self,
        mesh: &RefinableMesh,
        landmark: VertexId,
        distance: &[f64],
        field: &mut TiVec<VertexId, f64>,
    ) {
        for v in (0..mesh.positions.len()).map(VertexId::from) {
            if !mesh.used[v] || v == landmark {
                continue;
            }
            let from = |link: &Link| distance[link.node as usize] + link.length;
            let free = self.of(v.index()).iter().map(from).fold(f64::INFINITY, f64::min);
            let edge = mesh
                .halfedge_between(v, landmark)
                .map(|_| mesh.positions[v].distance(mesh.positions[landmark]));
            field[v] = free.min(edge.unwrap_or(f64::INFINITY));
        }
    }
}

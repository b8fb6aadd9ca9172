//! The meshes between a mesh and its base domain, recorded for display where the caller asks for them.

use crate::mesh::VertexId;
use crate::mesh::collapsible::CollapsibleMesh;

/// A mesh after some collapses. Its vertices are some of the input's, at their places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SimplificationStage {
    /// Number of vertices left.
    pub vertices: usize,
    /// Its triangles.
    pub triangles: Vec<[VertexId; 3]>,
    /// The collapses since the stage before, in their order: the vertex that was removed, and the one that it was merged into. Followed
    /// from stage to stage they are the history of each vertex, as in MAPS (Lee et al. 1998).
    pub collapses: Vec<[VertexId; 2]>,
}

/// Records stages, each with about 7/8 of the vertices of the one before: together they have eight times the triangles of the first.
#[derive(Debug)]
pub(super) struct Stages {
    taken: Vec<SimplificationStage>,
    /// The collapses since the last stage.
    collapses: Vec<[VertexId; 2]>,
    /// The next stage is recorded once this many vertices are left.
    next: usize,
}

impl Stages {
    /// Begins with the whole mesh.
    pub fn new(mesh: &CollapsibleMesh) -> Self {
        let mut stages = Self { taken: Vec::new(), collapses: Vec::new(), next: usize::MAX };
        stages.take(mesh);
        stages
    }

    /// Notes that a vertex was merged into another one.
    pub fn collapsed(&mut self, mesh: &CollapsibleMesh, gone: VertexId, onto: VertexId) {
        self.collapses.push([gone, onto]);
        if mesh.live_vertices() <= self.next {
            self.take(mesh);
        }
    }

    fn take(&mut self, mesh: &CollapsibleMesh) {
        let vertices = mesh.live_vertices();
        self.next = (vertices - vertices / 8).min(vertices.saturating_sub(1));
        let stage = self.now(mesh);
        self.taken.push(stage);
    }

    /// The present mesh as a stage, with the collapses since the stage before.
    fn now(&mut self, mesh: &CollapsibleMesh) -> SimplificationStage {
        SimplificationStage {
            vertices: mesh.live_vertices(),
            triangles: mesh.faces().map(|f| mesh.corners(f)).collect(),
            collapses: std::mem::take(&mut self.collapses),
        }
    }

    /// All stages; the last one is the present mesh.
    pub fn ended(mut self, mesh: &CollapsibleMesh) -> Vec<SimplificationStage> {
        let mut last = self.now(mesh);
        // Edges may have been flipped since.
        if let Some(same) = self.taken.pop_if(|stage| stage.vertices == last.vertices) {
            last.collapses.splice(..0, same.collapses);
        }
        self.taken.push(last);
        self.taken
    }
}

//! A mesh on its way to its landmarks, to be looked at: recorded only where somebody asks.

use crate::mesh::VertexId;
use crate::mesh::collapsible::CollapsibleMesh;

/// A mesh some collapses on. Its vertices are some of the mesh's own, which do not move.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SimplificationStage {
    /// How many vertices are left.
    pub vertices: usize,
    /// Its triangles.
    pub triangles: Vec<[VertexId; 3]>,
    /// The collapses since the stage before, in their order: the vertex that went, and the one that it went onto. Followed from stage to
    /// stage they are the history of each vertex, as MAPS has it (Lee et al. 1998).
    pub collapses: Vec<[VertexId; 2]>,
}

/// Takes stages, each with about 7/8 of the vertices of the one before: together they have eight times the triangles of the first.
#[derive(Debug)]
pub(super) struct Stages {
    taken: Vec<SimplificationStage>,
    /// Those since the last one.
    collapses: Vec<[VertexId; 2]>,
    /// The next one is taken with so many vertices.
    next: usize,
}

impl Stages {
    /// Begins with the whole mesh.
    pub fn new(mesh: &CollapsibleMesh) -> Self {
        let mut stages = Self { taken: Vec::new(), collapses: Vec::new(), next: usize::MAX };
        stages.take(mesh);
        stages
    }

    /// A vertex has gone onto another one.
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

    /// The mesh as it is, with the collapses that led to it.
    fn now(&mut self, mesh: &CollapsibleMesh) -> SimplificationStage {
        SimplificationStage {
            vertices: mesh.live_vertices(),
            triangles: mesh.faces().map(|f| mesh.corners(f)).collect(),
            collapses: std::mem::take(&mut self.collapses),
        }
    }

    /// All of them, the last as the mesh is now.
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

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
}

impl SimplificationStage {
    fn of(mesh: &CollapsibleMesh) -> Self {
        Self { vertices: mesh.live_vertices(), triangles: mesh.faces().map(|f| mesh.corners(f)).collect() }
    }
}

/// Takes stages, each with about 7/8 of the vertices of the one before: together they have eight times the triangles of the first.
#[derive(Debug)]
pub(super) struct Stages {
    taken: Vec<SimplificationStage>,
    /// The next one is taken with so many vertices.
    next: usize,
}

impl Stages {
    /// Begins with the whole mesh.
    pub fn new(mesh: &CollapsibleMesh) -> Self {
        let mut stages = Self { taken: Vec::new(), next: usize::MAX };
        stages.take(mesh);
        stages
    }

    /// A vertex has gone.
    pub fn collapsed(&mut self, mesh: &CollapsibleMesh) {
        if mesh.live_vertices() <= self.next {
            self.take(mesh);
        }
    }

    fn take(&mut self, mesh: &CollapsibleMesh) {
        let vertices = mesh.live_vertices();
        self.next = (vertices - vertices / 8).min(vertices.saturating_sub(1));
        self.taken.push(SimplificationStage::of(mesh));
    }

    /// All of them, the last as the mesh is now.
    pub fn ended(mut self, mesh: &CollapsibleMesh) -> Vec<SimplificationStage> {
        let last = SimplificationStage::of(mesh);
        if self.taken.last().is_some_and(|stage| stage.vertices == last.vertices) {
            self.taken.pop();
        }
        self.taken.push(last);
        self.taken
    }
}

//! The input of a matching.

use crate::landmarks::MeshSide;
use crate::mesh::{SurfaceMesh, VertexId};
use typed_index_collections::TiSlice;

/// Two meshes with the given landmark pairs.
#[derive(Clone, Copy, Debug)]
pub struct MatchInput<'a> {
    /// The source, closed and of genus 0.
    pub source: &'a SurfaceMesh,
    /// The target, closed and of genus 0.
    pub target: &'a SurfaceMesh,
    /// Pairs of vertices that are held, different ones on each mesh; there may be none.
    pub given: &'a [[VertexId; 2]],
    /// The vertices that may be landmarks.
    pub may_mark: MayMark<'a>,
}

/// Which vertices of each mesh may be landmarks; `None` where all may.
#[derive(Clone, Copy, Debug, Default)]
pub struct MayMark<'a> {
    /// Whether each vertex of the source may be a landmark.
    pub source: Option<&'a TiSlice<VertexId, bool>>,
    /// Whether each vertex of the target may be a landmark.
    pub target: Option<&'a TiSlice<VertexId, bool>>,
}

impl<'a> MatchInput<'a> {
    /// Two meshes without given pairs; every vertex may be a landmark.
    pub fn new(source: &'a SurfaceMesh, target: &'a SurfaceMesh) -> Self {
        Self { source, target, given: &[], may_mark: MayMark::default() }
    }

    /// Source and target.
    pub(super) fn meshes(&self) -> [&'a SurfaceMesh; 2] {
        [self.source, self.target]
    }

    /// Whether a vertex of one mesh may be a landmark.
    pub(super) fn may(&self, side: MeshSide, v: VertexId) -> bool {
        [self.may_mark.source, self.may_mark.target][side].is_none_or(|may| may[v])
    }
}

//! Checked pairs of corresponding vertices.
//!
//! A landmark picked inside a face or on an edge becomes a vertex first: the later stages see vertices only.

use crate::mesh::{SurfaceMesh, VertexId, ids_id as id};

id!(
    /// A landmark: the same number on the source, the target and the base domain.
    LandmarkId
);

/// Corresponding vertices of two meshes, at least 4, distinct on each mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmarks {
    /// Vertex of the source, by landmark.
    pub source: Vec<VertexId>,
    /// Vertex of the target, by landmark.
    pub target: Vec<VertexId>,
}

/// Why landmarks cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LandmarkError {
    /// Fewer than four pairs.
    #[error("{count} landmark pairs are too few: pick at least 4")]
    TooFew {
        /// Number of pairs.
        count: usize,
    },
    /// A vertex number out of range.
    #[error("landmark pair {pair} names vertex {vertex}, but the mesh has {vertices} vertices")]
    MissingVertex {
        /// The pair, 0-based.
        pair: usize,
        /// The vertex number.
        vertex: usize,
        /// Number of vertices of the mesh.
        vertices: usize,
    },
    /// Two pairs on one vertex.
    #[error("landmark pairs {} and {} are at the same vertex", pairs[0], pairs[1])]
    Coincident {
        /// The pairs, 0-based.
        pairs: [usize; 2],
    },
}

impl Landmarks {
    /// Checks vertex pairs against both meshes.
    ///
    /// # Errors
    /// [`LandmarkError`] for too few, missing or coincident vertices.
    pub fn from_vertices(
        source: &SurfaceMesh,
        target: &SurfaceMesh,
        pairs: &[[u32; 2]],
    ) -> Result<Self, LandmarkError> {
        if pairs.len() < 4 {
            return Err(LandmarkError::TooFew { count: pairs.len() });
        }
        let side = |k: usize, mesh: &SurfaceMesh| checked_side(pairs, k, mesh);
        Ok(Self { source: side(0, source)?, target: side(1, target)? })
    }

    /// Number of landmarks.
    pub fn len(&self) -> usize {
        self.source.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.source.is_empty()
    }
}

fn checked_side(pairs: &[[u32; 2]], k: usize, mesh: &SurfaceMesh) -> Result<Vec<VertexId>, LandmarkError> {
    let mut vertices = Vec::with_capacity(pairs.len());
    for (pair, ends) in pairs.iter().enumerate() {
        let v = VertexId(ends[k]);
        if v.index() >= mesh.vertex_count() {
            let vertices = mesh.vertex_count();
            return Err(LandmarkError::MissingVertex { pair, vertex: v.index(), vertices });
        }
        if let Some(other) = vertices.iter().position(|&w| w == v) {
            return Err(LandmarkError::Coincident { pairs: [other, pair] });
        }
        vertices.push(v);
    }
    Ok(vertices)
}

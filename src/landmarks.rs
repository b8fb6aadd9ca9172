//! Checked pairs of corresponding vertices.
//!
//! A landmark picked inside a face or on an edge becomes a vertex first: the later stages see vertices only.

use crate::io::landmark_file::LandmarkPoint;
use crate::mesh::check::CheckedMesh;
use crate::mesh::insertion::{Insertion, insert};
use crate::mesh::{FaceId, MeshError, SurfaceMesh, SurfacePoint, VertexId, ids_id as id};

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
    /// A face number out of range.
    #[error("landmark pair {pair} names face {face}, but the mesh has {faces} faces")]
    MissingFace {
        /// The pair, 0-based.
        pair: usize,
        /// The face number.
        face: usize,
        /// Number of faces of the mesh.
        faces: usize,
    },
    /// Weights that are no barycentric coordinates.
    #[error(
        "landmark pair {pair} has the barycentric coordinates {weights:?}: they must not be negative and sum to 1"
    )]
    Barycentric {
        /// The pair, 0-based.
        pair: usize,
        /// As given.
        weights: [f64; 3],
    },
    /// Insertion failed.
    #[error("a landmark could not be inserted: {0}")]
    Insertion(#[from] MeshError),
}

/// Landmarks that are vertices of meshes refined where they had to be inserted.
#[derive(Clone, Debug)]
pub struct PlacedLandmarks {
    /// The source with its landmarks inserted.
    pub source: Insertion,
    /// The target with its landmarks inserted.
    pub target: Insertion,
    /// The pairs.
    pub landmarks: Landmarks,
}

/// Makes vertices of all landmark points; vertex numbers are the file's, faces those of the triangulated mesh.
///
/// # Errors
/// [`LandmarkError`] with the number of the pair.
pub fn place(
    meshes: [&CheckedMesh; 2],
    pairs: &[[LandmarkPoint; 2]],
) -> Result<PlacedLandmarks, LandmarkError> {
    let side = |k: usize| -> Result<Insertion, LandmarkError> {
        let points = pairs.iter().enumerate().map(|(pair, ends)| point(meshes[k], pair, ends[k]));
        Ok(insert(&meshes[k].mesh, &points.collect::<Result<Vec<_>, _>>()?)?)
    };
    let (source, target) = (side(0)?, side(1)?);
    let vertices = source.vertices.iter().zip(&target.vertices).map(|(s, t)| [s.0, t.0]).collect::<Vec<_>>();
    let landmarks = Landmarks::from_vertices(&source.mesh, &target.mesh, &vertices)?;
    Ok(PlacedLandmarks { source, target, landmarks })
}

fn point(checked: &CheckedMesh, pair: usize, point: LandmarkPoint) -> Result<SurfacePoint, LandmarkError> {
    let mesh = &checked.mesh;
    match point {
        LandmarkPoint::Vertex(vertex) => {
            let known = checked.vertex_from_file.get(vertex as usize).copied().flatten();
            let vertices = checked.vertex_from_file.len();
            let missing = LandmarkError::MissingVertex { pair, vertex: vertex as usize, vertices };
            Ok(SurfacePoint::at_vertex(mesh, known.ok_or(missing)?))
        }
        LandmarkPoint::OnFace { face, barycentric } => {
            let faces = mesh.face_count();
            if face as usize >= faces {
                return Err(LandmarkError::MissingFace { pair, face: face as usize, faces });
            }
            let sum: f64 = barycentric.iter().sum();
            if !barycentric.iter().all(|w| *w >= -1e-6) || sum.is_nan() || (sum - 1.0).abs() >= 1e-4 {
                return Err(LandmarkError::Barycentric { pair, weights: barycentric });
            }
            let clamped = barycentric.map(|w| w.max(0.0));
            let sum: f64 = clamped.iter().sum();
            Ok(SurfacePoint { face: FaceId(face), barycentric: clamped.map(|w| w / sum) })
        }
    }
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

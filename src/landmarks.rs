//! Checked pairs of corresponding vertices.
//!
//! A landmark picked inside a face or on an edge becomes a vertex first: the later stages see vertices only.

use crate::io::landmark_file::LandmarkPoint;
use crate::mesh::check::{CheckedMesh, NoVertex};
use crate::mesh::insertion::{Insertion, insert};
use crate::mesh::{FaceId, MeshError, SurfaceMesh, SurfacePoint, VertexId, ids_id as id};
use rustc_hash::FxHashMap;
use typed_index_collections::TiVec;

pub use crate::mesh_side::MeshSide;

id!(
    /// A landmark: the same number on the source, the target and the base domain.
    LandmarkId
);

/// A map needs so many landmarks.
pub const LEAST_LANDMARKS: usize = 4;

/// Corresponding vertices of two meshes, at least 4, distinct on each mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmarks {
    /// Vertex of the source, by landmark.
    pub source: TiVec<LandmarkId, VertexId>,
    /// Vertex of the target, by landmark.
    pub target: TiVec<LandmarkId, VertexId>,
}

/// Why landmarks cannot be used. Its words count the pairs from 1, as people do; its fields from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LandmarkError {
    /// Fewer than four pairs.
    #[error("{count} landmark pairs are too few: pick at least {LEAST_LANDMARKS}")]
    TooFew {
        /// Number of pairs.
        count: usize,
    },
    /// A vertex number out of range.
    #[error("landmark pair {} (the first is 1) names vertex {vertex}, but the {side} has {vertices} vertices", pair + 1)]
    MissingVertex {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
        /// The vertex number.
        vertex: usize,
        /// Number of vertices of the mesh.
        vertices: usize,
    },
    /// A vertex of the file that is no vertex of its surface.
    #[error("landmark pair {} (the first is 1) names vertex {vertex}, which no face of the {side} uses", pair + 1)]
    UnusedVertex {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
        /// The vertex number.
        vertex: usize,
    },
    /// Two pairs on one vertex.
    #[error("landmark pairs {} and {} (the first is 1) are at the same vertex of the {side}", pairs[0] + 1, pairs[1] + 1)]
    Coincident {
        /// The mesh.
        side: MeshSide,
        /// The pairs, 0-based.
        pairs: [usize; 2],
    },
    /// A face number out of range.
    #[error("landmark pair {} (the first is 1) names face {face}, but the {side} has {faces} faces", pair + 1)]
    MissingFace {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
        /// The face number.
        face: usize,
        /// Number of faces of the mesh.
        faces: usize,
    },
    /// A face that the repair of its mesh dropped.
    #[error(
        "landmark pair {} (the first is 1) is on face {face} of the {side}, which the repair of the mesh dropped",
        pair + 1
    )]
    DroppedFace {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
        /// The face number.
        face: usize,
    },
    /// A face of a cap.
    #[error(
        "landmark pair {} (the first is 1) lies in a cap of the {side}, which was made up to close a hole: move it onto the \
         skin around",
        pair + 1
    )]
    InCap {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
    },
    /// Weights that are no barycentric coordinates.
    #[error(
        "landmark pair {} (the first is 1) has the barycentric coordinates {weights:?} on the {side}: they must not be \
         negative and sum to 1",
        pair + 1
    )]
    Barycentric {
        /// The mesh.
        side: MeshSide,
        /// The pair, 0-based.
        pair: usize,
        /// The weights as they were given.
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

/// Makes vertices of all landmark points. Vertex numbers are the file's; faces those of the triangulated mesh, with their
/// corners in the file's order.
///
/// # Errors
/// [`LandmarkError`] with the number of the pair.
pub fn place(
    meshes: [&CheckedMesh; 2],
    pairs: &[[LandmarkPoint; 2]],
) -> Result<PlacedLandmarks, LandmarkError> {
    let [source, target] = MeshSide::BOTH.map(|side| points(meshes[side], side, pairs));
    place_points(meshes.map(|checked| &checked.mesh), [&source?, &target?])
}

/// Makes vertices of points of both meshes, as many on each.
///
/// # Errors
/// [`LandmarkError`] with the number of the pair.
pub fn place_points(
    [source, target]: [&SurfaceMesh; 2],
    [on_source, on_target]: [&[SurfacePoint]; 2],
) -> Result<PlacedLandmarks, LandmarkError> {
    let (source, target) = (insert(source, on_source)?, insert(target, on_target)?);
    let vertices = source.vertices.iter().zip(&target.vertices).map(|(s, t)| [s.0, t.0]).collect::<Vec<_>>();
    let landmarks = Landmarks::from_vertices(&source.mesh, &target.mesh, &vertices)?;
    Ok(PlacedLandmarks { source, target, landmarks })
}

/// Whether the landmark points of one side are different points of its mesh, as [`place`] demands; there may be fewer than a
/// map needs.
///
/// # Errors
/// [`LandmarkError`] with the number of the first pair that is not, or of the first two at one vertex.
pub fn check_side(
    mesh: &CheckedMesh,
    side: MeshSide,
    pairs: &[[LandmarkPoint; 2]],
) -> Result<(), LandmarkError> {
    let inserted = insert(&mesh.mesh, &points(mesh, side, pairs)?)?;
    distinct(&inserted.vertices, side)
}

/// The landmark points of one side as points of its mesh, in the order of the pairs.
///
/// # Errors
/// [`LandmarkError`] with the number of the first pair whose point the mesh does not have.
pub fn points(
    mesh: &CheckedMesh,
    side: MeshSide,
    pairs: &[[LandmarkPoint; 2]],
) -> Result<Vec<SurfacePoint>, LandmarkError> {
    pairs.iter().enumerate().map(|(pair, ends)| point(mesh, side, pair, ends[side])).collect()
}

fn point(
    checked: &CheckedMesh,
    side: MeshSide,
    pair: usize,
    point: LandmarkPoint,
) -> Result<SurfacePoint, LandmarkError> {
    let mesh = &checked.mesh;
    match point {
        LandmarkPoint::Vertex(vertex) => {
            let known = checked.numbered_vertex(vertex as usize).map_err(|none| match none {
                NoVertex::Missing { number: vertex, vertices } => {
                    LandmarkError::MissingVertex { side, pair, vertex, vertices }
                }
                NoVertex::Unused { number: vertex } => LandmarkError::UnusedVertex { side, pair, vertex },
            });
            Ok(SurfacePoint::at_vertex(mesh, known?))
        }
        on_face @ LandmarkPoint::OnFace { face, barycentric } => {
            let known = checked.face_from_file(FaceId(face));
            let face = known.ok_or_else(|| missing_face(checked, side, pair, face))?;
            if checked.is_cap(face) {
                return Err(LandmarkError::InCap { side, pair });
            }
            if !on_face.is_sound() {
                return Err(LandmarkError::Barycentric { side, pair, weights: barycentric });
            }
            Ok(checked.with_file_corners(SurfacePoint::clamped(face, barycentric)))
        }
    }
}

/// A face that the file does not have, or that its repair dropped.
fn missing_face(checked: &CheckedMesh, side: MeshSide, pair: usize, face: u32) -> LandmarkError {
    let (face, faces) = (face as usize, checked.file_faces());
    if face < faces {
        LandmarkError::DroppedFace { side, pair, face }
    } else {
        LandmarkError::MissingFace { side, pair, face, faces }
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
        if pairs.len() < LEAST_LANDMARKS {
            return Err(LandmarkError::TooFew { count: pairs.len() });
        }
        Ok(Self {
            source: checked_side(pairs, MeshSide::Source, source)?.into(),
            target: checked_side(pairs, MeshSide::Target, target)?.into(),
        })
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

fn checked_side(
    pairs: &[[u32; 2]],
    side: MeshSide,
    mesh: &SurfaceMesh,
) -> Result<Vec<VertexId>, LandmarkError> {
    let vertices: Vec<VertexId> = pairs.iter().map(|ends| VertexId(ends[side])).collect();
    let count = mesh.vertex_count();
    if let Some(pair) = vertices.iter().position(|v| v.index() >= count) {
        let vertex = vertices[pair].index();
        return Err(LandmarkError::MissingVertex { side, pair, vertex, vertices: count });
    }
    distinct(&vertices, side)?;
    Ok(vertices)
}

fn distinct(vertices: &[VertexId], side: MeshSide) -> Result<(), LandmarkError> {
    let mut first = FxHashMap::default();
    for (pair, v) in vertices.iter().enumerate() {
        if let Some(other) = first.insert(v, pair) {
            return Err(LandmarkError::Coincident { side, pairs: [other, pair] });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::{check, soup};

    fn ball() -> CheckedMesh {
        let mesh = icosphere(0);
        let polygons = mesh.triangles().iter().map(|t| t.map(|v| v.0).to_vec()).collect();
        let positions = mesh.positions().iter().copied().collect();
        let soup = soup::PolygonSoup { positions, polygons, ..soup::PolygonSoup::default() };
        check::closed_genus_zero(&soup).unwrap()
    }

    #[test]
    fn a_point_that_is_not_there_is_named_with_its_pair_and_mesh() {
        let ball = ball();
        let at = LandmarkPoint::Vertex;
        let on = |face, barycentric| LandmarkPoint::OnFace { face, barycentric };
        let check = |pairs: &[[LandmarkPoint; 2]]| {
            MeshSide::BOTH.iter().try_for_each(|&side| check_side(&ball, side, pairs))
        };
        let wrong = |pair: [LandmarkPoint; 2]| check(&[[at(0), at(0)], pair]).unwrap_err();
        assert_eq!(
            wrong([at(3), at(99)]).to_string(),
            "landmark pair 2 (the first is 1) names vertex 99, but the target has 12 vertices"
        );
        assert_eq!(
            wrong([on(20, [1.0, 0.0, 0.0]), at(1)]).to_string(),
            "landmark pair 2 (the first is 1) names face 20, but the source has 20 faces"
        );
        let heavy = wrong([on(0, [0.5, 0.6, 0.5]), at(1)]);
        assert!(matches!(heavy, LandmarkError::Barycentric { side: MeshSide::Source, pair: 1, .. }));
        assert_eq!(check(&[[at(0), on(19, [0.2, 0.3, 0.5])]]), Ok(()));
    }

    #[test]
    fn two_pairs_at_one_vertex_are_named_however_it_is_written() {
        let mut ball = ball();
        // As if the file had the first vertex twice, and one that no face uses.
        ball.vertex_from_file.extend([Some(VertexId(0)), None]);
        let at = LandmarkPoint::Vertex;
        let corner = ball.mesh.triangles()[FaceId(4)][1];
        let on_corner = LandmarkPoint::OnFace { face: 4, barycentric: [1e-12, 1.0, 0.0] };
        let wrong = |points: [LandmarkPoint; 3]| {
            let pairs: Vec<_> = (1..).zip(points).map(|(v, p)| [at(v), p]).collect();
            assert_eq!(check_side(&ball, MeshSide::Source, &pairs), Ok(()));
            check_side(&ball, MeshSide::Target, &pairs).unwrap_err()
        };
        let same = |pairs| LandmarkError::Coincident { side: MeshSide::Target, pairs };
        assert_eq!(wrong([at(0), at(12), at(1)]), same([0, 1]));
        let others = ball.mesh.vertices().find(|v| *v != corner).unwrap();
        assert_eq!(wrong([on_corner, at(others.0), at(corner.0)]), same([0, 2]));
        assert_eq!(
            wrong([at(0), at(1), at(13)]).to_string(),
            "landmark pair 3 (the first is 1) names vertex 13, which no face of the target uses"
        );
    }
}

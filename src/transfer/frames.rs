//! Frames: mesh files with the polygons of a mesh and its vertices elsewhere.

use super::deformation::Shape;
use crate::io::{self, ReadError};
use crate::map_file::FileMesh;
use crate::mesh::VertexId;
use glam::DVec3;
use typed_index_collections::TiSlice;

/// Why a mesh file is no frame of a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The mesh is not that of its file.
    #[error(
        "the mesh that it should be a frame of was repaired: save it by `conemap check MESH --repair --out FILE`, and map that one"
    )]
    Repaired,
    /// The file has other vertices.
    #[error("it has {found} vertices, but the mesh that it should be a frame of has {expected}")]
    Vertices {
        /// Number of vertices of the file.
        found: usize,
        /// Number of vertices of the mesh.
        expected: usize,
    },
    /// The file has other polygons.
    #[error("it has {found} faces, but the mesh that it should be a frame of has {expected}")]
    Faces {
        /// Number of polygons of the file.
        found: usize,
        /// Number of polygons of the mesh.
        expected: usize,
    },
    /// A polygon of the file has other corners.
    #[error(
        "its face {face} has the vertices {found:?}, but that of the mesh that it should be a frame of has {expected:?}: frames must \
         have its vertices and faces in its order"
    )]
    Corners {
        /// The number of the polygon.
        face: usize,
        /// The first corners of the file's polygon.
        found: Vec<u32>,
        /// The corners of the mesh's polygon.
        expected: Vec<u32>,
    },
}

/// Reads the positions of a mesh's vertices in a frame, a file of any known format; mirrored where the mesh is.
///
/// # Errors
/// [`FrameError`].
pub fn read(mesh: &FileMesh, bytes: &[u8]) -> Result<Shape, FrameError> {
    if mesh.is_repaired() {
        return Err(FrameError::Repaired);
    }
    let soup = io::read_mesh(bytes)?;
    let (found, expected) = (soup.positions.len(), mesh.file_vertices());
    if found != expected {
        return Err(FrameError::Vertices { found, expected });
    }
    let (found, expected) = (soup.polygons.len(), mesh.polygons().len());
    if found != expected {
        return Err(FrameError::Faces { found, expected });
    }
    let mut pairs = soup.polygons.iter().zip(mesh.polygons());
    if let Some(face) = pairs.position(|(a, b)| a != b) {
        let corners = |polygon: &Vec<u32>| polygon.iter().take(6).copied().collect();
        let [found, expected] = [&soup.polygons[face], &mesh.polygons()[face]].map(corners);
        return Err(FrameError::Corners { face, found, expected });
    }
    // A mirrored place mirrored again is the given one.
    let position = |v| mesh.as_given(mesh.frame().on_mesh(soup.positions[mesh.vertex_number(v)]));
    Ok(mesh.mesh().vertices().map(position).collect())
}

/// The positions of a shape of a mesh by its file's vertices, not mirrored; of a vertex that no face uses where the first one is.
pub fn of_file(mesh: &FileMesh, shape: &TiSlice<VertexId, DVec3>) -> Vec<DVec3> {
    let told: Vec<DVec3> = shape.iter().map(|p| mesh.in_file(*p)).collect();
    let first = told.first().copied().unwrap_or_default();
    mesh.checked().by_file_vertex(&told).into_iter().map(|p| p.unwrap_or(first)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::obj;
    use crate::mesh::generators::icosphere;
    use crate::mesh::mirror::TargetImage;

    #[test]
    fn a_frame_has_the_mesh_s_vertices_and_faces() {
        let mesh = icosphere(1);
        let mut positions: Vec<DVec3> = mesh.positions().iter().copied().collect();
        let mut faces: Vec<[u32; 3]> = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        // A vertex that no face uses, before all others.
        positions.insert(0, DVec3::splat(9.0));
        faces.iter_mut().flatten().for_each(|v| *v += 1);
        let file = FileMesh::read(&obj::polygons(&positions, &faces)).unwrap();
        for (image, sign) in [(TargetImage::AsGiven, 1.0), (TargetImage::Mirrored, -1.0)] {
            let file = if image == TargetImage::Mirrored {
                file.clone().into_mirrored().unwrap()
            } else {
                file.clone()
            };
            let moved: Vec<DVec3> = positions.iter().map(|p| *p * 2.0 + DVec3::X).collect();
            let shape = read(&file, &obj::polygons(&moved, &faces)).unwrap();
            let wanted = mesh.positions().iter().map(|p| (*p * 2.0 + DVec3::X) * DVec3::new(sign, 1.0, 1.0));
            assert!(shape.iter().zip(wanted).all(|(p, q)| *p == q));
            assert_eq!(of_file(&file, &shape)[1..], moved[1..]);
            assert_eq!(of_file(&file, &shape)[0], moved[1]);
        }
        let refused = |positions: &[DVec3], faces: &[[u32; 3]]| {
            read(&file, &obj::polygons(positions, faces)).unwrap_err().to_string()
        };
        assert_eq!(
            refused(&positions[1..], &faces[..0]),
            "it has 42 vertices, but the mesh that it should be a frame of has 43"
        );
        assert!(refused(&positions, &faces[..79]).starts_with("it has 79 faces, but"));
        faces[5].rotate_left(1);
        assert!(refused(&positions, &faces).starts_with("its face 5 has the vertices ["));
        assert!(matches!(read(&file, b"nothing"), Err(FrameError::Read(_))));
    }
}

//! A checked mesh, and the numbers of its elements in the user's file.

use crate::mesh::{FaceId, FileFrame, SurfaceMesh, SurfacePoint, VertexId};
use std::borrow::Cow;
use typed_index_collections::{TiSlice, TiVec};

/// A mesh that the pipeline takes.
///
/// Its elements have numbers in the user's file. Vertices and faces that a repair ([`crate::mesh::repair`]) added have none
/// there: they count on from the last number of the file, vertices and faces apart, in the order of the mesh.
#[derive(Clone, Debug)]
pub struct CheckedMesh {
    /// One closed component of genus 0, oriented outwards, in coordinates that formulas can take.
    pub mesh: SurfaceMesh,
    /// The way from these coordinates to those of the file; the same coordinates for usual meshes.
    pub frame: FileFrame,
    /// The mesh's vertex for each vertex of the file; `None` for vertices that no face uses, which are left out.
    pub vertex_from_file: Vec<Option<VertexId>>,
    /// Whether each face was turned, its last two corners exchanged, to agree with its neighbours or to face outwards.
    pub turned: TiVec<FaceId, bool>,
    /// The faces' numbers in the file and their marks, where a repair made or dropped some; `None` where face i of the mesh is
    /// face i of the triangulated file.
    pub repaired_faces: Option<RepairedFaces>,
}

/// Why a number of a vertex of the file names none of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoVertex {
    /// The number is out of range.
    #[error("there is no vertex {number}: the mesh file has {vertices} vertices")]
    Missing {
        /// The number.
        number: usize,
        /// Number of vertices of the file.
        vertices: usize,
    },
    /// No face has the vertex.
    #[error("no face of the mesh uses vertex {number}")]
    Unused {
        /// The number.
        number: usize,
    },
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
    /// The vertex of the mesh that has a number in the file.
    ///
    /// # Errors
    /// [`NoVertex`] where the file has no such number, or no face uses the vertex.
    pub fn numbered_vertex(&self, number: usize) -> Result<VertexId, NoVertex> {
        let missing = NoVertex::Missing { number, vertices: self.vertex_from_file.len() };
        let known = self.vertex_from_file.get(number).ok_or(missing)?;
        known.ok_or(NoVertex::Unused { number })
    }

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

    /// The number of faces that were turned.
    pub fn turned_faces(&self) -> usize {
        self.turned.iter().filter(|turned| **turned).count()
    }
}

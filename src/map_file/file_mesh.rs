//! A mesh with what is known of its file: its bytes' hash, its polygons, its own numbers.

use crate::io::{self, ReadError};
use crate::mesh::check::{CheckedMesh, MeshFault, closed_genus_zero};
use crate::mesh::mirror::{TargetImage, mirrored, mirrored_point};
use crate::mesh::{FaceId, FileFrame, MeshError, SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;
use sha2::{Digest, Sha256};

/// A SHA-256 hash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hash(pub [u8; 32]);

impl Hash {
    fn of(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// The hash of a checked mesh, over these numbers, all little-endian: numbers of vertices and faces of the mesh and of vertices of the
    /// file (u64), coordinates as in the file (f64), faces (u32), the vertex of each of the file's vertices (u32, 2^32 - 1 for none) and
    /// which faces were turned (u8).
    pub fn of_checked(checked: &CheckedMesh) -> Self {
        let mesh = &checked.mesh;
        let mut hash = Sha256::new();
        for count in [mesh.vertex_count(), mesh.face_count(), checked.vertex_from_file.len()] {
            hash.update((count as u64).to_le_bytes());
        }
        for p in mesh.positions() {
            checked.frame.in_file(*p).to_array().iter().for_each(|x| hash.update(x.to_le_bytes()));
        }
        for v in mesh.triangles().iter().flatten() {
            hash.update(v.0.to_le_bytes());
        }
        for v in &checked.vertex_from_file {
            hash.update(v.map_or(u32::MAX, |v| v.0).to_le_bytes());
        }
        for &turned in &checked.turned {
            hash.update([u8::from(turned)]);
        }
        Self(hash.finalize().into())
    }
}

impl std::fmt::Display for Hash {
    /// 64 hexadecimal digits, small letters.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// A checked mesh with its file's facts. Its mesh may be the mirror image of the file's.
#[derive(Clone, Debug)]
pub struct FileMesh {
    checked: CheckedMesh,
    image: TargetImage,
    polygons: Vec<Vec<u32>>,
    numbers: Vec<usize>,
    bytes: usize,
    hash: Hash,
    checked_hash: Hash,
}

/// Why a mesh file cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FileMeshError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The mesh is not one closed surface of genus 0.
    #[error(transparent)]
    Mesh(#[from] MeshFault),
}

impl FileMesh {
    /// Reads and checks a mesh file of any known format.
    ///
    /// # Errors
    /// [`FileMeshError`].
    pub fn read(bytes: &[u8]) -> Result<Self, FileMeshError> {
        let soup = io::read_mesh(bytes)?;
        let checked = closed_genus_zero(&soup)?;
        Ok(Self::new(bytes, soup.polygons, checked))
    }

    /// A mesh that was read of a file, checked and perhaps repaired; `polygons` are the file's.
    pub fn new(bytes: &[u8], polygons: Vec<Vec<u32>>, checked: CheckedMesh) -> Self {
        Self {
            image: TargetImage::AsGiven,
            polygons,
            numbers: checked.file_from_vertex(),
            bytes: bytes.len(),
            hash: Hash::of(bytes),
            checked_hash: Hash::of_checked(&checked),
            checked,
        }
    }

    /// The mesh alone.
    pub fn into_checked(self) -> CheckedMesh {
        self.checked
    }

    /// Whether the mesh is not that of its file any more, but repaired: a map file does not tell of such a mesh.
    pub fn is_repaired(&self) -> bool {
        self.checked.repaired_faces.is_some()
    }

    /// The same file with the mirror image of its mesh.
    ///
    /// # Errors
    /// As [`mirrored`].
    pub fn into_mirrored(mut self) -> Result<Self, MeshError> {
        self.checked.mesh = mirrored(&self.checked.mesh)?;
        self.image = TargetImage::Mirrored;
        Ok(self)
    }

    /// The checked mesh, mirrored where that was asked for.
    pub fn checked(&self) -> &CheckedMesh {
        &self.checked
    }

    /// The mesh that is mapped.
    pub fn mesh(&self) -> &SurfaceMesh {
        &self.checked.mesh
    }

    /// Whether the mesh is that of the file or its mirror image.
    pub fn image(&self) -> TargetImage {
        self.image
    }

    /// Whether the mesh is the mirror image of the file's.
    pub fn is_mirrored(&self) -> bool {
        self.image == TargetImage::Mirrored
    }

    /// Polygons as the file has them, by the file's vertex numbers (of joined vertices the first).
    pub fn polygons(&self) -> &[Vec<u32>] {
        &self.polygons
    }

    /// The length of the file in bytes.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// The hash of the file's bytes.
    pub fn hash(&self) -> Hash {
        self.hash
    }

    /// Whether these are the bytes of the file.
    pub fn is_of(&self, bytes: &[u8]) -> bool {
        self.hash == Hash::of(bytes)
    }

    /// The hash of the checked mesh, not mirrored: see `docs/map-file.md`.
    pub fn checked_hash(&self) -> Hash {
        self.checked_hash
    }

    /// The number of vertices of the file.
    pub fn file_vertices(&self) -> usize {
        self.checked.vertex_from_file.len()
    }

    /// The number in the file of a vertex of the mesh, the first one where several became one.
    pub fn vertex_number(&self, v: VertexId) -> usize {
        self.numbers[v.index()]
    }

    /// A position on the mesh, or a direction, as one of the checked mesh: not mirrored.
    pub fn as_given(&self, p: DVec3) -> DVec3 {
        match self.image {
            TargetImage::AsGiven => p,
            TargetImage::Mirrored => DVec3::new(-p.x, p.y, p.z),
        }
    }

    /// A position on the mesh as one of the file: not mirrored, with the file's origin and units.
    pub fn in_file(&self, p: DVec3) -> DVec3 {
        self.frame().in_file(self.as_given(p))
    }

    /// From the coordinates of the checked mesh, not mirrored, to those of the file.
    pub fn frame(&self) -> FileFrame {
        self.checked.frame
    }

    /// A point of the mesh as a point of the file: not mirrored, and with the face's corners in the file's order.
    pub fn on_file(&self, point: SurfacePoint) -> SurfacePoint {
        self.checked.on_file(match self.image {
            TargetImage::AsGiven => point,
            TargetImage::Mirrored => mirrored_point(point),
        })
    }

    /// A point of the file as a point of the mesh.
    pub fn on_mesh(&self, point: SurfacePoint) -> SurfacePoint {
        let face = self.checked.face_from_file(point.face).unwrap_or(point.face);
        let point = self.checked.with_file_corners(SurfacePoint { face, ..point });
        match self.image {
            TargetImage::AsGiven => point,
            TargetImage::Mirrored => mirrored_point(point),
        }
    }

    /// Whether weights 1 and 2 of a face are exchanged between the mesh and the file.
    pub fn is_exchanged(&self, face: FaceId) -> bool {
        let turned = self.checked.turned.get(face).copied().unwrap_or(false);
        turned != self.is_mirrored()
    }
}

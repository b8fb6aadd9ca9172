//! A mesh of the page: read and checked in a worker, packed as bytes, and shown from these.

use super::failure;
use crate::io::landmark_file::LandmarkPoint;
use crate::io::landmark_formats::Space;
#[cfg(feature = "web-page")]
use crate::landmark_exchange::Surface;
use crate::map_file::Hash;
use crate::mesh::check::CheckedMesh;
use crate::mesh::look::Look;
use crate::mesh::packing::{PackedError, Packer, Unpacker};
use crate::mesh::{FaceId, SurfacePoint};
use crate::scene::Shading;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// The kind of look that a mesh has from its file.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug)]
pub enum LookKind {
    /// Nothing.
    None = "none",
    /// Places in a picture that is not there.
    Places = "places",
    /// Colours, or places in pictures that are there.
    Colours = "colours",
}

/// A mesh that was read and checked.
#[wasm_bindgen]
pub struct LoadedMesh {
    pub(super) checked: Rc<CheckedMesh>,
    pub(super) shading: Rc<Shading>,
    /// The coordinate system that its file names.
    pub(super) space: Space,
    /// The colours and the pictures that its file gives it.
    pub(super) look: Option<Rc<Look>>,
}

impl LoadedMesh {
    /// A checked mesh, ready to be shown.
    pub(super) fn new(checked: CheckedMesh, space: Space, look: Option<Look>) -> Self {
        let shading = Rc::new(Shading::of(&checked.mesh));
        Self { shading, checked: Rc::new(checked), space, look: look.map(Rc::new) }
    }

    /// The mesh as landmark files are brought onto it.
    #[cfg(feature = "web-page")]
    pub(super) fn surface(&self) -> Surface<'_> {
        Surface { mesh: &self.checked, space: self.space }
    }

    fn unpacked(bytes: &[u8]) -> Result<Self, PackedError> {
        let mut unpacker = Unpacker::new(bytes);
        let space = if unpacker.count()? == 0 { Space::Lps } else { Space::Ras };
        let checked = CheckedMesh::unpack(&mut unpacker)?;
        let shading = Shading::unpack(&mut unpacker, checked.mesh.vertex_count())?;
        let look = match unpacker.count()? {
            0 => None,
            _ => Some(Rc::new(Look::unpack(&mut unpacker, checked.mesh.face_count())?)),
        };
        unpacker.end()?;
        Ok(Self { checked: Rc::new(checked), shading: Rc::new(shading), space, look })
    }
}

#[wasm_bindgen]
impl LoadedMesh {
    /// Number of vertices.
    #[wasm_bindgen(getter, js_name = vertexCount)]
    pub fn vertex_count(&self) -> usize {
        self.checked.mesh.vertex_count()
    }

    /// Number of triangles.
    #[wasm_bindgen(getter, js_name = faceCount)]
    pub fn face_count(&self) -> usize {
        self.checked.mesh.face_count()
    }

    /// The hash of the mesh as a map file has it, in hexadecimal digits.
    #[wasm_bindgen(js_name = checkedHash)]
    pub fn checked_hash(&self) -> String {
        Hash::of_checked(&self.checked).to_string()
    }

    /// Faces whose orientation was turned.
    #[wasm_bindgen(getter, js_name = turnedFaces)]
    pub fn turned_faces(&self) -> usize {
        self.checked.turned_faces()
    }

    /// The kind of look that the mesh has from its file.
    #[wasm_bindgen(js_name = lookKind)]
    pub fn look_kind(&self) -> LookKind {
        match self.look.as_deref() {
            None => LookKind::None,
            Some(look) if look.is_coloured() => LookKind::Colours,
            Some(_) => LookKind::Places,
        }
    }

    /// The number of pictures that are laid on the mesh.
    #[wasm_bindgen(getter, js_name = pictureCount)]
    pub fn picture_count(&self) -> usize {
        self.look.as_ref().map_or(0, |look| look.pictures.len())
    }

    /// The file of one of these pictures (PNG, JPEG or WebP); `undefined` where there are not so many.
    pub fn picture(&self, number: usize) -> Option<Vec<u8>> {
        self.look.as_ref()?.pictures.get(number).cloned()
    }

    /// All of it as bytes, of which `unpackMesh` of the same build makes it again.
    pub fn packed(&self) -> Vec<u8> {
        let mut packer = Packer::default();
        packer.count(usize::from(self.space == Space::Ras));
        self.checked.pack(&mut packer);
        self.shading.pack(&mut packer);
        packer.count(usize::from(self.look.is_some()));
        if let Some(look) = &self.look {
            look.pack(&mut packer);
        }
        packer.into_bytes()
    }
}

/// The point of a mesh that a landmark point names; `None` where there is none.
pub(super) fn surface_point(checked: &CheckedMesh, point: LandmarkPoint) -> Option<SurfacePoint> {
    match point {
        LandmarkPoint::Vertex(v) => {
            let known = checked.numbered_vertex(v as usize);
            known.ok().map(|v| SurfacePoint::at_vertex(&checked.mesh, v))
        }
        LandmarkPoint::OnFace { face, barycentric } => {
            let face = checked.face_from_file(FaceId(face))?;
            Some(checked.with_file_corners(SurfacePoint { face, barycentric }))
        }
    }
}

/// The mesh that another instance of this build has packed.
///
/// # Errors
/// `{"code": "packed", "message"}` where the bytes are no such mesh.
#[wasm_bindgen(js_name = unpackMesh)]
pub fn unpack_mesh(bytes: &[u8]) -> Result<LoadedMesh, JsValue> {
    LoadedMesh::unpacked(bytes).map_err(|e| failure("packed", e))
}

//! Which faces of two meshes were made up to close holes.

use super::FaceId;
use typed_index_collections::TiSlice;

/// The faces of each mesh that were made up to close holes, as marks by face; `None` for a mesh without any. The rest is skin.
#[derive(Clone, Copy, Debug, Default)]
pub struct CapFaces<'a> {
    /// The marks of the source's faces.
    pub source: Option<&'a TiSlice<FaceId, bool>>,
    /// The marks of the target's faces.
    pub target: Option<&'a TiSlice<FaceId, bool>>,
}

impl CapFaces<'_> {
    /// These marks with source and target exchanged.
    #[must_use]
    pub fn exchanged(self) -> Self {
        Self { source: self.target, target: self.source }
    }

    /// Whether either mesh has such a face.
    pub fn any(self) -> bool {
        [self.source, self.target].into_iter().flatten().any(|is_cap| is_cap.raw.contains(&true))
    }

    /// Whether a face of the source and one of the target are skin.
    ///
    /// # Panics
    /// When a face does not exist.
    pub fn are_skin(self, [source, target]: [FaceId; 2]) -> [bool; 2] {
        let is_skin =
            |is_cap: Option<&TiSlice<FaceId, bool>>, face| !is_cap.is_some_and(|is_cap| is_cap[face]);
        [is_skin(self.source, source), is_skin(self.target, target)]
    }
}

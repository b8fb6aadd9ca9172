//! Which faces of two meshes were made up to close holes.

use super::FaceId;
use typed_index_collections::TiSlice;

/// Faces that were made up to close holes, by face of each mesh; `None` for a mesh without any. The rest is skin.
#[derive(Clone, Copy, Debug, Default)]
pub struct CapFaces<'a> {
    /// Of the source.
    pub source: Option<&'a TiSlice<FaceId, bool>>,
    /// Of the target.
    pub target: Option<&'a TiSlice<FaceId, bool>>,
}

impl CapFaces<'_> {
    /// The same with source and target exchanged.
    #[must_use]
    pub fn exchanged(self) -> Self {
        Self { source: self.target, target: self.source }
    }

    /// Whether there is any on either mesh.
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

//! Remarks on the parts of the look of a mesh file that cannot be used.

use super::picture::{self, MAX_PIXELS, PictureError};
use crate::mesh::look::MOST_PICTURES;

/// A remark on a part of a look that cannot be used. The mesh is good without it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LookRemark {
    /// A picture is not there.
    #[error("the picture {name} is missing: give it together with the mesh")]
    Missing {
        /// The picture's name in the file.
        name: String,
    },
    /// A file that should be a picture is none.
    #[error("the picture {name} is no PNG, JPEG or WebP file, and is left out")]
    NoPicture {
        /// The file's name in the mesh file.
        name: String,
    },
    /// A picture is too large.
    #[error(
        "the picture {name} has {width} x {height} pixels, the limit is {MAX_PIXELS}, and is left out: make it smaller"
    )]
    TooLarge {
        /// The picture's name in the file.
        name: String,
        /// Pixels in a row.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// There are more pictures than can be distinguished.
    #[error("only {MOST_PICTURES} pictures are shown; what others lie on has none")]
    TooMany,
    /// Some numbers cannot be used.
    #[error("its colours are incomplete: {problem}")]
    Unusable {
        /// The problem.
        problem: String,
    },
}

impl LookRemark {
    /// The remark on a picture whose head tells more pixels than a picture may have; `None` for any other.
    pub(super) fn too_large(picture: &[u8], name: impl FnOnce() -> String) -> Option<Self> {
        match picture::check(picture) {
            Err(PictureError::TooLarge { width, height }) => {
                Some(Self::TooLarge { name: name(), width, height })
            }
            _ => None,
        }
    }
}

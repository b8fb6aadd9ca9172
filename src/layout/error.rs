//! Why no layout was found.

use super::drawing_fault::DrawingFault;
use super::patches::PatchFault;
use crate::landmarks::{LEAST_LANDMARKS, Landmarks};
use crate::monitor::{Cancelled, OrStop};

/// Why no layout was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// No path joins two landmarks without crossing others.
    #[error(
        "no map was found: no line can be drawn between the landmarks {} and {} (the first is 1) beside the others; check whether \
         pairs are exchanged, move one of the two or leave it out",
        landmarks[0] + 1,
        landmarks[1] + 1
    )]
    NoPath {
        /// The landmarks, 0-based.
        landmarks: [usize; 2],
    },
    /// Every pair of landmarks was tried, and not all faces of the drawing are triangles.
    #[error(
        "no map was found: only {paths} of {wanted} lines can be drawn between the landmarks; check whether pairs are exchanged, \
         or leave some out"
    )]
    Stuck {
        /// Paths drawn.
        paths: usize,
        /// Paths of a triangulation.
        wanted: usize,
    },
    /// The paths wind around each other: they, or the meshes refined along them, have become too long.
    #[error(
        "no map was found: the lines between the landmarks wind around each other{}. Are the landmarks of both meshes in the same \
         order? Check whether pairs are exchanged",
        most_around(near)
    )]
    Tangled {
        /// Landmarks whose paths wind most, 0-based, the worst first.
        near: Vec<usize>,
    },
    /// Fewer landmarks than a base domain has vertices.
    #[error("{landmarks} landmarks are too few: pick at least {LEAST_LANDMARKS}")]
    TooFew {
        /// Number of landmarks.
        landmarks: usize,
    },
    /// More landmarks than distances can be kept of.
    #[error("{landmarks} landmarks are too many: on these meshes at most {most} can be used, leave some out")]
    TooMany {
        /// Number of landmarks.
        landmarks: usize,
        /// The largest number that these meshes allow.
        most: usize,
    },
    /// No layout has a map.
    #[error("no map was found for any of {layouts} layouts{}", around(near))]
    NoMap {
        /// Layouts judged.
        layouts: usize,
        /// Landmarks around which most of them failed, 0-based, the worst first; empty where that is not known.
        near: Vec<usize>,
    },
    /// The paths do not bound discs.
    #[error("the patches are not valid: {0}")]
    Patches(#[from] PatchFault),
}

impl LayoutError {
    /// Nothing where there are enough landmarks for a base domain, else [`LayoutError::TooFew`].
    pub(super) fn unless_enough(landmarks: &Landmarks) -> Result<(), Self> {
        let landmarks = landmarks.len();
        if landmarks < LEAST_LANDMARKS { Err(Self::TooFew { landmarks }) } else { Ok(()) }
    }
}

impl OrStop for LayoutError {
    fn is_stop(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

impl From<DrawingFault> for LayoutError {
    fn from(fault: DrawingFault) -> Self {
        match fault {
            DrawingFault::Cancelled(stop) => Self::Cancelled(stop),
            DrawingFault::NoPath { landmarks } => Self::NoPath { landmarks },
            DrawingFault::Tangled { near } => Self::Tangled { near },
        }
    }
}

/// The part of the sentence that says where layouts failed; landmarks are counted from 1.
fn around(near: &[usize]) -> String {
    match near {
        [] => "; check whether pairs are exchanged, or leave some out".to_owned(),
        [one] => {
            format!("; they fail around landmark {} (the first is 1): move it, or leave it out", one + 1)
        }
        more => {
            format!(
                "; they fail around the landmarks {} (the first is 1): check whether these are exchanged, or so near to \
                 each other that no triangles are between them, and move one or leave it out",
                names(more)
            )
        }
    }
}

/// The part of the sentence that says where paths wind most.
fn most_around(near: &[usize]) -> String {
    match near {
        [] => String::new(),
        [one] => format!(", most at landmark {} (the first is 1)", one + 1),
        more => format!(", most at the landmarks {} (the first is 1)", names(more)),
    }
}

/// Landmarks counted from 1.
fn names(landmarks: &[usize]) -> String {
    landmarks.iter().map(|k| (k + 1).to_string()).collect::<Vec<_>>().join(", ")
}

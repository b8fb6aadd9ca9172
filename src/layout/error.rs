//! Why no layout was found.

use super::patches::PatchFault;
use crate::monitor::Cancelled;

/// Why no layout was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// No path inside the sectors.
    #[error("no path was found between landmarks {} and {}", landmarks[0], landmarks[1])]
    NoPath {
        /// The landmarks, 0-based.
        landmarks: [usize; 2],
    },
    /// Every pair was tried.
    #[error("the layout stopped at {paths} of {wanted} paths")]
    Stuck {
        /// Paths drawn.
        paths: usize,
        /// Paths of a triangulation.
        wanted: usize,
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

/// Where layouts failed, in words; landmarks are counted from 1.
fn around(near: &[usize]) -> String {
    match near {
        [] => String::new(),
        [one] => {
            format!("; they fail around landmark {} (the first is 1): move it, or leave it out", one + 1)
        }
        more => {
            let names: Vec<String> = more.iter().map(|k| (k + 1).to_string()).collect();
            format!(
                "; they fail around the landmarks {} (the first is 1): check whether these are exchanged, or so near to \
                 each other that no triangles are between them, and move one or leave it out",
                names.join(", ")
            )
        }
    }
}

//! Why a path could not be added to a drawing.

use crate::monitor::Cancelled;

/// Why a path could not be added to a drawing.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum DrawingFault {
    /// The user asked to stop.
    Cancelled(Cancelled),
    /// No path joins the two landmarks.
    NoPath { landmarks: [usize; 2] },
    /// The paths wind around each other, most at these landmarks, the worst first.
    Tangled { near: Vec<usize> },
}

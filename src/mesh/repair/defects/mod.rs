//! Finds every place where a mesh fails to be one closed, oriented surface of genus 0, to show it.
//!
//! The steps of the repair that change no shape go first, or each edge of a file that shares no vertices would be a fault: vertices at one
//! place on open edges are joined, faces without area and double faces are listed and dropped. The remaining defects are listed by kind:
//! open edges and crowded ones as lines, patches that look the other way, parts beside the largest, vertices where parts only touch.
//! Handles are those that the repair would cut.
//!
//! Limits: at most [`MOST_DEFECTS`] defects of one kind with [`MOST_POINTS`] points are given one by one; all are counted. Handles
//! are looked for where the repair gets as far, with all other parts left out.

mod caps;
mod chains;
mod defect;
mod finding;
mod outlook;
mod packed;
#[cfg(test)]
mod tests;

pub use defect::{Defect, DefectGroup, DefectKind, Defects, MOST_DEFECTS, MOST_POINTS};
pub use finding::defects;
pub use outlook::Outlook;

//! A base mesh laid onto a scan: its own vertices and faces in the scan's place and shape.
//!
//! A base vertex whose image is on the scan's skin lies there. Where the scan has a hole, and so no skin for a part of the base, that
//! part follows as rigidly as it can from what is held around it (Sorkine & Alexa 2007, "As-rigid-as-possible surface modeling"),
//! in the size that the base has beside the hole; near the hole images are held softly, so that no crease is seen. Then faces are
//! fitted to the scan between their vertices by a few Gauss-Newton steps on the distances from the scan's tangent planes, both
//! ways; the correspondence stays. Corners of faces that look the wrong way then slide until they
//! look the right one.
//!
//! Limits: intersections of the result with itself are not looked for; relief of the scan that is finer than the base's faces is
//! smoothed over, and the distances tell by how much.

mod distances;
mod extension;
mod fitting;
mod images;
mod input;
mod loose_parts;
mod orientation;
mod rigid_energy;
mod samples;
mod untangling;
mod wrapped;

pub use distances::{DistanceFigures, WrapDistances};
pub use input::WrapInput;
pub use loose_parts::LooseParts;
pub use wrapped::{Laid, WrapError, WrapReport, Wrapped, wrapped};

#[cfg(test)]
mod tests;

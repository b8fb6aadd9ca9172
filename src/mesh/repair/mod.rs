//! Repair: from a polygon soup with faults to one closed, oriented, manifold surface of genus 0, or to a refusal.
//!
//! Steps in a fixed order, each a function from a draft of the surface to the next with a report of what it changed:
//! vertices at one place are joined along open edges, faces without area and double faces dropped, faces turned until neighbours
//! agree, the surface cut along edges with more than two faces and stitched again sheet by sheet (Gueziec et al. 2001), loose
//! specks dropped, holes capped, and, where that is asked for, handles cut. At the end [`crate::mesh::check::closed_genus_zero`]
//! judges as it judges every mesh. A mesh that passes from the start is not touched.
//!
//! Limits: intersections of the surface with itself, there before or made by a cap, are not looked for.

mod blades;
mod caps;
mod defects;
mod degenerate;
mod draft;
mod duplicates;
mod gaps;
mod handles;
mod joining;
mod options;
mod order;
mod orientation;
mod parts;
mod refusal;
mod report;
mod sheets;

pub use defects::{Defect, DefectGroup, DefectKind, Defects, MOST_DEFECTS, MOST_POINTS, Outlook, defects};
pub use gaps::{Gaps, gaps};
pub use options::{Handles, Parts, RepairOptions};
pub use order::{RepairedMesh, repaired};
pub use refusal::RepairRefusal;
pub use report::{Change, ChangeReport, Handle, Hole, RepairReport};

//! From a polygon soup to one closed, oriented, manifold surface of genus 0, or to a sentence that says why not.

mod checked_mesh;
mod edges;
mod fault;
mod judgement;
mod orientation;
mod triangulated;
mod vertices;

pub use checked_mesh::{CheckedMesh, NoVertex, RepairedFaces};
pub(super) use fault::Count;
pub use fault::{Elements, MAX_FACES, MeshFault};
pub use judgement::closed_genus_zero;
pub(crate) use judgement::closed_genus_zero_asking;
pub(super) use triangulated::is_degenerate;
pub(crate) use triangulated::{Triangle, triangulated};

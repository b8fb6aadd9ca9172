//! Coarsening of a patched mesh down to its base domain.
//!
//! Faces keep their patch: an interior vertex collapses into any neighbour, a path vertex only along its own path, a
//! landmark never (Hoppe 1996, restricted to the patches).

use crate::base_domain::BaseDomain;
use crate::layout::PatchedMesh;
use crate::mesh::coarsening::coarsen;
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{HalfedgeId, VertexId};
use crate::monitor::Monitor;
use crate::surface_map::error::MapError;
use typed_index_collections::{TiVec, ti_vec};

/// The kind of a vertex, which restricts its collapses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Hold {
    Landmark,
    Path,
    Interior,
}

fn holds(patched: &PatchedMesh, base: &BaseDomain) -> TiVec<VertexId, Hold> {
    let mut holds = ti_vec![Hold::Interior; patched.mesh.vertex_count()];
    for h in base.mesh.edges() {
        patched.paths[h].iter().for_each(|&v| holds[v] = Hold::Path);
    }
    patched.landmark_vertices.iter().for_each(|&v| holds[v] = Hold::Landmark);
    holds
}

/// Coarsens until only the landmarks are left: one live face per base face.
///
/// # Errors
/// [`MapError::NotCoarsened`], [`MapError::Cancelled`].
pub fn coarsen_to_base(
    patched: &PatchedMesh,
    base: &BaseDomain,
    monitor: &mut dyn Monitor,
) -> Result<CollapsibleMesh, MapError> {
    let holds = holds(patched, base);
    let patch = |h: HalfedgeId| patched.face_patch[h.face()];
    let may = |mesh: &CollapsibleMesh, h: HalfedgeId| match holds[mesh.tail(h)] {
        Hold::Landmark => false,
        Hold::Path => patch(h) != patch(mesh.twin(h)),
        Hold::Interior => true,
    };
    let goal = patched.landmark_vertices.len();
    let mut mesh = CollapsibleMesh::new(&patched.mesh);
    match coarsen(&mut mesh, patched.mesh.positions(), goal, may, monitor)? - goal {
        0 => Ok(mesh),
        left => Err(MapError::NotCoarsened { left }),
    }
}

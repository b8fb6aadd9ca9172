//! The removal of the points that a layout added to a coarse mesh from its parametrisation.
//!
//! A point on an edge is collapsed along its edge, a point inside a face into any neighbour. Where the collapse would turn a triangle
//! over, the flat relaxation draws the point and its neighbour on the edge together, closer each time, until the collapse is possible.

use super::mesh_with_coarse::MeshWithCoarse;
use crate::layout::PatchedMesh;
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse};
use crate::surface_map::MapError;
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::Embedding;
use crate::surface_map::parametrisation::level::{LandmarkedLevel, ParametrisedLevel, Snapshot};
use crate::surface_map::parametrisation::problem::FlatRelaxOptions;
use crate::surface_map::parametrisation::rest_triangle::RestTriangle;
use glam::DVec3;
use std::sync::Arc;
use typed_index_collections::{TiVec, ti_vec};

/// The place of a vertex that the layout added to the coarse mesh.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Added {
    /// On the edge between two vertices.
    OnEdge([VertexId; 2]),
    /// Inside a face.
    Inside,
}

/// A parametrisation of a patched mesh onto a cone surface.
#[derive(Clone, Copy)]
pub struct PatchedParametrisation<'a> {
    /// The cone surface.
    pub surface: &'a Arc<ConeSurface>,
    /// The parametrisation.
    pub embedding: &'a Embedding,
}

/// The coarse level's own parametrisation: that of the patched mesh without the points that the layout added.
///
/// # Errors
/// [`MapError::LayoutPoints`] where some points cannot be removed, [`MapError::Cancelled`].
pub fn without_layout_points<'a>(
    mesh: &'a MeshWithCoarse<'a>,
    patched: &PatchedMesh,
    parametrisation: PatchedParametrisation<'_>,
    options: &FlatRelaxOptions,
    monitor: &mut dyn Monitor,
) -> Result<ParametrisedLevel<'a>, MapError> {
    let PatchedParametrisation { surface, embedding } = parametrisation;
    let coarse = &mesh.coarse.mesh;
    let first = coarse.vertex_count();
    let added: Vec<Added> =
        (first..patched.mesh.vertex_count()).map(|v| origin(patched, coarse, v.into())).collect();
    let refined = LandmarkedLevel {
        mesh: CollapsibleMesh::new(&patched.mesh),
        positions: patched.mesh.positions(),
        landmarks: &patched.landmark_vertices,
        heirs: &patched.landmark_vertices,
    };
    let mut refined = ParametrisedLevel::on_level(refined, surface.clone(), embedding, |h| h);
    let mut left: Vec<VertexId> = (first..patched.mesh.vertex_count()).map(VertexId::from).collect();
    let kind = |v: VertexId| added.get(v.index().wrapping_sub(first)).copied();
    take_out(&mut refined, &mut left, kind, monitor)?;
    // Each about a third of the one before: in one step the rest triangles would be slivers, too stiff for the relaxation.
    // Chosen by hand, not measured at half and double.
    for closeness in [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3] {
        if left.is_empty() {
            break;
        }
        let rest = pulled_together(&refined, &left, closeness, kind);
        refined.relax_to(&rest, options, monitor)?;
        take_out(&mut refined, &mut left, kind, monitor)?;
    }
    if !left.is_empty() {
        let near = nearest_landmarks(patched, &left);
        return Err(MapError::LayoutPoints { left: left.len(), near });
    }
    let Snapshot { level, embedding } = refined.snapshot();
    let same = |h: HalfedgeId| {
        let (tail, head) = (level.mesh.tail(h), level.mesh.head(h));
        let own = coarse.halfedge_between(tail, head).unwrap_or(h);
        HalfedgeId::of(mesh.coarse.faces[own.face()], own.corner())
    };
    let full = LandmarkedLevel {
        mesh: mesh.mesh.clone(),
        positions: mesh.full.positions(),
        landmarks: mesh.landmarks,
        heirs: mesh.heirs,
    };
    Ok(ParametrisedLevel::on_level(full, surface.clone(), &embedding, same))
}

/// The landmarks nearest in space to some vertices, each once.
fn nearest_landmarks(patched: &PatchedMesh, vertices: &[VertexId]) -> Vec<usize> {
    let place = |v: VertexId| patched.mesh.positions()[v];
    let nearest = |&v: &VertexId| {
        let distance = |l: &VertexId| place(*l).distance_squared(place(v));
        let landmarks = patched.landmark_vertices.iter().enumerate();
        landmarks.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map(|(landmark, _)| landmark)
    };
    let mut near: Vec<usize> = vertices.iter().filter_map(nearest).collect();
    near.sort_unstable();
    near.dedup();
    near
}

fn origin(patched: &PatchedMesh, coarse: &SurfaceMesh, v: VertexId) -> Added {
    let at = patched.vertex_origin[v];
    let corners = coarse.triangles()[at.face];
    // On an edge the weight of the opposite corner is 0 up to rounding; inside a face the weights are multiples of a
    // power of 1/2.
    match (0..3).find(|&k| at.barycentric[k] < 1e-12) {
        Some(k) => {
            let [a, b] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
            Added::OnEdge([a.min(b), a.max(b)])
        }
        None => Added::Inside,
    }
}

/// Whether an added point may be collapsed into a neighbour: along its edge, or into any from inside a face.
fn is_along(v: VertexId, w: VertexId, added: impl Fn(VertexId) -> Option<Added>) -> bool {
    match added(v) {
        Some(Added::OnEdge(ends)) => ends.contains(&w) || added(w) == Some(Added::OnEdge(ends)),
        _ => true,
    }
}

/// Rest shapes in which each point that is left lies near a neighbour on its edge, at `closeness` times its distance. The triangles
/// around it have at least the mean weight, so that they do draw the two together.
fn pulled_together(
    level: &ParametrisedLevel<'_>,
    left: &[VertexId],
    closeness: f64,
    added: impl Fn(VertexId) -> Option<Added>,
) -> Vec<RestTriangle> {
    let (mesh, positions) = (level.mesh(), level.positions());
    let mut rest: TiVec<VertexId, DVec3> = positions.to_owned();
    let mut is_left = ti_vec![false; positions.len()];
    for &v in left {
        is_left[v] = true;
        let length = |h: &HalfedgeId| positions[v].distance(positions[mesh.head(*h)]);
        let ways = mesh.star(v).filter(|&h| is_along(v, mesh.head(h), &added));
        let way = ways.min_by(|a, b| {
            let own = |h: &HalfedgeId| added(mesh.head(*h)).is_some();
            own(a).cmp(&own(b)).then(length(a).total_cmp(&length(b)))
        });
        if let Some(h) = way {
            let end = positions[mesh.head(h)];
            rest[v] = end + (positions[v] - end) * closeness;
        }
    }
    let mean = 1.0 / mesh.faces().count() as f64;
    let triangle = |f| {
        let corners = mesh.corners(f);
        let triangle = RestTriangle::of(corners.map(|v| rest[v]));
        if corners.iter().any(|&v| is_left[v]) {
            RestTriangle { weight: triangle.weight.max(mean), ..triangle }
        } else {
            triangle
        }
    };
    mesh.faces().map(triangle).collect()
}

/// Points that are looked at between two questions to the monitor: some milliseconds, also beside vertices of a thousand neighbours.
const ASKED_EVERY: usize = 64;

/// Removes the points that can be removed: a point on an edge along its edge, a point inside a face into any neighbour.
fn take_out(
    level: &mut ParametrisedLevel<'_>,
    left: &mut Vec<VertexId>,
    added: impl Fn(VertexId) -> Option<Added>,
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    let mut before = usize::MAX;
    let mut stopped = Ok(());
    while left.len() < before && stopped.is_ok() {
        before = left.len();
        left.retain(|&v| {
            if stopped.is_ok() {
                stopped = pulse.beat();
            }
            let along = |w: VertexId| is_along(v, w, &added);
            let ways: Vec<HalfedgeId> =
                level.mesh().star(v).filter(|&h| along(level.mesh().head(h))).collect();
            !ways.into_iter().any(|h| level.mesh().link_condition(h) && level.remove(h))
        });
    }
    stopped
}

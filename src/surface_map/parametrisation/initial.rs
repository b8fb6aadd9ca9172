//! The first parametrisation of a patched mesh onto the cone surface, coarse to fine.
//!
//! The mesh is coarsened down to the base domain, whose triangles are mapped onto the charts. Then the vertices return one by
//! one, each into the kernel of its star, and the level is relaxed whenever the number of vertices has grown
//! fourfold. Every star is checked: positive triangles and one turn of 2 pi (positive areas alone admit double covers).

use super::coarsen_to_base::coarsen_to_base;
use super::cone_surface::ConeSurface;
use super::embedding::{Anchor, Embedding, Parametrised};
use super::level::{LandmarkedLevel, ParametrisedLevel, Placing};
use super::problem::{FlatRelaxOptions, FlatRelaxReport};
use super::unknowns::Unknowns;
use crate::landmarks::LandmarkId;
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{HalfedgeId, VertexId};
use crate::monitor::{Monitor, Step};
use crate::surface_map::error::MapError;
use std::sync::Arc;
use typed_index_collections::{TiVec, ti_vec};

/// Vertices that return between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 4096;

/// Options of the first parametrisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialOptions {
    /// A level is relaxed when its vertices have grown by this factor.
    pub growth: f64,
    /// Options of the relaxation of a level.
    pub level: FlatRelaxOptions,
    /// Where vertices that return are put.
    pub placing: Placing,
}

impl Default for InitialOptions {
    fn default() -> Self {
        // Chosen by hand, not measured at half and double.
        Self { growth: 4.0, level: FlatRelaxOptions::default(), placing: Placing::LowEnergy }
    }
}

/// Numbers of levels and vertices of a first parametrisation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialReport {
    /// Levels that were relaxed.
    pub levels: usize,
    /// Vertices whose star had no kernel until its level was relaxed once more.
    pub rescued_vertices: usize,
}

/// Finds a parametrisation of a patched mesh in which every triangle is positive.
///
/// # Errors
/// [`MapError::NoStart`] where a vertex finds no place.
pub fn embed(
    patched: &PatchedMesh,
    surface: &Arc<ConeSurface>,
    options: &InitialOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Embedding, InitialReport), MapError> {
    let mesh = coarsen_to_base(patched, &surface.base, monitor)?;
    let mut level = on_charts(mesh, patched, surface);
    let report = refine(&mut level, patched.mesh.vertex_count(), options, monitor)?;
    Ok((level.snapshot().embedding, report))
}

/// The base domain's own parametrisation: every live face is its chart.
fn on_charts<'a>(
    mesh: CollapsibleMesh,
    patched: &'a PatchedMesh,
    surface: &Arc<ConeSurface>,
) -> ParametrisedLevel<'a> {
    let mut landmark: TiVec<VertexId, LandmarkId> =
        ti_vec![LandmarkId(u32::MAX); patched.mesh.vertex_count()];
    patched.landmark_vertices.iter_enumerated().for_each(|(l, &v)| landmark[v] = l);
    let base = &surface.base;
    let base_halfedge = |mesh: &CollapsibleMesh, h: HalfedgeId| {
        let chart = patched.face_patch[h.face()];
        let [first, second, third] = chart.halfedges();
        [second, third].into_iter().find(|&b| base.tail(b) == landmark[mesh.tail(h)]).unwrap_or(first)
    };
    let nowhere = Anchor {
        corner: HalfedgeId(0),
        chart: base.mesh.outgoing(0.into()).face(),
        motion: Rigid2::IDENTITY,
    };
    let mut anchors = ti_vec![nowhere; base.mesh.vertex_count()];
    let halfedges: Vec<HalfedgeId> = mesh.faces().flat_map(|f| f.halfedges()).collect();
    for &h in &halfedges {
        let chart = patched.face_patch[h.face()];
        anchors[landmark[mesh.tail(h)]] = Anchor { corner: h, chart, motion: Rigid2::IDENTITY };
    }
    let places: Vec<HalfedgeId> = halfedges.iter().map(|&h| base_halfedge(&mesh, h)).collect();
    let level = LandmarkedLevel {
        mesh,
        positions: patched.mesh.positions(),
        landmarks: &patched.landmark_vertices,
        heirs: &patched.landmark_vertices,
    };
    let mut level = ParametrisedLevel::new(level, surface.clone(), anchors);
    for (&h, b) in halfedges.iter().zip(places) {
        level.set(h, surface.charts[b.face()][b.corner()], surface.transitions[b]);
    }
    level
}

/// Restores vertices until the level has `goal` of them; it is relaxed whenever it has grown by `options.growth`.
///
/// # Errors
/// [`MapError::NoStart`] where a vertex finds no place.
pub fn refine(
    level: &mut ParametrisedLevel<'_>,
    goal: usize,
    options: &InitialOptions,
    monitor: &mut dyn Monitor,
) -> Result<InitialReport, MapError> {
    let mut report = InitialReport::default();
    let mut relaxed_at = level.mesh().live_vertices();
    while level.mesh().live_vertices() < goal {
        match level.refine(options.placing) {
            None => break,
            Some(Ok(_)) => {}
            Some(Err(_)) => {
                level.relax(&options.level, monitor)?;
                report.rescued_vertices += 1;
                if level.refine(options.placing).is_none_or(|again| again.is_err()) {
                    return Err(MapError::NoStart { vertices: level.mesh().live_vertices() });
                }
            }
        }
        let live = level.mesh().live_vertices();
        if live.is_multiple_of(ASKED_EVERY) {
            monitor.step(Step { fraction: live as f64 / goal as f64, residual: None })?;
        }
        if live as f64 >= options.growth * relaxed_at as f64 && live < goal {
            monitor.step(Step { fraction: live as f64 / goal as f64, residual: None })?;
            level.relax(&options.level, monitor)?;
            relaxed_at = live;
            report.levels += 1;
        }
    }
    Ok(report)
}

/// Relaxes a valid parametrisation.
///
/// # Errors
/// [`MapError::Cancelled`].
pub fn relax(
    side: Parametrised<'_>,
    surface: &ConeSurface,
    options: &FlatRelaxOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Embedding, FlatRelaxReport), MapError> {
    let unknowns = Unknowns::new(side);
    let mut z = unknowns.points(side.embedding);
    let report = unknowns.problem(monitor)?.relax(&mut z, options, monitor)?;
    let mut relaxed = side.embedding.clone();
    unknowns.place(&z, &mut relaxed.corners);
    relaxed.normalise_anchors(surface);
    Ok((relaxed, report))
}

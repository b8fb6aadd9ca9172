//! The order of the steps.

use super::distances::WrapDistances;
use super::extension::extended;
use super::fitting::fit;
use super::images::Images;
use super::input::WrapInput;
use super::orientation::Orientation;
use super::rigid_energy::edge_weights;
use super::untangling::untangle;
use crate::mesh::{FaceId, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Stage, Step};
use crate::surface_map::correspondence::PointLocator;
use glam::DVec3;
use serde::Serialize;
use typed_index_collections::TiVec;

/// The way in which a vertex of the base was placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Laid {
    /// The vertex's image is on the scan's skin.
    OnScan,
    /// The scan has no skin there: the vertex follows those around it.
    Extended,
}

/// A base laid onto a scan.
#[derive(Clone, Debug)]
pub struct Wrapped {
    /// The place of each vertex of the base, in the scan's coordinates.
    pub positions: TiVec<VertexId, DVec3>,
    /// The way in which each vertex was placed; `Extended` for vertices that only caps have.
    pub laid: TiVec<VertexId, Laid>,
    /// The faces of the base's skin that look the wrong way; empty where all is well.
    pub flipped: Vec<FaceId>,
    /// The numbers.
    pub report: WrapReport,
}

/// The numbers of a laid base.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrapReport {
    /// Number of vertices of the base's skin whose image is on the scan's skin.
    pub on_scan: usize,
    /// Number of vertices of the base's skin that were laid on beyond it.
    pub extended: usize,
    /// The share of the base's skin whose image is the scan's skin.
    pub covered: f64,
    /// Number of triangles of the base's skin that look the wrong way.
    pub flipped_triangles: usize,
    /// Distances between the laid base and the scan, where both are skin.
    pub distance: WrapDistances,
}

/// Why a base cannot be laid onto a scan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WrapError {
    /// The map takes none of the base's vertices to the scan's skin.
    #[error("no vertex of the base has an image on the surface of the scan: check the landmarks")]
    NothingOnScan,
    /// The user asked to stop.
    #[error("{0}")]
    Stopped(Cancelled),
}

impl From<Cancelled> for WrapError {
    fn from(stop: Cancelled) -> Self {
        Self::Stopped(stop)
    }
}

/// The weight of a cap's faces in the shape of what follows: they only hold together what they join. As in the relaxation.
const CAP_WEIGHT: f64 = 0.01;

/// Lays a base onto a scan.
///
/// # Errors
/// [`WrapError`].
pub fn wrapped(input: &WrapInput<'_>, monitor: &mut dyn Monitor) -> Result<Wrapped, WrapError> {
    monitor.enter(Stage::Wrapping);
    let base = input.base;
    let images = Images::new(input);
    let on_scan = images.is_covered.iter().filter(|covered| **covered).count();
    if on_scan == 0 {
        return Err(WrapError::NothingOnScan);
    }
    let is_skin = |f: FaceId| input.is_base_skin(f);
    let weights = edge_weights(base, |f| if is_skin(f) { 1.0 } else { CAP_WEIGHT });
    let locator = PointLocator::new([base, input.scan], input.map);
    let orientation = Orientation::new(input);
    let mut positions = extended(base, &weights, &images, &mut Portion::new(monitor, 0.0, 0.3))?;
    fit(input, &weights, &locator, &mut positions, &mut Portion::new(monitor, 0.3, 0.7))?;
    untangle(base, &orientation, is_skin, &mut positions, &mut Portion::new(monitor, 0.7, 0.9))?;
    monitor.step(Step { fraction: 0.9, residual: None })?;
    let flipped = orientation.flipped(base, &positions, is_skin);
    let laid = base.with_positions(positions.clone());
    let report = WrapReport {
        on_scan,
        extended: images.is_skin.iter().filter(|skin| **skin).count() - on_scan,
        covered: orientation.covered,
        flipped_triangles: flipped.len(),
        distance: WrapDistances::new(input, &laid, &locator),
    };
    let mark = |covered: &bool| if *covered { Laid::OnScan } else { Laid::Extended };
    Ok(Wrapped { positions, laid: images.is_covered.iter().map(mark).collect(), flipped, report })
}

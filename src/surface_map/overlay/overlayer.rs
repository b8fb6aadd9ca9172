//! The intersection of source and target: their common subdivision from the located source vertices.
//!
//! Where source and target coincide, at a vertex or along an edge, the combinatorics of rounded tests need not fit
//! together. The check finds that, and the overlay is made again with the source's free vertices moved by 1e-10 of their
//! shortest edge.

use super::arrangement::Arrangement;
use super::cells::{Cells, View};
use super::corner_locations::CornerLocations;
use super::location::Locations;
use super::pieces::{Overlay, OverlayError};
use super::trace::{Traced, Traces};
use crate::monitor::{Monitor, Step};
use crate::surface_map::parametrisation::embedding::Parametrised;

/// Attempts at an overlay, all but the first with the source shifted, 30 times as far in each. Chosen by hand.
const ATTEMPTS: usize = 6;

/// Makes overlays; keeps its working memory from one call to the next.
#[derive(Clone, Debug, Default)]
pub struct Overlayer {
    located: CornerLocations,
    traces: Traces,
    arrangement: Arrangement,
    cells: Cells,
}

impl Overlayer {
    /// Intersects source and target; `locations` are those of [`super::location::locate`] for the same sides.
    ///
    /// Fills `overlay`, whose memory is used again. Time grows linearly with faces and crossings.
    ///
    /// # Errors
    /// [`OverlayError`], with `overlay` left in an unfinished state.
    pub fn fill(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        locations: &Locations,
        overlay: &mut Overlay,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        let mut result = Ok(());
        for attempt in 0..ATTEMPTS {
            overlay.shifts = attempt;
            result = self.attempt([source, target], locations, overlay, monitor);
            if matches!(result, Ok(()) | Err(OverlayError::Cancelled(_))) {
                break;
            }
        }
        result
    }

    /// Intersects source and target with the source shifted `overlay.shifts` times.
    fn attempt(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        locations: &Locations,
        overlay: &mut Overlay,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        let Self { located, traces, arrangement, cells } = self;
        located.fill(source, target, locations, overlay.shifts)?;
        monitor.step(Step::default())?;
        traces.fill([source, target], located, monitor)?;
        let traced = Traced { source, target, located, traces };
        arrangement.fill(traced, monitor)?;
        arrangement.describe(traced);
        monitor.step(Step::default())?;
        cells.fill(View { source, target, located, traces, arrangement }, overlay, monitor)
    }
}

/// Intersects source and target; see [`Overlayer::fill`].
///
/// # Errors
/// [`OverlayError`].
pub fn overlay(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    locations: &Locations,
    monitor: &mut dyn Monitor,
) -> Result<Overlay, OverlayError> {
    let mut overlay = Overlay::default();
    Overlayer::default().fill([source, target], locations, &mut overlay, monitor)?;
    Ok(overlay)
}

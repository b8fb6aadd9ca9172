//! The receiver of progress, which may ask the run to stop.

use super::preview::MapPreview;
use super::stage::Stage;
use std::fmt;

/// One report of an algorithm's progress.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Step {
    /// Estimated share of the stage that is done, 0 to 1.
    pub fraction: f64,
    /// The quantity that the stage brings down (curvature error in radians, energy, ...), where there is one.
    pub residual: Option<f64>,
}

/// The user asked to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

impl fmt::Display for Cancelled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("stopped on request")
    }
}

impl std::error::Error for Cancelled {}

/// Receives progress and may ask to stop, without a result ([`Monitor::step`]) or with one ([`Monitor::wants_result`]).
///
/// Algorithms call [`Monitor::step`] between iterations, inside long loops once in so many passes ([`Pulse`](super::Pulse)), and return the error
/// at once.
///
/// What a monitor does not hear or answer itself goes to the one that it wraps, if any.
pub trait Monitor {
    /// The monitor that this one wraps, to be asked.
    fn wrapped(&self) -> Option<&dyn Monitor> {
        None
    }
    /// The monitor that this one wraps, to be told. A monitor has both or none.
    fn wrapped_mut(&mut self) -> Option<&mut dyn Monitor> {
        None
    }
    /// A stage begins.
    fn enter(&mut self, stage: Stage) {
        if let Some(monitor) = self.wrapped_mut() {
            monitor.enter(stage);
        }
    }
    /// A map is relaxed from now on: another one, or the same one on a finer level or by another kind of energy. The energies reported next
    /// cannot be compared with those before.
    fn relaxation_begins(&mut self) {
        if let Some(monitor) = self.wrapped_mut() {
            monitor.relaxation_begins();
        }
    }
    /// The present energy of the map that is being relaxed, of the kind that is lowered: 4 for an isometry. It falls until the
    /// next relaxation begins, but for a little that a step may give to the barrier (2e-4 of 4.6 was seen).
    fn map_energy(&mut self, energy: f64) {
        if let Some(monitor) = self.wrapped_mut() {
            monitor.map_energy(energy);
        }
    }
    /// A coarse map is the best so far, or was refined. It costs nothing unless it is asked for images.
    fn preview(&mut self, preview: &dyn MapPreview) {
        if let Some(monitor) = self.wrapped_mut() {
            monitor.preview(preview);
        }
    }
    /// Whether to finish now: no more is tried than a whole, valid result needs. Asked between rounds, levels and
    /// candidates; once true it must stay true.
    fn wants_result(&self) -> bool {
        self.wrapped().is_some_and(|monitor| monitor.wants_result())
    }
    /// Whether there is time for what is made beside a map that is whole already, such as its textures: where there is none, it is left
    /// out, and the result says so.
    fn has_time(&self) -> bool {
        self.wrapped().is_none_or(|monitor| monitor.has_time())
    }
    /// The current stage went on; an error asks it to stop.
    ///
    /// # Errors
    /// [`Cancelled`] when the user asked to stop.
    fn step(&mut self, step: Step) -> Result<(), Cancelled>;
}

/// A monitor that never stops anything.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Monitor for Silent {
    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        Ok(())
    }
}

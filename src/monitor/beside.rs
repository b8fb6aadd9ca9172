//! A monitor for what is made beside a map that is whole already.

use super::{Cancelled, MapPreview, Monitor, Stage, Step};

/// Passes everything on, and stops a part beside the map where there is no time for it ([`Monitor::has_time`]).
pub struct Beside<'a> {
    monitor: &'a mut dyn Monitor,
    is_left_out: bool,
}

impl<'a> Beside<'a> {
    /// Wraps the monitor of the run.
    pub fn new(monitor: &'a mut dyn Monitor) -> Self {
        Self { monitor, is_left_out: false }
    }

    /// Whether the part that was stopped is to be left out; it is the run that is to stop otherwise.
    ///
    /// # Errors
    /// The stop that the user asked for.
    pub fn left_out(&self, stop: Cancelled) -> Result<(), Cancelled> {
        if self.is_left_out { Ok(()) } else { Err(stop) }
    }
}

impl Monitor for Beside<'_> {
    fn enter(&mut self, stage: Stage) {
        self.monitor.enter(stage);
    }

    fn relaxation_begins(&mut self) {
        self.monitor.relaxation_begins();
    }

    fn map_energy(&mut self, energy: f64) {
        self.monitor.map_energy(energy);
    }

    fn preview(&mut self, preview: &dyn MapPreview) {
        self.monitor.preview(preview);
    }

    fn wants_result(&self) -> bool {
        self.monitor.wants_result()
    }

    fn has_time(&self) -> bool {
        self.monitor.has_time()
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.monitor.step(step)?;
        self.is_left_out = !self.monitor.has_time();
        if self.is_left_out { Err(Cancelled) } else { Ok(()) }
    }
}

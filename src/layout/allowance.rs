//! What the searches of a drawing may still take, and whom they ask.

use crate::monitor::{Cancelled, Monitor, Portion, Step};

/// Steps that the searches of a drawing may still take, and the monitor that they ask.
pub(super) struct Allowance<'m> {
    monitor: &'m mut dyn Monitor,
    steps: usize,
    cancelled: Option<Cancelled>,
}

/// Steps of a search between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 1 << 13;

impl<'m> Allowance<'m> {
    /// Nothing is allowed yet.
    pub fn new(monitor: &'m mut dyn Monitor) -> Self {
        Self { monitor, steps: 0, cancelled: None }
    }

    /// Allows the searches of one more drawing.
    pub fn renew(&mut self, steps: usize) {
        self.steps = steps;
    }

    /// One more step of a search; `false` where it must end.
    #[inline]
    pub fn step(&mut self) -> bool {
        if self.steps.is_multiple_of(ASKED_EVERY) && !self.ask() {
            return false;
        }
        self.steps = self.steps.saturating_sub(1);
        self.steps > 0
    }

    fn ask(&mut self) -> bool {
        if let Err(stop) = Portion::new(self.monitor, 0.0, 0.0).step(Step::default()) {
            self.cancelled = Some(stop);
        }
        self.cancelled.is_none()
    }

    /// Tells the monitor how far the drawing is.
    ///
    /// # Errors
    /// [`Cancelled`], also where a search was stopped since.
    pub fn tell(&mut self, fraction: f64) -> Result<(), Cancelled> {
        match self.cancelled {
            Some(stop) => Err(stop),
            None => self.monitor.step(Step { fraction, residual: None }),
        }
    }

    /// Whether to finish with what is there.
    pub fn wants_result(&self) -> bool {
        self.monitor.wants_result()
    }

    /// Whether a search was stopped.
    pub fn cancelled(&self) -> Option<Cancelled> {
        self.cancelled
    }

    /// Whether another search may find something.
    pub fn is_left(&self) -> bool {
        self.steps > 0 && self.cancelled.is_none()
    }
}

//! The budget of the path searches of a drawing, counted in steps.

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
    /// An allowance of no steps; [`Self::renew`] gives some.
    pub fn new(monitor: &'m mut dyn Monitor) -> Self {
        Self { monitor, steps: 0, cancelled: None }
    }

    /// Allows the searches of one more drawing.
    pub fn renew(&mut self, steps: usize) {
        self.steps = steps;
    }

    /// Takes one step of a search; `false` where the search must end, since no step is left or the monitor has asked to stop.
    #[inline]
    pub fn step(&mut self) -> bool {
        if !self.is_left() || (self.steps.is_multiple_of(ASKED_EVERY) && !self.ask()) {
            return false;
        }
        self.steps -= 1;
        self.steps > 0
    }

    /// Steps that are left.
    pub fn left(&self) -> usize {
        self.steps
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

    /// Whether the monitor wants a result now.
    pub fn wants_result(&self) -> bool {
        self.monitor.wants_result()
    }

    /// The monitor's wish to stop, where a search has met it.
    pub fn cancelled(&self) -> Option<Cancelled> {
        self.cancelled
    }

    /// Whether another search may take a step.
    pub fn is_left(&self) -> bool {
        self.steps > 0 && self.cancelled.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts how often it is asked, and stops from some time on.
    struct Asked {
        count: usize,
        most: usize,
    }

    impl Monitor for Asked {
        fn step(&mut self, _: Step) -> Result<(), Cancelled> {
            self.count += 1;
            if self.count > self.most { Err(Cancelled) } else { Ok(()) }
        }
    }

    #[test]
    fn a_used_up_allowance_asks_nobody() {
        let mut monitor = Asked { count: 0, most: usize::MAX };
        let mut allowance = Allowance::new(&mut monitor);
        assert!(!allowance.step());
        allowance.renew(3);
        assert_eq!([(); 5].map(|()| allowance.step()), [true, true, false, false, false]);
        assert!(!allowance.is_left() && allowance.cancelled().is_none());
        assert_eq!(monitor.count, 0);
    }

    #[test]
    fn nothing_is_allowed_after_a_stop() {
        let mut monitor = Asked { count: 0, most: 1 };
        let mut allowance = Allowance::new(&mut monitor);
        allowance.renew(3 * ASKED_EVERY);
        let steps = (0..).take_while(|_| allowance.step()).count();
        assert_eq!(steps, ASKED_EVERY);
        allowance.renew(3 * ASKED_EVERY + 1);
        assert!(!allowance.step() && !allowance.is_left() && allowance.cancelled().is_some());
        assert_eq!(monitor.count, 2);
    }
}

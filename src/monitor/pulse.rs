//! A loop whose passes are too short to ask each time.

use super::{Cancelled, Monitor, Step};

/// Asks a monitor once in so many passes of a loop, so that a long one is never silent for more than some milliseconds.
pub struct Pulse<'a> {
    monitor: &'a mut dyn Monitor,
    every: usize,
    passes: usize,
}

impl<'a> Pulse<'a> {
    /// Asks after each `every` passes, at least 1, without reporting progress.
    pub fn new(monitor: &'a mut dyn Monitor, every: usize) -> Self {
        Self { monitor, every, passes: 0 }
    }

    /// One pass is done.
    ///
    /// # Errors
    /// [`Cancelled`].
    #[inline]
    pub fn beat(&mut self) -> Result<(), Cancelled> {
        self.beat_by(1)
    }

    /// So many passes are done, or will be before the next beat.
    ///
    /// # Errors
    /// [`Cancelled`].
    #[inline]
    pub fn beat_by(&mut self, passes: usize) -> Result<(), Cancelled> {
        self.passes = self.passes.saturating_add(passes);
        if self.passes < self.every {
            return Ok(());
        }
        self.passes = 0;
        self.monitor.step(Step::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts questions, and stops at the third.
    struct Counter(usize);

    impl Monitor for Counter {
        fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
            self.0 += 1;
            if self.0 < 3 { Ok(()) } else { Err(Cancelled) }
        }
    }

    #[test]
    fn one_question_in_so_many_passes() {
        let mut counter = Counter(0);
        let mut pulse = Pulse::new(&mut counter, 10);
        let done = (0..100).take_while(|_| pulse.beat().is_ok()).count();
        assert_eq!((done, counter.0), (29, 3));
    }
}

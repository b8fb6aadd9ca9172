//! What is made beside a map that is whole already.

use super::{Cancelled, Monitor, Step};

/// What `make` makes; `None` where there is no more time for it at one of its steps ([`Monitor::has_time`]).
///
/// # Errors
/// The stop that the user asked for.
pub fn if_time<T>(
    monitor: &mut dyn Monitor,
    make: impl FnOnce(&mut dyn Monitor) -> Result<T, Cancelled>,
) -> Result<Option<T>, Cancelled> {
    let mut beside = Beside { monitor, is_left_out: false };
    match make(&mut beside) {
        Ok(made) => Ok(Some(made)),
        Err(stop) => {
            if beside.is_left_out {
                Ok(None)
            } else {
                Err(stop)
            }
        }
    }
}

/// Passes everything on, and stops where there is no time.
struct Beside<'a> {
    monitor: &'a mut dyn Monitor,
    is_left_out: bool,
}

impl Monitor for Beside<'_> {
    fn wrapped(&self) -> Option<&dyn Monitor> {
        Some(self.monitor)
    }

    fn wrapped_mut(&mut self) -> Option<&mut dyn Monitor> {
        Some(self.monitor)
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.monitor.step(step)?;
        self.is_left_out = !self.monitor.has_time();
        if self.is_left_out { Err(Cancelled) } else { Ok(()) }
    }
}

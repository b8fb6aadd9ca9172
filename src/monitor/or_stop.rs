//! Errors one of which is the wish to stop.

use super::receiver::Cancelled;

/// An error one of whose kinds is the wish to stop.
pub trait OrStop: Sized {
    /// Whether it is that one.
    fn is_stop(&self) -> bool;

    /// The error, unless it is the wish to stop.
    ///
    /// # Errors
    /// The stop that was asked for.
    fn or_stop(self) -> Result<Self, Cancelled> {
        if self.is_stop() { Err(Cancelled) } else { Ok(self) }
    }
}

/// The value, `None` for every error but the wish to stop: there is none, but there may be another.
///
/// # Errors
/// The stop that was asked for.
pub fn unless_stopped<T, E: OrStop>(outcome: Result<T, E>) -> Result<Option<T>, Cancelled> {
    match outcome {
        Ok(value) => Ok(Some(value)),
        Err(error) => error.or_stop().map(|_| None),
    }
}

//! A run by the method that the options name.

use super::error::PipelineError;
use super::input::MapInput;
use super::options::{Method, PipelineOptions};
use super::result::MapResult;
use super::{relaxed, thesis, tutte};
use crate::monitor::{Monitor, Rising};

/// Maps the source onto the target.
///
/// A monitor that wants a result gets a valid, certified map of the full meshes from the best map so far, less relaxed (one
/// round on every level that is left), and the report says so; the thesis' method is not shortened.
///
/// # Errors
/// [`PipelineError`] names the stage that failed and carries its error. A result that is not certified is never
/// returned as a map: [`Method::Relaxed`] ends in an error instead.
pub fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    let monitor = &mut Rising::new(monitor);
    match options.method {
        Method::Relaxed => relaxed::run(input, options, monitor),
        Method::Thesis => thesis::run(input, options, monitor),
        Method::Tutte => tutte::run(input, options, monitor),
    }
}

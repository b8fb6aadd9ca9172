//! Both meshes on their way to their landmarks.

use super::{MapInput, PipelineError};
use crate::base_domain::{SimplificationStage, simplification_stages};
use crate::monitor::{Monitor, Portion, Stage};

/// Stages of each mesh from the whole down to its landmarks, the source's first: the base domains that the thesis begins with. A map over
/// the joint base domain, which is the default, goes over another one.
///
/// # Errors
/// [`PipelineError::BaseDomain`], or cancellation.
pub fn simplifications(
    input: MapInput<'_>,
    monitor: &mut dyn Monitor,
) -> Result<[Vec<SimplificationStage>; 2], PipelineError> {
    monitor.enter(Stage::BaseDomain);
    let MapInput { source, target, landmarks, .. } = input;
    Ok([
        simplification_stages(source, &landmarks.source, &mut Portion::new(monitor, 0.0, 0.5))?,
        simplification_stages(target, &landmarks.target, &mut Portion::new(monitor, 0.5, 1.0))?,
    ])
}

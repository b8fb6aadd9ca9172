//! Both meshes on their way to their landmarks.

use super::{MapInput, PipelineError};
use crate::base_domain::{SimplificationStage, joint_simplification_stages, simplification_stages};
use crate::mesh::{SurfaceMesh, VertexId};
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

/// What decides which vertex goes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lead {
    /// The shape of the mesh alone, as the thesis simplifies one of both.
    Own,
    /// Its shape and the one that a map gives it, at the same size.
    Both,
}

/// Stages of a mesh whose vertices a map has brought to places on another one: what is on either, with the same triangles.
///
/// # Errors
/// [`PipelineError::BaseDomain`], or cancellation.
pub fn carried_simplification(
    [mesh, carried]: [&SurfaceMesh; 2],
    landmarks: &[VertexId],
    lead: Lead,
    monitor: &mut dyn Monitor,
) -> Result<Vec<SimplificationStage>, PipelineError> {
    monitor.enter(Stage::BaseDomain);
    let stages = match lead {
        Lead::Own => simplification_stages(mesh, landmarks, monitor)?,
        Lead::Both => {
            let of_area_one = |mesh: &SurfaceMesh| {
                let scale = 1.0 / mesh.area().sqrt();
                mesh.with_positions(mesh.positions().iter().map(|&p| p * scale).collect())
            };
            let shapes = [of_area_one(mesh), of_area_one(carried)];
            joint_simplification_stages([&shapes[0], &shapes[1]], landmarks, monitor)?
        }
    };
    Ok(stages)
}

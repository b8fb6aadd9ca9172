//! The simplification of both meshes down to their landmarks, in stages for display.

use super::{MapInput, PipelineError};
use crate::base_domain::{SimplificationStage, joint_simplification_stages, simplification_stages};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Monitor, Portion, Stage};

/// Stages of each mesh from the whole down to its landmarks, the source's first: the base domains of the thesis. A map over
/// the joint base domain, which is the default, has another one.
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
        simplification_stages(source, &landmarks.source.raw, &mut Portion::new(monitor, 0.0, 0.5))?,
        simplification_stages(target, &landmarks.target.raw, &mut Portion::new(monitor, 0.5, 1.0))?,
    ])
}

/// The shapes whose quadric error decides the next collapse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lead {
    /// The shape of the mesh alone, as the thesis simplifies one of both.
    Own,
    /// The shape of the mesh and its image under a map, both scaled to area 1.
    Both,
}

/// Stages of a mesh `mesh` that can also be drawn on `carried`, which has the same triangles and the images of its vertices under a map.
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

//! A mesh on its way to its landmarks, with the other one, where the map has its vertices.

use super::checked_job::Job;
use super::taken::TakenMap;
use crate::landmarks::MeshSide;
use crate::mesh::VertexId;
use crate::monitor::Monitor;
use crate::pipeline::{self, Lead, PipelineError, SimplificationStage};
use glam::DVec3;
use typed_index_collections::TiVec;

/// A mesh on its way to its landmarks, drawn on both meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedSimplification {
    /// The stages, from the whole mesh down to its landmarks.
    pub stages: Vec<SimplificationStage>,
    /// The positions of its vertices on the source and on the target.
    pub positions: [Vec<DVec3>; 2],
}

impl Job {
    /// One of the mapped meshes on its way to its landmarks, and on the other one, where the map has its vertices.
    /// Coordinates are those of the checked meshes.
    ///
    /// # Errors
    /// As [`pipeline::carried_simplification`].
    pub fn carried_simplification(
        &self,
        own: MeshSide,
        map: &TakenMap<'_>,
        lead: Lead,
        monitor: &mut dyn Monitor,
    ) -> Result<CarriedSimplification, PipelineError> {
        let other = own.other();
        let mesh = self.mapped_meshes()[own];
        let landmarks = self.landmark_vertices();
        let mut positions = self.positions();
        let places = map.vertex_places(own);
        let mut carried: TiVec<VertexId, DVec3> = positions[own].iter().copied().collect();
        for (place, found) in carried.iter_mut().zip(&places) {
            *place = found.unwrap_or(*place);
        }
        // Landmarks inside faces are no vertices of the checked mesh; all of them are exact.
        for (&v, &image) in landmarks[own].iter().zip(landmarks[other]) {
            carried[v] = positions[other][image.index()];
        }
        let shape = mesh.with_positions(carried.clone());
        let stages = pipeline::carried_simplification([mesh, &shape], landmarks[own], lead, monitor)?;
        positions[other] = carried.raw;
        Ok(CarriedSimplification { stages, positions })
    }
}

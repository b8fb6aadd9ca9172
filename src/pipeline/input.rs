//! What the pipeline starts from.

use crate::landmarks::Landmarks;
pub use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::measures::ground_truth::{GroundTruthError, distance_to_truth};
use glam::DVec3;
use typed_index_collections::TiSlice;

/// What the pipeline starts from: two checked meshes and landmarks that are vertices of both.
#[derive(Clone, Copy, Debug)]
pub struct MapInput<'a> {
    /// Closed, oriented, one component, genus 0.
    pub source: &'a SurfaceMesh,
    /// Closed, oriented, one component, genus 0.
    pub target: &'a SurfaceMesh,
    /// At least four corresponding vertices.
    pub landmarks: &'a Landmarks,
    /// What is known of the true map.
    pub ground_truth: GroundTruth<'a>,
    /// Which faces of both were made up.
    pub caps: CapFaces<'a>,
}

impl<'a> MapInput<'a> {
    /// Meshes of which no face was made up, and nothing is known of the true map.
    pub fn new(source: &'a SurfaceMesh, target: &'a SurfaceMesh, landmarks: &'a Landmarks) -> Self {
        Self { source, target, landmarks, ground_truth: GroundTruth::Unknown, caps: CapFaces::default() }
    }

    /// How far images of the source's vertices are from the true ones; `None` where these are not known.
    pub(super) fn distance_to_truth(
        &self,
        images: impl Iterator<Item = (VertexId, SurfacePoint)>,
    ) -> Option<GroundTruthError> {
        let places = self.target.positions();
        match self.ground_truth {
            GroundTruth::Unknown => None,
            GroundTruth::SameConnectivity => {
                Some(distance_to_truth(self.target, images, |v| Some(places[v])))
            }
            GroundTruth::Images(truth) => {
                Some(distance_to_truth(self.target, images, |v| truth.get(v).copied().flatten()))
            }
        }
    }
}

/// What is known of the true map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GroundTruth<'a> {
    /// Nothing.
    #[default]
    Unknown,
    /// Both meshes share their connectivity: vertex i corresponds to vertex i.
    SameConnectivity,
    /// The true images of the source's first vertices in space; `None` where they are not known.
    Images(&'a TiSlice<VertexId, Option<DVec3>>),
}

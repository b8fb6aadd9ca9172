//! What the pipeline starts from.

use crate::landmarks::Landmarks;
use crate::mesh::SurfaceMesh;
pub use crate::mesh::cap_faces::CapFaces;

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
    pub ground_truth: GroundTruth,
    /// Which faces of both were made up.
    pub caps: CapFaces<'a>,
}

impl<'a> MapInput<'a> {
    /// Meshes of which no face was made up, and nothing is known of the true map.
    pub fn new(source: &'a SurfaceMesh, target: &'a SurfaceMesh, landmarks: &'a Landmarks) -> Self {
        Self { source, target, landmarks, ground_truth: GroundTruth::Unknown, caps: CapFaces::default() }
    }
}

/// What is known of the true map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GroundTruth {
    /// Nothing.
    #[default]
    Unknown,
    /// Both meshes share their connectivity: vertex i corresponds to vertex i.
    SameConnectivity,
}

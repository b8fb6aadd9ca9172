//! The input of the pipeline.

use crate::landmarks::Landmarks;
pub use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::measures::ground_truth::{GroundTruthError, distance_to_truth};
use glam::DVec3;
use typed_index_collections::TiSlice;

/// The input of the pipeline: two checked meshes and landmarks that are vertices of both.
#[derive(Clone, Copy, Debug)]
pub struct MapInput<'a> {
    /// The source: closed, oriented, one component, genus 0.
    pub source: &'a SurfaceMesh,
    /// The target: closed, oriented, one component, genus 0.
    pub target: &'a SurfaceMesh,
    /// At least four pairs of corresponding vertices.
    pub landmarks: &'a Landmarks,
    /// The true map, as far as it is known.
    pub ground_truth: GroundTruth<'a>,
    /// The faces of both meshes that are caps over holes.
    pub caps: CapFaces<'a>,
}

impl<'a> MapInput<'a> {
    /// Meshes without caps and without a known true map.
    pub fn new(source: &'a SurfaceMesh, target: &'a SurfaceMesh, landmarks: &'a Landmarks) -> Self {
        Self { source, target, landmarks, ground_truth: GroundTruth::Unknown, caps: CapFaces::default() }
    }

    /// Distances between images of the source's vertices and the true ones; `None` where these are not known.
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

/// The true map, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GroundTruth<'a> {
    /// It is not known.
    #[default]
    Unknown,
    /// Both meshes share their connectivity: vertex i corresponds to vertex i.
    SameConnectivity,
    /// The true images of the source's first vertices in space; `None` where they are not known.
    Images(&'a TiSlice<VertexId, Option<DVec3>>),
}

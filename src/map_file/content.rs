//! The contents of a map file.

use super::header::Summary;
use crate::base_domain::BaseDomain;
use crate::io::landmark_file::LandmarkFile;
use crate::surface_map::correspondence::{Correspondence, TextureDrawing};
use crate::surface_map::flat_layout::FlatLayout;

/// The contents of a map file, in the numbers of the meshes that are mapped ([`super::FileMesh::mesh`]).
#[derive(Clone, Debug)]
pub struct MapFile {
    /// The map.
    pub correspondence: Correspondence,
    /// The target's texture coordinates; `None` where its flow failed.
    pub texture: Option<TextureDrawing>,
    /// Both meshes on the flat base domain.
    pub layout: Option<FlatLayout>,
    /// The base domain at the target as given: vertex k is landmark k.
    pub base: BaseDomain,
    /// The curvature of each landmark's cone, in radians.
    pub cones: Vec<f64>,
    /// The landmarks, in the files' numbers.
    pub landmarks: LandmarkFile,
    /// The choices of the run, as JSON.
    pub options: serde_json::Value,
    /// The measures of the map.
    pub summary: Summary,
    /// The run's report as JSON.
    pub report: serde_json::Value,
}

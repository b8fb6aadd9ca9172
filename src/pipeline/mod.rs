//! Options, the order of the stages, the report: the only place that knows the whole way.

mod error;
mod options;
mod report;
mod result;

pub use error::PipelineError;
pub use options::{Base, Cones, Method, PipelineOptions};
pub use report::{
    BaseDomainReport, CertificateReport, ConeMetricReport, ConeMetricsReport, DistortionReport, FacesReport,
    GroundTruthReport, Report,
};
pub use result::{MapResult, Side};

use crate::landmarks::Landmarks;
use crate::mesh::SurfaceMesh;
use crate::monitor::Monitor;

/// What the pipeline starts from: two checked meshes and landmarks that are vertices of both.
#[derive(Clone, Copy, Debug)]
pub struct MapInput<'a> {
    /// Closed, oriented, one component, genus 0.
    pub source: &'a SurfaceMesh,
    /// Closed, oriented, one component, genus 0.
    pub target: &'a SurfaceMesh,
    /// At least four corresponding vertices.
    pub landmarks: &'a Landmarks,
    /// Whether vertex i of the source truly corresponds to vertex i of the target, so that errors can be measured.
    pub ground_truth: GroundTruth,
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

/// Maps the source onto the target.
///
/// # Errors
/// [`PipelineError`] names the stage that failed and carries its error. A result that is not certified is never
/// returned as a map: [`Method::Relaxed`] ends in an error instead.
pub fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    let _ = (input, options, monitor);
    Err(PipelineError::Cancelled(crate::monitor::Cancelled))
}

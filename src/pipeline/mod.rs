//! Options, the order of the stages, the report: the only place that knows the whole way.

mod error;
mod findings;
mod flows;
mod options;
mod outcome;
mod relaxed;
mod report;
mod result;
mod stages;
mod thesis;
mod warning;

pub use error::PipelineError;
pub use findings::{FindingKind, FindingReport, RepairKind, findings};
pub use options::{Base, Choices, ClassChoice, Cones, Method, OwnConeOptions, PipelineOptions};
pub use report::{
    BaseDomainReport, CertificateReport, ConeMetricReport, ConeMetricsReport, DistortionReport, FacesReport,
    GroundTruthReport, LayoutSearchReport, PlaceReport, Report, WorstPieceReport,
};
pub use result::{MapResult, TriangleDistortion};
pub use warning::{Warning, WarningReport};

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
    /// What is known of the true map.
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
/// A monitor that wants a result gets a valid, certified map of the full meshes from what there is, only less relaxed (one
/// round on every level that is left), and the report says so; the thesis' method has nothing to shorten.
///
/// # Errors
/// [`PipelineError`] names the stage that failed and carries its error. A result that is not certified is never
/// returned as a map: [`Method::Relaxed`] ends in an error instead.
pub fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    match options.method {
        Method::Relaxed => relaxed::run(input, options, monitor),
        Method::Thesis => thesis::run(input, options, monitor),
    }
}

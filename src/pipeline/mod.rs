//! Options, the order of the stages, the report: the only place that knows the whole way.

mod error;
mod findings;
mod options;
mod relaxed;
mod report;
mod result;
mod thesis;

pub use error::PipelineError;
pub use findings::{FindingKind, FindingReport, RepairKind, findings};
pub use options::{Base, ClassChoice, Cones, Method, OwnConeOptions, PipelineOptions};
pub use report::{
    BaseDomainReport, CertificateReport, ConeMetricReport, ConeMetricsReport, DistortionReport, FacesReport,
    GroundTruthReport, LayoutSearchReport, PlaceReport, Report, WorstPieceReport,
};
pub use result::{MapResult, TriangleDistortion};

use crate::base_domain::{self, BaseDomain};
use crate::cone_metric::atlas::{FlatAtlas, flat_atlas};
use crate::cone_metric::{ConeMetric, FlowError, FlowReport, base_domain_curvature, flow, uniform_curvature};
use crate::landmarks::Landmarks;
use crate::layout::{self, BaseLayout};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Monitor, Stage};
use typed_index_collections::TiVec;

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

/// Draws the base domain on both meshes at full resolution.
fn draw(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<BaseLayout, PipelineError> {
    let meshes = [input.source, input.target];
    Ok(match options.base {
        Base::Joint => layout::joint(meshes, input.landmarks, &options.layout, monitor)?,
        Base::Qem => {
            let base = base_domain::simplify(input.target, &input.landmarks.target, monitor)?;
            layout::from_base(meshes, input.landmarks, &base, monitor)?
        }
    })
}

/// The flat cone metrics of both meshes and the target's texture coordinates.
struct Metrics {
    source: (ConeMetric, FlowReport),
    target: (ConeMetric, FlowReport),
    /// Target curvature of each landmark.
    cones: Vec<f64>,
    target_atlas: FlatAtlas,
}

impl Metrics {
    fn new(
        input: MapInput<'_>,
        base: &BaseDomain,
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, PipelineError> {
        let Landmarks { source, target } = input.landmarks;
        monitor.enter(Stage::SourceConeMetric);
        let source_metric = cone_metric((input.source, source), base, options, monitor)
            .map_err(PipelineError::source_flow)?;
        monitor.enter(Stage::TargetConeMetric);
        let target_metric = cone_metric((input.target, target), base, options, monitor)
            .map_err(PipelineError::target_flow)?;
        let target_atlas = flat_atlas(input.target, &target_metric.0, target);
        let goal = curvature((input.target, target), base, options.cones);
        let cones = target.iter().map(|&v| goal[v]).collect();
        Ok(Self { source: source_metric, target: target_metric, cones, target_atlas })
    }
}

/// Target curvature of each vertex.
fn curvature(
    (mesh, landmarks): (&SurfaceMesh, &[VertexId]),
    base: &BaseDomain,
    cones: Cones,
) -> TiVec<VertexId, f64> {
    match cones {
        Cones::BaseDomain => base_domain_curvature(mesh.vertex_count(), landmarks, base),
        Cones::Uniform => uniform_curvature(mesh.vertex_count(), landmarks),
    }
}

/// The flat cone metric of a mesh with its landmarks.
fn cone_metric(
    side: (&SurfaceMesh, &[VertexId]),
    base: &BaseDomain,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<(ConeMetric, FlowReport), FlowError> {
    flow(side.0, &curvature(side, base, options.cones), &options.flow, monitor)
}

//! Options, the order of the stages, the report: the only place that knows the whole way.

mod borders;
mod error;
mod findings;
mod flows;
mod input;
mod options;
mod other_map;
mod outcome;
mod parametrise;
mod previews;
mod relaxed;
mod report;
mod result;
mod simplification;
mod stages;
mod thesis;
mod tutte;
mod warning;

pub use borders::{BorderCase, BordersReport, RimPairReport, RimReport};
pub use error::PipelineError;
pub use findings::{FindingKind, FindingReport, RepairKind, findings};
pub use flows::{flat_surfaces, recorded_flows};
pub use input::{CapFaces, GroundTruth, MapInput};
pub use options::{
    Base, Borders, Choices, ClassChoice, Cones, Method, OwnConeOptions, PipelineOptions, Relaxation,
};
pub use other_map::OtherMap;
pub use report::{
    BaseDomainReport, CertificateReport, ConeMetricReport, ConeMetricsReport, CoverageReport,
    DistortionReport, FacesReport, GroundTruthReport, LayoutSearchReport, PlaceReport, Report,
    WorstPieceReport,
};
pub use result::{MapResult, TriangleDistortion};
pub use simplification::{Lead, carried_simplification, simplifications};
pub use warning::{Warning, WarningReport};

pub use crate::base_domain::SimplificationStage;
pub use crate::cone_metric::{FlatSurface, FlowMoment, FlowOptions, FlowRecord, PlaneLayout, Scheme};

use crate::monitor::{Monitor, Rising};

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
    let monitor = &mut Rising::new(monitor);
    match options.method {
        Method::Relaxed => relaxed::run(input, options, monitor),
        Method::Thesis => thesis::run(input, options, monitor),
        Method::Tutte => tutte::run(input, options, monitor),
    }
}

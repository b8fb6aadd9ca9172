//! The pipeline from landmarks to a map: options, the order of the stages, the report. No other module knows the order of the stages.

mod attempt;
mod borders;
mod error;
mod findings;
mod flows;
mod found_ends;
mod input;
mod landmark_doubts;
mod options;
mod other_map;
mod outcome;
mod parametrise;
mod previews;
mod relaxed;
mod report;
mod result;
mod second_look;
mod simplification;
mod stages;
mod thesis;
mod tutte;
mod warning;
mod whole_run;

pub use borders::{BorderCase, BordersReport, RimPairReport, RimReport};
pub use error::PipelineError;
pub use findings::{FINDINGS_VERTICES, FindingKind, FindingReport, RepairKind, findings};
pub use flows::{flat_surfaces, recorded_flows};
pub use input::{CapFaces, GroundTruth, MapInput};
pub use landmark_doubts::landmark_doubts;
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
pub use whole_run::run;

//! The error of a run: the stage that failed, with its own error.

use crate::base_domain::SimplifyError;
use crate::coarse_map::CoarseMapError;
use crate::cone_metric::FlowError;
use crate::layout::LayoutError;
use crate::mesh::MeshError;
use crate::monitor::Cancelled;
use crate::surface_map::overlay::OverlayError;
use crate::surface_map::overlay::location::LocateError;
use crate::surface_map::{Certificate, MapError};

/// Why there is no map.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(Cancelled),
    /// There is no base domain.
    #[error("base domain: {0}")]
    BaseDomain(SimplifyError),
    /// The base domain could not be drawn on both meshes.
    #[error("layout: {0}")]
    Layout(LayoutError),
    /// The source's flow failed.
    #[error("cone metric of the source: {0}")]
    SourceFlow(FlowError),
    /// The target's flow failed.
    #[error("cone metric of the target: {0}")]
    TargetFlow(FlowError),
    /// The mesh around a landmark could not be refined.
    #[error("refinement around the landmarks: {0}")]
    Refinement(#[from] MeshError),
    /// There is no parametrisation.
    #[error("map: {0}")]
    Map(MapError),
    /// A source vertex could not be located on the target.
    #[error("composition: {0}")]
    Locate(LocateError),
    /// The common subdivision of source and target does not close.
    #[error("overlay: {0}")]
    Overlay(OverlayError),
    /// The result is not a bijection; it is not returned as a map.
    #[error(
        "the map is not certified: {0}. Make the triangles of both meshes more even, as `conemap remesh` does, or take landmarks \
         further from each other"
    )]
    NotCertified(Certificate),
}

macro_rules! from_stage {
    ($error:ident, $variant:ident) => {
        impl From<$error> for PipelineError {
            fn from(error: $error) -> Self {
                match error {
                    $error::Cancelled(stop) => Self::Cancelled(stop),
                    other => Self::$variant(other),
                }
            }
        }
    };
}

from_stage!(SimplifyError, BaseDomain);
from_stage!(LayoutError, Layout);
from_stage!(MapError, Map);
from_stage!(OverlayError, Overlay);
from_stage!(LocateError, Locate);

impl From<CoarseMapError> for PipelineError {
    fn from(error: CoarseMapError) -> Self {
        match error {
            CoarseMapError::Cancelled(stop) => Self::Cancelled(stop),
            CoarseMapError::Layout(error) => Self::Layout(error),
            CoarseMapError::Map(error) => Self::Map(error),
        }
    }
}

impl From<Cancelled> for PipelineError {
    fn from(stop: Cancelled) -> Self {
        Self::Cancelled(stop)
    }
}

impl PipelineError {
    /// The source's flow failed, or was stopped.
    pub(super) fn source_flow(error: FlowError) -> Self {
        match error {
            FlowError::Cancelled(stop) => Self::Cancelled(stop),
            other => Self::SourceFlow(other),
        }
    }

    /// The target's flow failed, or was stopped.
    pub(super) fn target_flow(error: FlowError) -> Self {
        match error {
            FlowError::Cancelled(stop) => Self::Cancelled(stop),
            other => Self::TargetFlow(other),
        }
    }

    /// A stable code for programs and for the page's sentences.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Cancelled(_) => "cancelled",
            Self::BaseDomain(_) => "base-domain",
            Self::Layout(_) => "layout",
            Self::SourceFlow(_) | Self::TargetFlow(_) => "cone-metric",
            Self::Refinement(_) | Self::Map(_) => "map",
            Self::Locate(_) | Self::Overlay(_) => "composition",
            Self::NotCertified(_) => "not-certified",
        }
    }
}

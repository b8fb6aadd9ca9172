//! What a user may choose.

use crate::cone_metric::FlowOptions;
use crate::layout::{LayoutOptions, SearchOptions};
use crate::surface_map::multilevel::MultilevelOptions;

/// How the map is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Two seamless parametrisations onto one flat cone surface, relaxed: bijective.
    #[default]
    Relaxed,
    /// The thesis' patchwise map over the two cone metrics, with its unmapped share.
    Thesis,
}

/// Where the base domain's triangles come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// Planned on both meshes at once.
    #[default]
    Joint,
    /// Quadric error simplification of the target.
    Qem,
}

/// Curvature at the landmarks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cones {
    /// The base domain's angle defects.
    #[default]
    BaseDomain,
    /// 4 pi divided by the number of landmarks.
    Uniform,
}

/// Everything the pipeline lets a user choose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PipelineOptions {
    /// How the map is made.
    pub method: Method,
    /// Where the base domain comes from.
    pub base: Base,
    /// Curvature at the landmarks.
    pub cones: Cones,
    /// Both flows.
    pub flow: FlowOptions,
    /// The search for the layout.
    pub layout: LayoutOptions,
    /// The search for the class of the map.
    pub search: SearchOptions,
    /// From coarse to fine.
    pub multilevel: MultilevelOptions,
}

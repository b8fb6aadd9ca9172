//! What a user may choose.

use crate::coarse_map::MultilevelOptions;
pub use crate::coarse_map::class_search::ClassChoice;
pub use crate::coarse_map::own_cones::OwnConeOptions;
use crate::cone_metric::FlowOptions;
use crate::layout::{LayoutOptions, SearchOptions};

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
    /// The layout of the thesis' method, drawn at full resolution.
    pub layout: LayoutOptions,
    /// The search for the class of the map.
    pub search: SearchOptions,
    /// Which class is taken.
    pub class: ClassChoice,
    /// From coarse to fine.
    pub multilevel: MultilevelOptions,
    /// Cones of the program's own where the landmarks are few.
    pub own_cones: OwnConeOptions,
}

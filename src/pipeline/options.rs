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

/// Which class of maps is taken where several are close.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClassChoice {
    /// The one of least mean log density.
    #[default]
    Best,
    /// The next best, where there is one that is close.
    RunnerUp,
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

/// Cones of the program's own, for [`Method::Relaxed`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnConeOptions {
    /// Points that are added; 0 turns them off.
    pub count: usize,
    /// With more landmarks than this none are added.
    pub most_landmarks: usize,
    /// A coarse map of less mean log density needs no help; 0 for an isometry.
    pub least_mean_log: f64,
    /// Sets of points, one after the other, at most.
    pub rounds: usize,
    /// Stops after this many sets without a gain.
    pub patience: usize,
    /// A gain lowers the mean log density by this share.
    pub least_gain: f64,
    /// The search for the layout with own points.
    pub search: SearchOptions,
}

impl Default for OwnConeOptions {
    fn default() -> Self {
        let search = SearchOptions { candidates: 2, twists: 2, ..SearchOptions::default() };
        Self {
            count: 20,
            most_landmarks: 16,
            least_mean_log: 0.0025,
            rounds: 6,
            patience: 2,
            least_gain: 0.02,
            search,
        }
    }
}

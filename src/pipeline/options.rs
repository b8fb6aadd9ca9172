//! The options of a run.

use crate::coarse_map::MultilevelOptions;
pub use crate::coarse_map::class_search::ClassChoice;
pub use crate::coarse_map::own_cones::OwnConeOptions;
use crate::cone_metric::FlowOptions;
use crate::layout::{LayoutOptions, SearchOptions};
use serde::{Deserialize, Serialize};

/// The method by which the map is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Two seamless parametrisations onto one flat cone surface, relaxed: bijective.
    #[default]
    Relaxed,
    /// The thesis' patchwise map over the two cone metrics, with its unmapped share.
    Thesis,
    /// Patch by patch: each onto its straight triangle by Tutte's embedding. Continuous, with kinks along the patch lines.
    Tutte,
}

/// The construction of the base domain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Base {
    /// Planned on both meshes at once.
    #[default]
    Joint,
    /// Quadric error simplification of the target.
    Qem,
}

/// Curvature at the landmarks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Cones {
    /// The base domain's angle defects.
    #[default]
    BaseDomain,
    /// 4 pi divided by the number of landmarks.
    Uniform,
}

/// The treatment of holes that both meshes have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Borders {
    /// Large rims correspond where the landmarks around them agree; else data is missing.
    #[default]
    Guess,
    /// Both surfaces end there, as two bodies cut at the neck: rim goes to rim.
    Corresponding,
    /// Data is missing: the surface under the caps is unknown.
    Missing,
}

/// The relaxation of the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Relaxation {
    /// The energy of the map is lowered as far as the options of the relaxation say.
    #[default]
    Full,
    /// The energy of the map is not lowered: each mesh is relaxed over the cone surface by itself. The map is certified all the same.
    None,
}

/// The options of a run that a user chooses, on the command line and in the page alike. An unknown name or value is an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::Args))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct Choices {
    /// How the map is made.
    #[cfg_attr(feature = "cli", arg(long, value_enum, default_value_t))]
    pub method: Method,
    /// Where the base domain comes from.
    #[cfg_attr(feature = "cli", arg(long, value_enum, default_value_t))]
    pub base: Base,
    /// Curvature at the landmarks.
    #[cfg_attr(feature = "cli", arg(long, value_enum, default_value_t))]
    pub cones: Cones,
    /// Which class of maps, where several are nearly as good.
    #[cfg_attr(feature = "cli", arg(long, value_enum, default_value_t))]
    pub class: ClassChoice,
    /// Points that are added as cones of the program's own where there are few landmarks, beside ends of limbs without a landmark; 0 for
    /// none of both; where it is not given 20, and up to 40 on bodies of many long limbs.
    #[cfg_attr(feature = "cli", arg(long, value_name = "N"))]
    pub own_cones: Option<usize>,
    /// How holes that both meshes have are treated.
    #[cfg_attr(feature = "cli", arg(long, value_enum, default_value_t))]
    pub borders: Borders,
}

impl From<Choices> for PipelineOptions {
    fn from(choices: Choices) -> Self {
        let Choices { method, base, cones, class, own_cones, borders } = choices;
        let usual = OwnConeOptions::default();
        let own_cones = own_cones.map_or(usual, |count| OwnConeOptions { count, most: count, ..usual });
        Self { method, base, cones, class, own_cones, borders, ..Self::default() }
    }
}

/// All options of the pipeline; a user sets [`Choices`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PipelineOptions {
    /// How the map is made.
    pub method: Method,
    /// Where the base domain comes from.
    pub base: Base,
    /// Curvature at the landmarks.
    pub cones: Cones,
    /// Options of both flows.
    pub flow: FlowOptions,
    /// Options of the layout of the thesis' method, drawn at full resolution.
    pub layout: LayoutOptions,
    /// Options of the search for the class of the map.
    pub search: SearchOptions,
    /// The class that is taken where several are close.
    pub class: ClassChoice,
    /// Options of the coarse map and of its refinement.
    pub multilevel: MultilevelOptions,
    /// Options of the program's own cones where there are few landmarks.
    pub own_cones: OwnConeOptions,
    /// How holes that both meshes have are treated.
    pub borders: Borders,
    /// The relaxation of the map.
    pub relaxation: Relaxation,
}

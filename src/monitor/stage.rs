//! The stages a user waits for.

use serde::Serialize;
use std::fmt;

/// The stages a user waits for, in the order in which a run passes them; no run passes all of them
/// ([`crate::pipeline::PipelineOptions::stages`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Files are read and checked, landmarks inserted.
    Landmarks,
    /// Landmark pairs that nobody gave are looked for.
    Matching,
    /// Landmarks whose clicks are uncertain are moved to where the map around them leads.
    Settling,
    /// Landmark pairs that do not fit and limbs without a landmark are looked for.
    Findings,
    /// The base domain is drawn on both meshes at full resolution (the methods that map patch by patch).
    BaseDomain,
    /// Ways to draw the base domain are judged by the coarse maps that they lead to.
    ClassSearch,
    /// Cones of the program's own are added, where the landmarks are few or the meshes two poses of one body.
    OwnCones,
    /// The map is relaxed, from the coarse levels to the full meshes.
    Relaxation,
    /// The independent check of bijectivity.
    Certificate,
    /// Source vertices are located in the target's triangles, and both meshes are laid over each other.
    Composition,
    /// The discrete Ricci flow of the source.
    SourceConeMetric,
    /// The discrete Ricci flow of the target.
    TargetConeMetric,
    /// The patchwise map over both cone metrics (the thesis' method).
    PatchwiseMap,
    /// Textures, attributes and measures.
    Transfer,
    /// A mesh gets new triangles.
    Remeshing,
    /// Vertices that are worth a landmark are looked for.
    Suggestion,
    /// A base mesh is laid onto a scan.
    Wrapping,
}

impl Stage {
    /// What the program does meanwhile, in words for the user.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Landmarks => "Placing the landmarks",
            Self::Matching => "Matching the two bodies",
            Self::Settling => "Letting the soft landmarks settle",
            Self::Findings => "Comparing the landmark pairs",
            Self::BaseDomain => "Drawing the base domain on both meshes",
            Self::ClassSearch => "Choosing the class of the map",
            Self::OwnCones => "Trying cones of the program's own",
            Self::Relaxation => "Relaxing the map",
            Self::Certificate => "Checking that the map is bijective",
            Self::Composition => "Carrying points from source to target",
            Self::SourceConeMetric => "Flattening the source to its cones",
            Self::TargetConeMetric => "Flattening the target to its cones",
            Self::PatchwiseMap => "Mapping patch by patch",
            Self::Transfer => "Carrying textures and values over",
            Self::Remeshing => "Making new triangles",
            Self::Suggestion => "Looking for places that are worth a landmark",
            Self::Wrapping => "Laying the base onto the scan",
        }
    }
}

impl fmt::Display for Stage {
    /// The name as in reports.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

//! The discrete conformal structures.

use serde::{Deserialize, Serialize};

/// The discrete conformal structure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Inversive distances, kept weighted Delaunay by flips: converges unless rounding stops it on very thin triangles.
    #[default]
    Inversive,
    /// Vertex scaling, kept Delaunay by flips: always converges.
    VertexScaling,
    /// Inversive distances on the mesh's own triangles (the thesis; Yang et al. 2009): breaks down on limbs.
    FixedTriangulation,
    /// Circles that touch along every edge, on the mesh's own triangles (Thurston 1980, chapter 13). No triangle degenerates, but the lengths
    /// that the flow begins with are sums of radii, not the mesh's.
    Tangential,
    /// Circles that touch or overlap by at most a right angle, on the mesh's own triangles (Thurston 1980, chapter 13; Chow, Luo 2003). No
    /// triangle degenerates, but the flow begins with the mesh's lengths only where such circles have them. There is no solution where circles
    /// around few neighbours overlap too far.
    Thurston,
}

impl Scheme {
    /// All structures.
    pub const ALL: [Self; 5] =
        [Self::Inversive, Self::VertexScaling, Self::FixedTriangulation, Self::Tangential, Self::Thurston];

    /// Whether the structure has a circle around each vertex.
    pub fn has_circles(self) -> bool {
        self != Self::VertexScaling
    }

    /// Whether the flow flips edges, so that no triangle degenerates.
    pub fn flips(self) -> bool {
        matches!(self, Self::Inversive | Self::VertexScaling)
    }
}

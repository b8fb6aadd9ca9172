//! The discrete conformal structures.

/// The discrete conformal structure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Scheme {
    /// Inversive distances, kept weighted Delaunay by flips: always converges.
    #[default]
    #[cfg_attr(feature = "cli", value(name = "inversive"))]
    InversiveDistance,
    /// Vertex scaling, kept Delaunay by flips: always converges.
    VertexScaling,
    /// Inversive distances on the mesh's own triangles (the thesis; Yang et al. 2009): breaks down on limbs.
    FixedTriangulation,
}

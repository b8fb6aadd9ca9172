//! Typed elements, halfedge connectivity, polygon soup, checks and points on the surface.

pub mod check;
pub mod closest_point;
pub mod coarsening;
pub mod collapsible;
pub mod generators;
mod ids;
pub mod insertion;
pub mod mirror;
pub mod normals;
mod refined;
pub mod repair;
pub mod soup;
pub mod surface_index;
mod surface_mesh;
mod surface_point;
mod textured;

pub use ids::{FaceId, HalfedgeId, VertexId};
pub(crate) use ids::{id as ids_id, star};
pub use refined::RefinedMesh;
pub use surface_mesh::{MeshError, SurfaceMesh};
pub use surface_point::SurfacePoint;
pub use textured::TexturedMesh;

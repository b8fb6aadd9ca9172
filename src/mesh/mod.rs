//! Typed elements, halfedge connectivity, polygon soup, checks and points on the surface.

pub mod cap_faces;
pub mod check;
pub mod closest_point;
pub mod coarsening;
pub mod collapsible;
pub mod dressing;
mod face_frame;
pub mod face_weights;
mod file_frame;
pub mod generators;
mod ids;
pub mod insertion;
pub mod look;
pub mod mirror;
pub mod normals;
mod packed;
pub mod packing;
mod place;
mod polygon;
mod refined;
pub mod repair;
pub mod resampling;
pub mod rims;
pub(crate) mod segment_index;
pub mod soup;
pub mod surface_index;
mod surface_mesh;
mod surface_point;

pub use face_frame::{Carrier, FaceFrame};
pub use file_frame::FileFrame;
pub use ids::{FaceId, HalfedgeId, VertexId};
pub(crate) use ids::{id as ids_id, star};
pub use place::{Place, PlaceKey};
pub use refined::RefinedMesh;
pub use surface_mesh::{MeshError, SurfaceMesh};
pub use surface_point::SurfacePoint;

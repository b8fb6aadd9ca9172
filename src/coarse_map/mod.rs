//! Coarse maps: the class of the map is chosen among maps of two coarse levels, and the chosen map is refined to the full meshes.

mod brief;
pub mod class_search;
mod error;
mod landmarked_mesh;
mod layout_points;
mod mesh_with_coarse;
pub mod multilevel;
mod options;
pub mod own_cones;
mod preview;
mod rim_draws;
mod rims;
mod skin;
pub mod unrelaxed;

pub use brief::{BriefOptions, brief_map};
pub use error::CoarseMapError;
pub use landmarked_mesh::{LEAST_PER_LANDMARK, LandmarkedMesh};
pub use mesh_with_coarse::{MeshWithCoarse, both as coarse_levels, coarse_landmarks};
pub use options::MultilevelOptions;
pub use rim_draws::RimDrawOptions;
pub use rims::RimOptions;

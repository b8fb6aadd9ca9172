//! Results to what a renderer draws: buffers, camera, picking. f32 starts here; no GPU type.

pub mod buffers;
pub mod camera;
pub mod picking;

pub use buffers::{LineVertex, MarkerInstance, SurfaceVertex};
pub use camera::{Camera, Ray};
pub use picking::Picker;

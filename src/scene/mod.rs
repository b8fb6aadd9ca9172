//! Results to what a renderer draws: buffers, camera, picking. f32 starts here; no GPU type.

pub mod buffers;
pub mod camera;
pub mod circles;
pub mod colours;
pub mod defects;
pub mod glide;
pub mod hollows;
pub mod looks;
pub mod map_picking;
pub mod morph;
pub mod patches;
pub mod picking;
pub mod pins;
pub mod plane_cut;
pub mod pose;
pub mod seams;
pub mod shading;
pub mod up_axis;
pub mod upright;

pub use buffers::{LineVertex, MarkerInstance, PinInstance, SurfaceVertex};
pub use camera::Camera;
pub use glide::Glide;
pub use map_picking::{MapPicker, MapPlace};
pub use patches::Patches;
pub use picking::Picker;
pub use pose::{Pose, Ray};
pub use shading::Shading;
pub use up_axis::UpAxis;

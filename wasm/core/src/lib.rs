//! The core: the module of the workers that read meshes and make maps. What it exports is `conemap::web` with the feature `web-core`.

#[cfg(target_arch = "wasm32")]
pub use conemap::web;

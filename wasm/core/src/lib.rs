//! The core: the wasm module of the workers that read meshes and make maps. It exports `conemap::web` with the feature `web-core`.

#[cfg(target_arch = "wasm32")]
pub use conemap::web;

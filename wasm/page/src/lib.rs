//! The page's wasm module, which sorts files, has the demos and draws meshes. It exports `conemap::web` with the feature `web-page`.

#[cfg(target_arch = "wasm32")]
pub use conemap::web;

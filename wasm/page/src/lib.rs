//! The page's module: sorts files, has the demos and draws meshes. What it exports is `conemap::web` with the feature `web-page`.

#[cfg(target_arch = "wasm32")]
pub use conemap::web;

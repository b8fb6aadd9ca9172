//! The page's module: sorts files, has the demos and draws meshes.
//!
//! The sources of both modules are in `wasm/boundary`; this package compiles what belongs to the feature `web-page`.

#![cfg(target_arch = "wasm32")]

// So that the sources name the library's modules as their own.
use conemap::*;

#[path = "../../boundary/gpu/mod.rs"]
pub mod gpu;
#[path = "../../boundary/web/mod.rs"]
pub mod web;

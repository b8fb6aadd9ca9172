//! The core: the module of the workers that read meshes and make maps.
//!
//! The sources of both modules are in `wasm/boundary`; this package compiles what belongs to the feature `web-core`.

#![cfg(target_arch = "wasm32")]

// So that the sources name the library's modules as their own.
use conemap::*;

#[path = "../../boundary/web/mod.rs"]
pub mod web;

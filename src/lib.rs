//! Bijective, low-distortion maps between two closed triangle meshes of genus 0 from corresponding landmarks.
//!
//! Data goes one way: mesh files -> polygon soup -> surface mesh -> landmarks -> coarse levels -> layout -> coarse map ->
//! surface map -> cone metrics and texture -> outputs. A stage takes the previous stage's result by reference with its
//! options and returns an owned result or its own error; only [`pipeline`] knows the order of the stages, and [`job`] goes
//! from a user's files to the pipeline and back. The core knows no browser, no GPU, no clock and no printing.

pub mod base_domain;
pub mod certificate;
pub mod coarse_map;
pub mod cone_metric;
pub mod demo;
pub mod export;
pub mod geodesic;
pub mod intrinsic;
pub mod io;
pub mod job;
pub mod landmark_exchange;
pub mod landmark_fit;
pub mod landmark_matching;
pub mod landmark_suggestion;
pub mod landmarks;
pub mod layout;
pub mod map_file;
pub mod math;
pub mod mesh;
mod mesh_side;
pub mod monitor;
pub mod numerics;
pub mod patchwise;
pub mod pipeline;
pub mod registration;
pub mod remesh;
pub mod scene;
pub mod soft_landmarks;
pub mod surface_map;
pub mod transfer;
pub mod wrap;

#[cfg(all(feature = "gpu", target_arch = "wasm32"))]
pub mod gpu;
#[cfg(all(feature = "web", target_arch = "wasm32"))]
pub mod web;

/// The examples of the README, run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExamples;

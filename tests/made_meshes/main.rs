//! The tests on meshes that the project makes itself: its demos, those remeshed, bent or made rough, and generated ones.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

#[path = "../common/bodies/mod.rs"]
mod bodies;
#[path = "../common/classes.rs"]
mod classes;
#[cfg(feature = "cli")]
#[path = "../common/command_line.rs"]
mod command_line;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/cutting.rs"]
mod cutting;
#[path = "../common/distance_bounds.rs"]
mod distance_bounds;
#[path = "../common/fit.rs"]
mod fit;
#[path = "../common/hostile_geometry.rs"]
mod hostile_geometry;
#[path = "../common/judged_job.rs"]
mod judged_job;
#[path = "../common/other_triangles.rs"]
mod other_triangles;
#[path = "../common/points.rs"]
mod points;
#[path = "../common/quads.rs"]
mod quads;
#[path = "../common/remeshing.rs"]
mod remeshing;
#[path = "../common/rough_meshes.rs"]
mod rough_meshes;
#[path = "../common/theorems.rs"]
mod theorems;

mod damage;
mod exact_geodesics;
mod fixtures;

mod agreement;
mod base;
mod base_picture;
mod borders;
mod bounds;
mod broken_files;
#[cfg(feature = "cli")]
mod cli;
mod clicks;
mod far_numbers;
mod few;
mod finish_now;
mod flow;
mod geodesic;
#[cfg(feature = "cli")]
mod glb_files;
mod glb_look;
mod handles;
mod holes;
mod job;
mod kinds;
mod landmark_fit;
mod landmark_matching;
mod layout;
mod map;
mod map_file;
mod mirror;
mod pipeline;
mod preview;
mod remesh;
mod repair;
mod search;
mod sharp_edges;
mod thesis;
mod torture;
#[cfg(feature = "cli")]
mod transfer;
mod wrap;

//! The wasm boundary: typed arrays in and out, errors as JSON with a stable code and a sentence.
//!
//! It makes two modules, so that the page need not wait for what reads meshes and makes maps: `web-page` has the demos, landmark
//! files and the views, `web-core` reads, checks and repairs meshes, makes maps and opens them, in workers. Meshes go from the
//! one to the other packed.
//!
//! `side` is the number of a mesh wherever the page gives it: 0 the source, 1 the target. Any other is an error with the code `side`.

mod demos;
mod failure;
mod loaded_mesh;
mod plane_numbers;
mod side_number;

#[cfg(feature = "web-page")]
mod defects;
#[cfg(feature = "web-page")]
mod files;
#[cfg(feature = "web-page")]
mod landmark_files;
#[cfg(feature = "web-page")]
mod map_headers;
#[cfg(feature = "web-page")]
mod view_side;
#[cfg(feature = "web-page")]
mod viewer;

#[cfg(feature = "web-core")]
mod base_output;
#[cfg(feature = "web-core")]
mod compute;
#[cfg(feature = "web-core")]
mod core_values;
#[cfg(feature = "web-core")]
mod defect_search;
#[cfg(feature = "web-core")]
mod flows;
#[cfg(feature = "web-core")]
mod matching;
#[cfg(feature = "web-core")]
mod mirrors;
#[cfg(feature = "web-core")]
mod morph;
#[cfg(feature = "web-core")]
mod other_map;
#[cfg(feature = "web-core")]
mod output_file;
#[cfg(feature = "web-core")]
mod page_job;
#[cfg(feature = "web-core")]
mod planes;
#[cfg(feature = "web-core")]
mod repair;
#[cfg(feature = "web-core")]
mod saved;
#[cfg(feature = "web-core")]
mod simplification;
#[cfg(feature = "web-core")]
mod suggestions;
#[cfg(feature = "web-core")]
mod transfer;

use failure::failure;
use side_number::mesh_side;

//! Values that the page says for itself, since it needs them before the core is there: its tests compare them with these.

use super::failure;
use crate::io::MAX_BYTES;
use crate::io::landmark_file::{MAX_PAIRS, MAX_RADIUS};
use crate::job::{MORPH_FILE, OutputKind};
use crate::landmarks::{LEAST_LANDMARKS, MeshSide};
use crate::mesh::repair::RepairOptions;
use crate::pipeline::{Choices, OwnConeOptions, Scheme};
use crate::scene::UpAxis;
use crate::scene::camera::LEAST_TO_TURN;
use crate::transfer::{Carrying, Raster, USUAL_GIVER};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The usual choices where nothing is chosen, and the limits of the core.
#[derive(Serialize, tsify::Tsify)]
#[serde(rename_all = "camelCase")]
pub struct CoreValues {
    /// The usual choices of a run.
    choices: Choices,
    /// The number of landmark pairs that a map needs.
    least_landmarks: usize,
    /// The number of landmark pairs that tell how one body lies to the other.
    least_to_turn: usize,
    /// The most pairs of a landmark file.
    most_pairs: usize,
    /// The largest radius of a soft pair.
    largest_radius: f64,
    /// The most landmarks to which the program adds cones of its own.
    most_landmarks_with_own_cones: usize,
    /// The same between two poses of one body.
    most_pose_landmarks_with_own_cones: usize,
    /// The most bytes of a mesh file.
    largest_file: usize,
    /// The axis that points up.
    up: UpAxis,
    /// All that a repair may be allowed.
    every_repair: RepairOptions,
    /// The structure of the flow that the method goes by.
    scheme: Scheme,
    /// The mesh that gives what is brought across.
    giver: MeshSide,
    /// The usual method to bring values across.
    carrying: Carrying,
    /// Texels in a row of a texture that is baked.
    texture_size: u16,
    /// The most of them.
    largest_texture_size: u16,
    /// The names of all files that a map gives.
    outputs: Vec<&'static str>,
}

/// These values: JSON, `CoreValues`.
///
/// # Errors
/// None that can be helped.
#[wasm_bindgen(js_name = coreValues)]
pub fn core_values() -> Result<String, JsValue> {
    let values = CoreValues {
        choices: Choices::default(),
        least_landmarks: LEAST_LANDMARKS,
        least_to_turn: LEAST_TO_TURN,
        most_pairs: MAX_PAIRS,
        largest_radius: MAX_RADIUS,
        most_landmarks_with_own_cones: OwnConeOptions::default().most_landmarks,
        most_pose_landmarks_with_own_cones: OwnConeOptions::default().most_pose_landmarks,
        largest_file: MAX_BYTES,
        up: UpAxis::default(),
        every_repair: RepairOptions::everything(),
        scheme: Scheme::default(),
        giver: USUAL_GIVER,
        carrying: Carrying::default(),
        texture_size: Raster::USUAL_SIZE,
        largest_texture_size: Raster::LARGEST_SIZE,
        outputs: OutputKind::ALL.map(OutputKind::file_name).into_iter().chain([MORPH_FILE]).collect(),
    };
    serde_json::to_string(&values).map_err(|e| failure("options", e))
}

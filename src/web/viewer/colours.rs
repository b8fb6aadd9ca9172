//! Colours of the picture, for legends.

use crate::scene::colours::{self, distortion_scale, landmark_colour};
use wasm_bindgen::prelude::*;

/// The colour of landmark `k` in the views, linear RGB from 0 to 1.
#[wasm_bindgen(js_name = landmarkColour)]
pub fn colour_of_landmark(k: usize) -> Vec<f32> {
    landmark_colour(k).to_vec()
}

/// The colours of the distortion at even steps of its logarithm from 1 to 4, linear RGB from 0 to 1, three numbers a colour.
#[wasm_bindgen(js_name = distortionScale)]
pub fn scale_of_distortion() -> Vec<f32> {
    distortion_scale().as_flattened().to_vec()
}

/// Distances to the true map, in units of the root of the target's area, as distortions of the same colour: what an overlay takes in their
/// place.
#[wasm_bindgen(js_name = truthOnScale)]
pub fn truth_on_scale(distances: &[f32]) -> Vec<f32> {
    distances.iter().map(|&distance| colours::truth_on_scale(distance)).collect()
}

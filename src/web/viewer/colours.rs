//! Colours of the picture, for legends.

use crate::scene::colours::{distortion_scale, landmark_colour};
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

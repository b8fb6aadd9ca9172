//! Colours of the picture, for legends.

use crate::scene::colours::{landmark_colour, rising_scale};
use wasm_bindgen::prelude::*;

/// The colour of landmark `k` in the views, linear RGB from 0 to 1.
#[wasm_bindgen(js_name = landmarkColour)]
pub fn colour_of_landmark(k: usize) -> Vec<f32> {
    landmark_colour(k).to_vec()
}

/// The colours of a scale from little to much at even steps, linear RGB from 0 to 1, three numbers a colour.
#[wasm_bindgen(js_name = risingScale)]
pub fn scale_from_little_to_much() -> Vec<f32> {
    rising_scale().as_flattened().to_vec()
}

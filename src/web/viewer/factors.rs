//! A flow on both meshes: the conformal factor as colour.

use super::super::mesh_side;
use super::super::view_side::Factors;
use super::canvas::Viewer;
use crate::scene::colours::factor_scale;
use wasm_bindgen::prelude::*;

/// The colours of factors of length from those that shrink to those that grow, linear RGB from 0 to 1, three numbers a colour.
#[wasm_bindgen(js_name = factorScale)]
pub fn scale_of_factors() -> Vec<f32> {
    factor_scale().as_flattened().to_vec()
}

#[wasm_bindgen]
impl Viewer {
    /// Shows one side in the colours of factors: by vertex of its mesh two places on the scale, 0 to 1, between which
    /// [`Viewer::blend_factors`] goes. Numbers that do not fit the mesh are passed over.
    #[wasm_bindgen(js_name = setFactors)]
    pub fn set_factors(&mut self, side: usize, from: &[f32], to: &[f32]) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let last = side.factors.take();
        let Some(own) = &side.mesh else { return Ok(()) };
        let count = own.checked.mesh.vertex_count();
        if from.len() == count && to.len() == count {
            side.factors = Some(Factors::new(last, own, [from, to], &self.renderer));
        }
        Ok(())
    }

    /// Draws circles around the vertices of a side that is shown in such colours: by vertex the radius, in units of the root of the mesh's
    /// area. They stay until the colours change.
    #[wasm_bindgen(js_name = setCircles)]
    pub fn set_circles(&mut self, side: usize, radii: &[f32]) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let (Some(factors), Some(own)) = (&mut side.factors, &side.mesh) else { return Ok(()) };
        if radii.len() == own.checked.mesh.vertex_count() {
            factors.draw_circles(radii, self.factor_share, &self.renderer);
        }
        Ok(())
    }

    /// Sets the share, 0 to 1, of the way of the colours from the first places to the second.
    #[wasm_bindgen(js_name = blendFactors)]
    pub fn blend_factors(&mut self, share: f32) {
        self.factor_share = share.clamp(0.0, 1.0);
    }

    /// Shows both sides as they were before.
    #[wasm_bindgen(js_name = clearFactors)]
    pub fn clear_factors(&mut self) {
        self.sides.iter_mut().for_each(|side| side.factors = None);
    }
}

//! The base domain of a finished map, for the page.

use super::compute::{MapOutput, flat3};
use super::mesh_side;
use crate::job::BaseShape;
use crate::surface_map::flat_layout::BorderPart;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl MapOutput {
    /// Triangles of the base domain: three cones each; empty where it is not known how it lies on the meshes.
    #[wasm_bindgen(js_name = baseTriangles)]
    pub fn base_triangles(&self) -> Vec<u32> {
        self.shown().base.as_ref().map(|base| base.triangles.concat()).unwrap_or_default()
    }

    /// The number of the patch line from corner k to k + 1 of each base triangle.
    #[wasm_bindgen(js_name = baseSides)]
    pub fn base_sides(&self) -> Vec<u32> {
        self.shown().base.as_ref().map(|base| base.sides.concat()).unwrap_or_default()
    }

    /// The positions of the cones on the source (0) or the target (1), three numbers each.
    #[wasm_bindgen(js_name = baseCones)]
    pub fn base_cones(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        Ok(self.base_shape(side)?.map(|shape| flat3(&shape.cones)).unwrap_or_default())
    }

    /// Angle defect of the base domain at each cone in the shape of the source (0) or the target (1), in radians.
    #[wasm_bindgen(js_name = baseCurvatures)]
    pub fn base_curvatures(&self, side: usize) -> Result<Vec<f64>, JsValue> {
        Ok(self.base_shape(side)?.map(|shape| shape.curvatures.clone()).unwrap_or_default())
    }

    /// Corners of the parts of one side's patches, three numbers a point.
    #[wasm_bindgen(js_name = patchPoints)]
    pub fn patch_points(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        Ok(self.base_shape(side)?.map(|shape| flat3(&shape.points)).unwrap_or_default())
    }

    /// The parts of the mesh's faces in the patches, as triangles, patch after patch in the order of the base triangles.
    #[wasm_bindgen(js_name = patchTriangles)]
    pub fn patch_triangles(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        Ok(self.base_shape(side)?.map(|shape| shape.patches.triangles.concat()).unwrap_or_default())
    }

    /// Where each patch starts among the triangles, and one past the end.
    #[wasm_bindgen(js_name = patchStarts)]
    pub fn patch_starts(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let starts = self.base_shape(side)?.map(|shape| &shape.patches.starts);
        Ok(starts.into_iter().flatten().map(|&start| start as u32).collect())
    }

    /// The face of the checked mesh that holds each of these triangles.
    #[wasm_bindgen(js_name = patchFaces)]
    pub fn patch_faces(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let shape = self.base_shape(side)?;
        Ok(shape.map(|shape| shape.patches.faces.iter().map(|f| f.0).collect()).unwrap_or_default())
    }

    /// The borders of the patches, four numbers a piece: the base triangle's corner at which its side begins (three times the triangle plus
    /// the corner), the face of the checked mesh, and the points at its ends. Each piece is there from both of its patches.
    #[wasm_bindgen(js_name = patchBorders)]
    pub fn patch_borders(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let parts = self.base_shape(side)?.map(|shape| &shape.borders);
        let numbers = |part: &BorderPart| [part.border.0, part.face.0, part.from, part.to];
        Ok(parts.into_iter().flatten().flat_map(numbers).collect())
    }

    /// The face of the checked mesh in the middle of each base triangle's patch.
    #[wasm_bindgen(js_name = patchMiddles)]
    pub fn patch_middles(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let shape = self.base_shape(side)?;
        Ok(shape.map(|shape| shape.middles.iter().map(|f| f.0).collect()).unwrap_or_default())
    }
}

impl MapOutput {
    fn base_shape(&self, side: usize) -> Result<Option<&BaseShape>, JsValue> {
        let side = mesh_side(side)?;
        Ok(self.shown().base.as_ref().map(|base| &base.shapes[side]))
    }
}

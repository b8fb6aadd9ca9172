//! The way of a saved map's source to its target's shape, for the views.

use super::failure;
use super::saved::SavedMap;
use crate::job::DrawnPoints;
use crate::mesh::FaceId;
use crate::monitor::Silent;
use crate::scene::buffers::Frame;
use crate::scene::morph::{PackedWay, matrix};
use glam::{DVec3, Mat4};
use wasm_bindgen::prelude::*;

/// The way of a map's points to the target's shape, as the views take it.
#[wasm_bindgen]
pub struct MorphWay {
    laid: Mat4,
    way: PackedWay,
}

#[wasm_bindgen]
impl MorphWay {
    /// The matrix that lays the target on the source, in scene coordinates, column by column.
    pub fn laid(&self) -> Vec<f32> {
        self.laid.to_cols_array().to_vec()
    }

    /// The length in scene units for which 32767 stands in the bends.
    pub fn range(&self) -> f32 {
        self.way.range
    }

    /// Twelve numbers for each point: three times x, y and z of a bend and one coordinate of the turn.
    pub fn bends(&self) -> Vec<i16> {
        self.way.points.as_flattened().as_flattened().to_vec()
    }
}

/// Places of points, three numbers each.
fn places(numbers: &[f32]) -> Vec<DVec3> {
    numbers.as_chunks::<3>().0.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect()
}

#[wasm_bindgen]
impl SavedMap {
    /// The way of points that the views show of this map: places on the source and on the target, three numbers each, triangles of points, and
    /// the source's face of each.
    ///
    /// # Errors
    /// `{"code": "morph", "message"}`.
    pub fn way(
        &self,
        source: &[f32],
        target: &[f32],
        triangles: &[u32],
        faces: &[u32],
    ) -> Result<MorphWay, JsValue> {
        let map = self.open().taken();
        let [source, target] = [source, target].map(places);
        let faces: Vec<FaceId> = faces.iter().map(|face| FaceId(*face)).collect();
        let points =
            DrawnPoints { places: [&source, &target], triangles: triangles.as_chunks().0, faces: &faces };
        let frames = map.surfaces().map(Frame::of);
        let draw: [&dyn Fn(DVec3) -> DVec3; 2] =
            [&|p| frames[0].exact_place(p), &|p| frames[1].exact_place(p)];
        let drawn = map.way(points, draw, &mut Silent).map_err(|e| failure("morph", e))?;
        Ok(MorphWay { laid: matrix(&drawn.laid), way: PackedWay::new(&drawn.way.bends, &drawn.way.turns) })
    }
}

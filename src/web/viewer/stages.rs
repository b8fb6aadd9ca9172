//! A mesh on its way to its landmarks.

use super::super::mesh_side;
use super::super::view_side::CoarseStage;
use super::canvas::Viewer;
use super::reading::point;
use crate::scene::buffers::{Triangles, edges, facets, ribbons};
use crate::scene::seams;
use glam::Vec3;
use wasm_bindgen::prelude::*;

/// The largest number of triangles of a mesh whose edges are drawn. Chosen by hand.
const MOST_WITH_EDGES: usize = 30_000;

#[wasm_bindgen]
impl Viewer {
    /// Shows triangles of points in the place of one side's mesh; those with corners that are no points are left out.
    #[wasm_bindgen(js_name = setStage)]
    pub fn set_stage(&mut self, side: usize, positions: &[f32], triangles: &[u32]) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let Some(mesh) = &side.mesh else { return Ok(()) };
        let points: Vec<Vec3> =
            positions.chunks_exact(3).map(|p| mesh.frame.place(point([p[0], p[1], p[2]]))).collect();
        let is_there = |t: &[u32; 3]| t.iter().all(|&v| (v as usize) < points.len());
        let triangles: Vec<[u32; 3]> =
            triangles.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).filter(is_there).collect();
        let Triangles { vertices, indices } = facets(&points, &triangles);
        let edges = (triangles.len() <= MOST_WITH_EDGES).then(|| {
            let Triangles { vertices, indices } = ribbons(&edges(&points, &triangles));
            self.renderer.line_mesh(&vertices, &indices)
        });
        side.stage = Some(CoarseStage {
            surface: self.renderer.surface_mesh(&vertices, &indices),
            edges,
            trail: None,
        });
        Ok(())
    }

    /// Draws the way of a vertex, from place to place, over the triangles that one side shows; without places there is none.
    #[wasm_bindgen(js_name = setTrail)]
    pub fn set_trail(&mut self, side: usize, positions: &[f32]) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let (Some(stage), Some(mesh)) = (&mut side.stage, &side.mesh) else { return Ok(()) };
        let points: Vec<Vec3> =
            positions.chunks_exact(3).map(|p| mesh.frame.place(point([p[0], p[1], p[2]]))).collect();
        let steps: Vec<[u32; 2]> = (1..points.len() as u32).map(|k| [k - 1, k]).collect();
        let Triangles { vertices, indices } = seams::drawn(&points, &steps);
        stage.trail = (!indices.is_empty()).then(|| self.renderer.marked_line_mesh(&vertices, &indices));
        Ok(())
    }

    /// Shows both sides as they were before.
    #[wasm_bindgen(js_name = clearStages)]
    pub fn clear_stages(&mut self) {
        self.sides.iter_mut().for_each(|side| side.stage = None);
    }
}

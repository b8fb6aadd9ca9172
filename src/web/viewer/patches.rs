//! The patches of a map, and those that are lit up on both meshes.

use super::super::mesh_side;
use super::super::view_side::Lit;
use super::canvas::Viewer;
use super::reading::{point, strips};
use crate::scene::Patches;
use crate::scene::buffers::Triangles;
use glam::DVec3;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Takes the patches of one side: points, triangles of points, patch after patch, where each patch starts among them with one past
    /// the end, and the patch lines as [`Viewer::set_lines`] takes them. From then on [`Viewer::probe`] tells the source's patch.
    #[wasm_bindgen(js_name = setPatches)]
    pub fn set_patches(
        &mut self,
        side: usize,
        points: &[f32],
        triangles: &[u32],
        starts: &[u32],
        line_points: &[f32],
        line_starts: &[u32],
    ) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let points: Vec<DVec3> = points.chunks_exact(3).map(|p| point([p[0], p[1], p[2]])).collect();
        let triangles = triangles.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let starts = starts.iter().map(|&start| start as usize).collect();
        side.patches = Patches::new(points, triangles, starts, strips(line_points, line_starts));
        Ok(())
    }

    /// Removes the patches, and lights up nothing.
    #[wasm_bindgen(js_name = clearPatches)]
    pub fn clear_patches(&mut self) {
        for side in &mut self.sides {
            side.patches = None;
            side.lit = Lit::default();
        }
    }

    /// Lights up a patch, or none, and patch lines on both meshes in the place of what was lit up before.
    pub fn light(&mut self, patch: Option<u32>, lines: &[u32]) {
        let numbers: Vec<usize> = lines.iter().map(|&line| line as usize).collect();
        for side in &mut self.sides {
            side.lit = Lit::default();
            let (Some(mesh), Some(patches)) = (&side.mesh, &side.patches) else { continue };
            let place = |p: DVec3| mesh.frame.place(p);
            if let Some(patch) = patch {
                let Triangles { vertices, indices } = patches.lit_surface(patch as usize, place);
                let surface = || self.renderer.surface_mesh(&vertices, &indices);
                side.lit.surface = (!indices.is_empty()).then(surface);
            }
            let Triangles { vertices, indices } = patches.lit_lines(&numbers, place);
            side.lit.lines =
                (!indices.is_empty()).then(|| self.renderer.marked_line_mesh(&vertices, &indices));
        }
    }
}

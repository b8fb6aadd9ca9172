//! A map that is being made, in the source's view.

use super::super::view_side::Preview;
use super::canvas::Viewer;
use super::reading::point;
use glam::Vec3;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Shows a map that is being made in the place of the last one: by vertex of the source its place on the target, three numbers each.
    /// Both meshes have the default pattern meanwhile.
    #[wasm_bindgen(js_name = setPreview)]
    pub fn set_preview(&mut self, places: &[f32]) {
        let last = self.sides[0].preview.take();
        let [Some(source), Some(target)] = [&self.sides[0].mesh, &self.sides[1].mesh] else { return };
        if places.len() < 3 * source.checked.mesh.vertex_count() {
            return;
        }
        let places: Vec<Vec3> =
            places.chunks_exact(3).map(|p| target.frame.place(point([p[0], p[1], p[2]]))).collect();
        let preview = Preview::new(last, source, &places, &self.renderer);
        self.sides[0].preview = Some(preview);
    }

    /// Shows again what was there before the previews.
    #[wasm_bindgen(js_name = clearPreview)]
    pub fn clear_preview(&mut self) {
        self.sides[0].preview = None;
    }
}

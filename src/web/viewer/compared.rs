//! Another map beside the one that is shown: both views show the source, each with what its map carries.

use super::canvas::Viewer;
use super::compared_map::ComparedMap;
use super::maps::Overlay;
use crate::gpu::{Paint, ViewDraw};
use crate::landmarks::MeshSide;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Takes another map's triangles on the source, as [`Viewer::set_overlay`] does those of the map: from now on the second view shows
    /// the source with what that one carries, and its own side takes no clicks.
    #[wasm_bindgen(js_name = setCompared)]
    #[allow(clippy::too_many_arguments, reason = "typed arrays cannot be bundled")]
    pub fn set_compared(
        &mut self,
        positions: &[f32],
        normals: &[f32],
        uvs: &[f32],
        scale_places: &[f32],
        triangles: &[u32],
        images: &[f32],
        image_normals: &[f32],
    ) {
        let overlay = Overlay { positions, normals, uvs, scale_places, triangles, images, image_normals };
        self.compared = self.overlay_vertices(MeshSide::Source, overlay).map(|vertices| ComparedMap {
            overlay: self.renderer.surface_mesh(&vertices, triangles),
            lines: None,
        });
    }

    /// Takes that map's patch lines on the source, as [`Viewer::set_lines`] does.
    #[wasm_bindgen(js_name = setComparedLines)]
    pub fn set_compared_lines(&mut self, points: &[f32], starts: &[u32]) {
        let lines = self.line_mesh(MeshSide::Source, points, starts);
        if let Some(compared) = &mut self.compared {
            compared.lines = lines;
        }
    }

    /// Shows the second view's own side again.
    #[wasm_bindgen(js_name = clearCompared)]
    pub fn clear_compared(&mut self) {
        self.compared = None;
    }
}

impl Viewer {
    /// The other map, while the second view shows it: not while it shows a mesh that was refused.
    pub(super) fn compared(&self) -> Option<&ComparedMap> {
        self.compared.as_ref().filter(|_| self.sides.iter().all(|side| !side.is_covered()))
    }

    /// The mesh that a view shows.
    pub(super) fn side_in(&self, view: MeshSide) -> MeshSide {
        if self.compared().is_some() { MeshSide::Source } else { view }
    }

    /// The second view while it shows another map.
    pub(super) fn compared_view<'a>(&'a self, other: &'a ComparedMap, bare: ViewDraw<'a>) -> ViewDraw<'a> {
        let paint = self.style.paint();
        let own = self.sides[0].mesh.as_ref().map(|mesh| &mesh.surface);
        ViewDraw {
            // No look of its own is known for it.
            paint: if paint == Paint::Look { Paint::Plain } else { paint },
            pictures: &self.texture,
            surface: Some(&other.overlay),
            under: own.filter(|_| self.style.compared_holes),
            lines: other.lines.as_ref().filter(|_| self.style.patch_lines),
            ..bare
        }
    }
}

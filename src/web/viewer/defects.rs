//! Defects of meshes in the views.

use super::super::defects::MeshDefects;
use super::super::mesh_side;
use super::super::view_side::ShownDefects;
use super::canvas::Viewer;
use super::reading::named;
use crate::scene::UpAxis;
use crate::scene::defects::frame_of;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Shows a mesh that was refused, faint, with what is wrong with it, in the place of the mesh of a side until
    /// [`Viewer::clear_defects`]; `up` is the axis that points up. Meanwhile nothing is picked on that side, and its marks are not
    /// drawn.
    ///
    /// # Errors
    /// `{"code": "camera", "message"}`.
    #[wasm_bindgen(js_name = showRefused)]
    pub fn show_refused(&mut self, side: usize, defects: &MeshDefects, up: &str) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let up: UpAxis = named("camera", up)?;
        let frame = frame_of(&defects.defects);
        let shown = ShownDefects::new(defects, frame, &self.renderer).with_surface(defects, &self.renderer);
        side.cover(shown, up);
        Ok(())
    }

    /// Shows over the mesh of a side what was wrong with its file.
    #[wasm_bindgen(js_name = showRepaired)]
    pub fn show_repaired(&mut self, side: usize, defects: &MeshDefects) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let Some(frame) = side.mesh.as_ref().map(|mesh| mesh.frame) else { return Ok(()) };
        let shown = ShownDefects::new(defects, frame, &self.renderer);
        // A refused mesh may have been shown here, with a camera of its own.
        side.uncover();
        side.defects = Some(shown);
        Ok(())
    }

    /// Shows no defects of a side any more; where a refused mesh was shown, the side's own mesh is shown again with its camera as
    /// it was.
    #[wasm_bindgen(js_name = clearDefects)]
    pub fn clear_defects(&mut self, side: usize) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].uncover();
        Ok(())
    }

    /// Turns a view to a defect that is shown, by the places of its kind and its own in the list, and marks it with a ring.
    #[wasm_bindgen(js_name = lookAtDefect)]
    pub fn look_at_defect(
        &mut self,
        side: usize,
        defects: &MeshDefects,
        group: usize,
        index: usize,
    ) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        self.clear_probe();
        let MeshDefects { defects, normals } = defects;
        let side = &mut self.sides[side];
        let Some(frame) = side.defects.as_ref().map(|shown| shown.frame) else { return Ok(()) };
        let defect = defects.groups.get(group).and_then(|group| group.defects.get(index));
        let Some(outlook) = defect.and_then(|defect| defects.outlook(defect, normals)) else { return Ok(()) };
        let place = frame.place(outlook.place);
        let rim = frame.place(outlook.place + outlook.normal * outlook.radius);
        side.moved().face_around(place, outlook.normal.as_vec3(), rim.distance(place));
        side.probe = Some(place);
        Ok(())
    }
}

//! The point under the pointer, and its image under the map.

use super::super::mesh_side;
use super::canvas::Viewer;
use crate::landmarks::MeshSide;
use crate::scene::MapPlace;
use glam::Vec2;
use serde_json::json;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Marks what is seen at a place of a view with a ring.
    pub fn mark(&mut self, side: usize, x: f32, y: f32) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        self.clear_probe();
        if !self.shows_another_shape(side) {
            let side = &mut self.sides[side];
            side.probe = side.pick_place(Vec2::new(x, y), self.now);
        }
        Ok(())
    }

    /// The surface point at a place of a view, x and y from -1 to 1, y up: JSON `{"face", "barycentric"}`. `undefined` where there
    /// is none, or a cap, which takes no landmark.
    pub fn pick(&self, side: usize, x: f32, y: f32) -> Result<Option<String>, JsValue> {
        let side = mesh_side(side)?;
        if self.shows_another_shape(side) {
            return Ok(None);
        }
        let side = &self.sides[side];
        let point = side.pick(Vec2::new(x, y), self.now);
        Ok(point.zip(side.mesh.as_ref()).and_then(|(point, mesh)| mesh.on_skin(point)))
    }

    /// The number of the pin at a place of a view, among those that the body does not hide; `slack` in pixels of the page.
    #[wasm_bindgen(js_name = pinAt)]
    pub fn pin_at(&self, side: usize, x: f32, y: f32, slack: f32) -> Result<Option<usize>, JsValue> {
        let side = mesh_side(side)?;
        if self.shows_another_shape(side) {
            return Ok(None);
        }
        Ok(self.sides[side].pin_at(Vec2::new(x, y), slack, self.now, self.pixel_ratio))
    }

    /// The place of a pin in the view, x and y from -1 to 1, y up.
    #[wasm_bindgen(js_name = pinPlace)]
    pub fn pin_place(&self, side: usize, pin: usize) -> Result<Option<Vec<f32>>, JsValue> {
        let side = &self.sides[mesh_side(side)?];
        let seen = side.base(pin).and_then(|base| side.pose(self.now).project(base, side.aspect()));
        Ok(seen.map(|seen| vec![seen.x, seen.y]))
    }

    /// The surface point some pixels of the page beside a pin, y up: JSON `{"face", "barycentric"}`. `undefined` where there is
    /// none, or a cap.
    pub fn beside(&self, side: usize, pin: usize, dx: f32, dy: f32) -> Result<Option<String>, JsValue> {
        let side = &self.sides[mesh_side(side)?];
        let point = side.beside(pin, Vec2::new(dx, dy), self.now, self.pixel_ratio);
        Ok(point.zip(side.mesh.as_ref()).and_then(|(point, mesh)| mesh.on_skin(point)))
    }

    /// Asks the map at a place of a view, and marks the place and its partner with rings: JSON `{"points", "positions",
    /// "corners", "weights", "places", "patch"}`: the first two by side; the points of the map's triangle there and their weights; by side
    /// the place on the scale of factors, null where none is shown; the patch of the source, as [`Viewer::set_patches`] numbers it, null
    /// where it is not known. `undefined` where there is no map.
    pub fn probe(&mut self, side: usize, x: f32, y: f32) -> Result<Option<String>, JsValue> {
        let side = mesh_side(side)?;
        self.clear_probe();
        let place = self.place_under(side, Vec2::new(x, y));
        Ok(place.and_then(|place| self.show_probe(place)))
    }

    /// Likewise at a landmark point, given as JSON.
    #[wasm_bindgen(js_name = probePoint)]
    pub fn probe_point(&mut self, side: usize, point: &str) -> Result<Option<String>, JsValue> {
        let side = mesh_side(side)?;
        self.clear_probe();
        let place = self.place_of(side, point);
        Ok(place.and_then(|place| self.show_probe(place)))
    }

    /// The image of a landmark point of one side on the other one, both as JSON. `undefined` where there is no map, or the image
    /// lies in a cap, which takes no landmark.
    #[wasm_bindgen(js_name = imageOf)]
    pub fn image_of(&mut self, side: usize, point: &str) -> Result<Option<String>, JsValue> {
        let side = mesh_side(side)?;
        let place = self.place_of(side, point);
        let image = |place: MapPlace| {
            let other = self.sides[side.other()].mesh.as_ref()?;
            let position = place.positions[side.other()];
            other.on_skin(other.picker.as_ref()?.nearest(&other.checked.mesh, position)?)
        };
        Ok(place.and_then(image))
    }

    /// Takes the rings away; whether there were any.
    #[wasm_bindgen(js_name = clearProbe)]
    pub fn clear_probe(&mut self) -> bool {
        let shown = self.sides.iter().any(|side| side.probe.is_some());
        self.sides.iter_mut().for_each(|side| side.probe = None);
        shown
    }
}

impl Viewer {
    /// The place of the map at a place of a view.
    fn place_under(&mut self, view: MeshSide, at: Vec2) -> Option<MapPlace> {
        if self.shows_another_shape(view) {
            return None;
        }
        let side = &self.sides[view];
        let (from, along) = side.mesh.as_ref()?.ray(side.pose(self.now).ray(at, side.aspect()));
        self.map.as_mut()?.under_ray(view, from, along)
    }

    /// The place of the map at a landmark point, given as JSON.
    fn place_of(&mut self, side: MeshSide, point: &str) -> Option<MapPlace> {
        let mesh = self.sides[side].mesh.as_ref()?;
        let point = mesh.surface_point(serde_json::from_str(point).ok()?)?;
        self.map.as_mut()?.nearest(side, point.position(&mesh.checked.mesh))
    }

    fn show_probe(&mut self, place: MapPlace) -> Option<String> {
        self.probed = Some((place.corners, place.weights));
        let (mut points, mut places) = (Vec::new(), Vec::new());
        let share = self.factor_share;
        for (side, position) in self.sides.iter_mut().zip(place.positions) {
            let mesh = side.mesh.as_ref()?;
            let point = mesh.picker.as_ref()?.nearest(&mesh.checked.mesh, position)?;
            places.push(side.factors.as_ref().map(|factors| factors.at(&mesh.checked.mesh, point, share)));
            points.push(mesh.in_file(point));
            side.probe = Some(mesh.frame.place(position));
        }
        let patch = self.sides[0].patches.as_mut().and_then(|patches| patches.nearest(place.positions[0]));
        let positions = place.positions.map(|p| p.to_array());
        let MapPlace { corners, weights, .. } = place;
        let answer = json!({
            "points": points, "positions": positions, "corners": corners, "weights": weights, "places": places, "patch": patch,
        });
        Some(answer.to_string())
    }
}

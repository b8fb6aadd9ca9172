//! The cameras of both views.

use super::super::failure;
use super::super::view_side::Look;
use super::canvas::Viewer;
use super::reading::{named, parsed};
use crate::io::landmark_file::LandmarkPoint;
use crate::scene::camera::LookFrom;
use crate::scene::upright::proposed_up;
use crate::scene::{Camera, Glide, UpAxis};
use glam::Vec2;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Makes a view's camera glide from now on, for this time, to where it is put; without a duration it jumps.
    pub fn glide(&mut self, side: usize, now: f64, duration: f64) {
        self.now = now;
        let side = self.side_mut(side);
        side.glide = Some(Glide { from: side.pose(now), begin: now, duration });
    }

    /// A gesture begins that turns a view.
    pub fn grab(&mut self, side: usize) {
        let now = self.now;
        self.side_mut(side).grab(now);
    }

    /// Turns a view by a drag in units of its height, y up.
    pub fn orbit(&mut self, side: usize, dx: f32, dy: f32) {
        self.side_mut(side).moved().orbit(Vec2::new(dx, dy));
    }

    /// Moves a view by a drag in units of its height, y up.
    pub fn pan(&mut self, side: usize, dx: f32, dy: f32) {
        let side = self.side_mut(side);
        let aspect = side.aspect();
        side.moved().pan(Vec2::new(dx, dy), aspect);
    }

    /// Turns the picture counter-clockwise about the middle of the view, in radians.
    pub fn roll(&mut self, side: usize, angle: f32) {
        let camera = self.side_mut(side).moved();
        camera.roll_about(camera.target, angle);
    }

    /// Multiplies the distance to what is seen at a place of a view, x and y from -1 to 1, y up; the place stays.
    #[wasm_bindgen(js_name = zoomAt)]
    pub fn zoom_at(&mut self, side: usize, factor: f32, x: f32, y: f32) {
        let now = self.now;
        self.side_mut(side).zoom_at(Vec2::new(x, y), factor, now);
    }

    /// Brings the whole mesh into the view; the direction stays.
    pub fn fit(&mut self, side: usize) {
        self.side_mut(side).fit();
    }

    /// Puts the camera back to the first look.
    #[wasm_bindgen(js_name = resetCamera)]
    pub fn reset_camera(&mut self, side: usize) {
        self.side_mut(side).first_look();
    }

    /// Looks at the whole mesh from a side: `front`, `back`, `right`, `left`, `top` or `bottom`.
    ///
    /// # Errors
    /// `{"code": "camera", "message"}`.
    #[wasm_bindgen(js_name = lookFrom)]
    pub fn look_from(&mut self, side: usize, from: &str) -> Result<(), JsValue> {
        let from: LookFrom = named("camera", from)?;
        let side = self.side_mut(side);
        side.camera.look_from(from);
        side.fit();
        // The view stays as it was asked for when the mesh is turned upright or the window changes.
        side.look = Look::Whole;
        Ok(())
    }

    /// The axis of the mesh that points up on the screen: `x`, `-x`, `y`, `-y`, `z` or `-z`.
    ///
    /// # Errors
    /// `{"code": "camera", "message"}`.
    #[wasm_bindgen(js_name = setUp)]
    pub fn set_up(&mut self, side: usize, axis: &str) -> Result<(), JsValue> {
        let axis: UpAxis = named("camera", axis)?;
        self.side_mut(side).set_up(axis);
        Ok(())
    }

    /// The axis that seems to point up by the mesh's shape; `undefined` where it does not tell.
    #[wasm_bindgen(js_name = proposedUp)]
    pub fn proposed_up(&self, side: usize) -> Option<String> {
        let axis = proposed_up(&self.side(side).mesh.as_ref()?.checked.mesh)?;
        serde_json::to_value(axis).ok()?.as_str().map(str::to_owned)
    }

    /// Brings what is seen at a place of a view to its middle, and turns about it from now on; whether there is anything.
    #[wasm_bindgen(js_name = centreAt)]
    pub fn centre_at(&mut self, side: usize, x: f32, y: f32) -> bool {
        if self.shows_another_shape(side) {
            return false;
        }
        let now = self.now;
        let side = self.side_mut(side);
        let Some(place) = side.pick_place(Vec2::new(x, y), now) else { return false };
        side.moved().centre_on(place);
        true
    }

    /// Likewise a landmark point, as JSON.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = centreOn)]
    pub fn centre_on(&mut self, side: usize, point: &str) -> Result<(), JsValue> {
        let point: LandmarkPoint = parsed("landmarks", point)?;
        let side = self.side_mut(side);
        if let Some(place) = side.place_of(point) {
            side.moved().centre_on(place);
        }
        Ok(())
    }

    /// Turns a view to a landmark point, given as JSON, and comes near.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    pub fn face(&mut self, side: usize, point: &str) -> Result<(), JsValue> {
        let point: LandmarkPoint = parsed("landmarks", point)?;
        self.side_mut(side).face(point);
        Ok(())
    }

    /// Where a camera stands, for [`Viewer::set_camera`]; `undefined` at the first look.
    pub fn camera(&self, side: usize) -> Option<Vec<f32>> {
        let side = self.side(side);
        (!side.is_first_look()).then(|| side.camera.to_numbers().to_vec())
    }

    /// How a view's camera is turned now: right and up on the screen and back to the viewer, in the mesh's coordinates, three numbers
    /// each.
    pub fn axes(&self, side: usize) -> Vec<f32> {
        let pose = self.side(side).pose(self.now);
        [pose.right(), pose.up(), pose.back()].map(|axis| axis.to_array()).concat()
    }

    /// Puts a camera where one stood.
    ///
    /// # Errors
    /// `{"code": "camera", "message"}` where these are no numbers of a camera.
    #[wasm_bindgen(js_name = setCamera)]
    pub fn set_camera(&mut self, side: usize, camera: &[f32]) -> Result<(), JsValue> {
        let side = self.side_mut(side);
        let camera = Camera::from_numbers(side.camera.up, camera);
        *side.moved() = camera.ok_or_else(|| failure("camera", "these numbers are no camera's"))?;
        Ok(())
    }

    /// Brings the image of what is in the middle of a view to the middle of the other one; false where there is no map or no such
    /// place.
    pub fn follow(&mut self, leader: usize) -> bool {
        let leader = leader.min(1);
        if self.shows_another_shape(leader) {
            return false;
        }
        let view = &self.sides[leader];
        let Some(mesh) = &view.mesh else { return false };
        let (from, along) = mesh.ray(view.camera.pose().ray(Vec2::ZERO, view.aspect()));
        let Some(place) = self.map.as_mut().and_then(|map| map.under_ray(leader, from, along)) else {
            return false;
        };
        let other = &mut self.sides[1 - leader];
        if let Some(mesh) = &other.mesh {
            let place = mesh.frame.place(place.positions[1 - leader]);
            other.moved().centre_on(place);
        }
        true
    }
}

//! The cameras of both views.

use super::super::view_side::Look;
use super::super::{failure, mesh_side};
use super::canvas::Viewer;
use super::reading::{named, parsed};
use crate::io::landmark_file::LandmarkPoint;
use crate::landmarks::MeshSide;
use crate::scene::camera::LookFrom;
use crate::scene::upright::proposed_up;
use crate::scene::{Camera, Glide, UpAxis};
use glam::{Quat, Vec2, Vec3};
use wasm_bindgen::prelude::*;

impl Viewer {
    /// The turn of the other body that lays the points of pairs nearest to their partners on this one.
    fn turn_from_other(&self, side: MeshSide, pairs: &str) -> Result<Option<Quat>, JsValue> {
        let pairs: Vec<[LandmarkPoint; 2]> = parsed("landmarks", pairs)?;
        let place = |side: MeshSide, ends: [LandmarkPoint; 2]| self.sides[side].place_of(ends[side]);
        let places =
            pairs.into_iter().filter_map(|pair| Some((place(side.other(), pair)?, place(side, pair)?)));
        let (from, onto): (Vec<Vec3>, Vec<Vec3>) = places.unzip();
        Ok(Camera::turn_onto(&from, &onto))
    }
}

/// The name of an axis at the boundary.
fn axis_name(axis: UpAxis) -> Option<String> {
    serde_json::to_value(axis).ok().and_then(|name| name.as_str().map(str::to_owned))
}

#[wasm_bindgen]
impl Viewer {
    /// Makes a view's camera glide from now on, for this time, to where it is put; without a duration it jumps.
    pub fn glide(&mut self, side: usize, now: f64, duration: f64) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        self.now = now;
        side.glide = Some(Glide { from: side.pose(now), begin: now, duration });
        Ok(())
    }

    /// A gesture begins that turns a view.
    pub fn grab(&mut self, side: usize) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].grab(self.now);
        Ok(())
    }

    /// Turns a view by a drag in units of its height, y up.
    pub fn orbit(&mut self, side: usize, dx: f32, dy: f32) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].moved().orbit(Vec2::new(dx, dy));
        Ok(())
    }

    /// Moves a view by a drag in units of its height, y up.
    pub fn pan(&mut self, side: usize, dx: f32, dy: f32) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let aspect = side.aspect();
        side.moved().pan(Vec2::new(dx, dy), aspect);
        Ok(())
    }

    /// Turns the picture counter-clockwise about the middle of the view, in radians.
    pub fn roll(&mut self, side: usize, angle: f32) -> Result<(), JsValue> {
        let camera = self.sides[mesh_side(side)?].moved();
        camera.roll_about(camera.target, angle);
        Ok(())
    }

    /// Multiplies the distance to what is seen at a place of a view, x and y from -1 to 1, y up; the place stays.
    #[wasm_bindgen(js_name = zoomAt)]
    pub fn zoom_at(&mut self, side: usize, factor: f32, x: f32, y: f32) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].zoom_at(Vec2::new(x, y), factor, self.now);
        Ok(())
    }

    /// Brings the whole mesh into the view; the direction stays.
    pub fn fit(&mut self, side: usize) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].fit();
        Ok(())
    }

    /// Puts the camera back to the first look.
    #[wasm_bindgen(js_name = resetCamera)]
    pub fn reset_camera(&mut self, side: usize) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].first_look();
        Ok(())
    }

    /// Looks at the whole mesh from a side: `front`, `back`, `right`, `left`, `top` or `bottom`.
    ///
    /// # Errors
    /// `{"code": "camera", "message"}`.
    #[wasm_bindgen(js_name = lookFrom)]
    pub fn look_from(&mut self, side: usize, from: &str) -> Result<(), JsValue> {
        let from: LookFrom = named("camera", from)?;
        let side = &mut self.sides[mesh_side(side)?];
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
        self.sides[mesh_side(side)?].set_up(axis);
        Ok(())
    }

    /// The axis that seems to point up by the mesh's shape; `undefined` where it does not tell.
    #[wasm_bindgen(js_name = proposedUp)]
    pub fn proposed_up(&self, side: usize) -> Result<Option<String>, JsValue> {
        let mesh = self.sides[mesh_side(side)?].mesh.as_ref();
        let axis = mesh.and_then(|mesh| proposed_up(&mesh.checked.mesh));
        Ok(axis.and_then(axis_name))
    }

    /// Turns a view so that its whole mesh is seen as the other one is; `pairs` are landmark points of both meshes, as JSON. The axis that
    /// points up then, likewise; `undefined`, and the view stays, where fewer than three pairs tell how one body lies to the other.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = lookAsOther)]
    pub fn look_as_other(&mut self, side: usize, pairs: &str) -> Result<Option<String>, JsValue> {
        let side = mesh_side(side)?;
        let Some(turn) = self.turn_from_other(side, pairs)? else { return Ok(None) };
        let other = self.sides[side.other()].camera;
        let side = &mut self.sides[side];
        side.camera.look_like(&other, turn);
        side.fit();
        Ok(axis_name(side.camera.up))
    }

    /// Brings what is seen at a place of a view to its middle, and turns about it from now on; whether there is anything.
    #[wasm_bindgen(js_name = centreAt)]
    pub fn centre_at(&mut self, side: usize, x: f32, y: f32) -> Result<bool, JsValue> {
        let side = mesh_side(side)?;
        if self.shows_another_shape(side) {
            return Ok(false);
        }
        let side = &mut self.sides[side];
        let Some(place) = side.pick_place(Vec2::new(x, y), self.now) else { return Ok(false) };
        side.moved().centre_on(place);
        Ok(true)
    }

    /// Likewise a landmark point, as JSON.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = centreOn)]
    pub fn centre_on(&mut self, side: usize, point: &str) -> Result<(), JsValue> {
        let point: LandmarkPoint = parsed("landmarks", point)?;
        let side = &mut self.sides[mesh_side(side)?];
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
        self.sides[mesh_side(side)?].face(point);
        Ok(())
    }

    /// The pose of a camera, for [`Viewer::set_camera`]; `undefined` at the first look.
    pub fn camera(&self, side: usize) -> Result<Option<Vec<f32>>, JsValue> {
        let side = &self.sides[mesh_side(side)?];
        Ok((!side.is_first_look()).then(|| side.camera.to_numbers().to_vec()))
    }

    /// The axes of a view's camera now: right and up on the screen and back to the viewer, in the mesh's coordinates, three numbers each.
    pub fn axes(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let pose = self.sides[mesh_side(side)?].pose(self.now);
        Ok([pose.right(), pose.up(), pose.back()].map(|axis| axis.to_array()).concat())
    }

    /// Puts a camera where one stood.
    ///
    /// # Errors
    /// `{"code": "camera", "message"}` where these are no numbers of a camera.
    #[wasm_bindgen(js_name = setCamera)]
    pub fn set_camera(&mut self, side: usize, camera: &[f32]) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let camera = Camera::from_numbers(side.camera.up, camera);
        *side.moved() = camera.ok_or_else(|| failure("camera", "these numbers are no camera's"))?;
        Ok(())
    }

    /// Brings the image of what is in the middle of a view to the middle of the other one; false where there is no map or no such
    /// place.
    pub fn follow(&mut self, leader: usize) -> Result<bool, JsValue> {
        let leader = mesh_side(leader)?;
        if self.shows_another_shape(leader) {
            return Ok(false);
        }
        let view = &self.sides[leader];
        let Some(mesh) = &view.mesh else { return Ok(false) };
        let (from, along) = mesh.ray(view.camera.pose().ray(Vec2::ZERO, view.aspect()));
        let Some(place) = self.map.as_mut().and_then(|map| map.under_ray(leader, from, along)) else {
            return Ok(false);
        };
        let other = &mut self.sides[leader.other()];
        if let Some(mesh) = &other.mesh {
            let place = mesh.frame.place(place.positions[leader.other()]);
            other.moved().centre_on(place);
        }
        Ok(true)
    }
}

//! The two views.

use super::failure;
use super::files::LoadedMesh;
use super::view_side::{Landmark, Look, Side, SideMesh};
use crate::gpu::{Clear, Paint, Palette, Renderer, ViewDraw};
use crate::io::landmark_file::LandmarkPoint;
use crate::scene::buffers::ribbons;
use crate::scene::camera::From as LookFrom;
use crate::scene::colours::{distortion_scale, landmark_colour};
use crate::scene::morph::laid_on;
use crate::scene::pins::Stand;
use crate::scene::upright::proposed_up;
use crate::scene::{Camera, Glide, MapPicker, MapPlace, MarkerInstance, PinInstance, SurfaceVertex, UpAxis};
use glam::{DVec3, Mat4, Vec2, Vec3};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// The colour of landmark `k` in the views, linear RGB from 0 to 1.
#[wasm_bindgen(js_name = landmarkColour)]
pub fn colour_of_landmark(k: usize) -> Vec<f32> {
    landmark_colour(k).to_vec()
}

/// The colours of the distortion at even steps of its logarithm from 1 to 4, linear RGB from 0 to 1, three numbers a colour.
#[wasm_bindgen(js_name = distortionScale)]
pub fn scale_of_distortion() -> Vec<f32> {
    distortion_scale().as_flattened().to_vec()
}

/// What the page wants to see.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Style {
    surface: SurfaceStyle,
    patch_lines: bool,
    cones: bool,
    markers: bool,
    #[serde(default)]
    dark: bool,
    /// Share of the source's view, from the left, in which the source is plain.
    #[serde(default)]
    wipe: Option<f32>,
    /// Whether parts of the surfaces may be unmapped: the plain meshes are drawn behind.
    #[serde(default)]
    holes: bool,
}

/// What the surfaces' colours tell.
#[derive(Clone, Copy, Default, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum SurfaceStyle {
    #[default]
    Shaded,
    Pattern,
    Checkerboard,
    Colours,
    Distortion,
}

impl SurfaceStyle {
    fn paint(self) -> Paint {
        match self {
            Self::Shaded => Paint::Plain,
            Self::Pattern => Paint::Pattern,
            Self::Checkerboard => Paint::Checkerboard,
            Self::Colours => Paint::Places,
            Self::Distortion => Paint::Distortion,
        }
    }

    /// Whether the target's own mesh can show it: what follows from the place on the target alone.
    fn is_of_places(self) -> bool {
        matches!(self, Self::Pattern | Self::Colours)
    }
}

/// A canvas with two views, source (0) and target (1). Times are in milliseconds, as the browser gives them to animations.
#[wasm_bindgen]
pub struct Viewer {
    renderer: Renderer,
    sides: [Side; 2],
    style: Style,
    map: Option<MapPicker>,
    /// Share of the way from the source's shape to the target's.
    morph: f32,
    /// Lays the target on the source, in scene coordinates.
    source_from_target: Mat4,
    pixel_ratio: f32,
    /// The time of the last frame.
    now: f64,
}

#[wasm_bindgen]
impl Viewer {
    /// Takes over a canvas.
    ///
    /// # Errors
    /// `{"code": "webgl", "message"}` where the browser has no WebGL2.
    pub async fn create(canvas: web_sys::HtmlCanvasElement, samples: u32) -> Result<Viewer, JsValue> {
        let samples = if samples > 1 { 4 } else { 1 };
        let renderer = Renderer::new(canvas, samples).await.map_err(|e| failure("webgl", e))?;
        Ok(Self {
            renderer,
            sides: Default::default(),
            style: Style::default(),
            map: None,
            morph: 0.0,
            source_from_target: Mat4::IDENTITY,
            pixel_ratio: 1.0,
            now: 0.0,
        })
    }

    /// Follows the canvas, in physical pixels.
    pub fn resize(&mut self, width: u32, height: u32, pixel_ratio: f32) {
        self.renderer.resize(width, height);
        self.pixel_ratio = pixel_ratio;
    }

    /// Where a view is, in physical pixels from the top left.
    #[wasm_bindgen(js_name = setViewport)]
    pub fn set_viewport(&mut self, side: usize, x: f32, y: f32, width: f32, height: f32) {
        let side = self.side_mut(side);
        let rectangle = [x, y, width, height];
        if side.rectangle != rectangle {
            side.rectangle = rectangle;
            if side.look == Look::Whole {
                side.fit();
            }
        }
    }

    /// Shows a mesh; its landmarks and result go.
    #[wasm_bindgen(js_name = setMesh)]
    pub fn set_mesh(&mut self, side: usize, mesh: &LoadedMesh) {
        let shown = SideMesh::new(mesh.checked.clone(), &self.renderer);
        self.clear_result();
        let side = self.side_mut(side);
        side.mesh = Some(shown);
        side.clear_marks();
        side.glide = None;
        side.first_look();
    }

    /// Empties a view.
    #[wasm_bindgen(js_name = clearMesh)]
    pub fn clear_mesh(&mut self, side: usize) {
        self.clear_result();
        let side = self.side_mut(side);
        side.mesh = None;
        side.clear_marks();
    }

    /// Shows landmarks: a JSON array, in pair order, of `{"point", "colour", "stand", "cone"}` or null: `colour` is the number
    /// that [`colour_of_landmark`] takes, `stand` is `plain`, `raised` or `ghost`, and `cone` the curvature of the landmark's cone
    /// in radians or null.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = setLandmarks)]
    pub fn set_landmarks(&mut self, side: usize, marks: &str) -> Result<(), JsValue> {
        self.side_mut(side).set_landmarks(marks)
    }

    /// Takes suggested points, a JSON array of landmark points or null; they are not drawn, see [`Viewer::suggestions`].
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = setSuggestions)]
    pub fn set_suggestions(&mut self, side: usize, points: &str) -> Result<(), JsValue> {
        self.side_mut(side).set_suggestions(points)
    }

    /// Takes the map's triangles as one side sees them: positions and normals there, texture coordinates, distortion by point
    /// (or none), and the images on the target.
    #[wasm_bindgen(js_name = setOverlay)]
    #[allow(clippy::too_many_arguments, reason = "typed arrays cannot be bundled")]
    pub fn set_overlay(
        &mut self,
        side: usize,
        positions: &[f32],
        normals: &[f32],
        uvs: &[f32],
        distortion: &[f32],
        triangles: &[u32],
        images: &[f32],
        image_normals: &[f32],
    ) {
        let [Some(target), Some(own)] = [&self.sides[1].mesh, &self.sides[side.min(1)].mesh] else { return };
        let count = positions.len() / 3;
        let numbers = [normals.len(), images.len(), image_normals.len()];
        if numbers.iter().any(|n| *n != 3 * count)
            || uvs.len() != 2 * count
            || triangles.iter().any(|&v| v as usize >= count)
        {
            return;
        }
        let hollows = own.hollows_at(positions, triangles);
        let three = |a: &[f32], k: usize| [a[3 * k], a[3 * k + 1], a[3 * k + 2]];
        let vertex = |k: usize| SurfaceVertex {
            position: own.frame.place(point(three(positions, k))).to_array(),
            normal: three(normals, k),
            uv: [uvs[2 * k], uvs[2 * k + 1]],
            distortion: distortion.get(k).copied().unwrap_or(1.0),
            image: target.frame.place(point(three(images, k))).to_array(),
            image_normal: three(image_normals, k),
            hollow: hollows[k],
        };
        let vertices: Vec<SurfaceVertex> = (0..count).map(vertex).collect();
        let uploaded = self.renderer.surface_mesh(&vertices, triangles);
        if side == 0 {
            let (images, places): (Vec<Vec3>, Vec<Vec3>) =
                vertices.iter().map(|v| (Vec3::from_array(v.image), Vec3::from_array(v.position))).unzip();
            self.source_from_target = laid_on(&images, &places);
        }
        self.side_mut(side).overlay = Some(uploaded);
    }

    /// Takes patch lines of one side: their points, and where each line starts among them, and one past the end.
    #[wasm_bindgen(js_name = setLines)]
    pub fn set_lines(&mut self, side: usize, points: &[f32], starts: &[u32]) {
        let Some(mesh) = &self.sides[side.min(1)].mesh else { return };
        let points: Vec<Vec3> =
            points.chunks_exact(3).map(|p| mesh.frame.place(point([p[0], p[1], p[2]]))).collect();
        let strips: Vec<Vec<Vec3>> = starts
            .windows(2)
            .filter_map(|w| points.get(w[0] as usize..w[1] as usize).map(<[Vec3]>::to_vec))
            .collect();
        let (vertices, indices) = ribbons(&strips);
        let uploaded = self.renderer.line_mesh(&vertices, &indices);
        self.side_mut(side).lines = Some(uploaded);
    }

    /// Takes the map to be asked by [`Viewer::probe`]: places of its points on both meshes, its distortion there (or none), and its
    /// triangles.
    #[wasm_bindgen(js_name = setMap)]
    pub fn set_map(&mut self, source: &[f32], target: &[f32], distortion: &[f32], triangles: &[u32]) {
        let points = |a: &[f32]| a.chunks_exact(3).map(|p| point([p[0], p[1], p[2]])).collect();
        let triangles = triangles.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        self.map = MapPicker::new([points(source), points(target)], distortion.to_vec(), triangles);
    }

    /// Shows the source's shape on its way to the target's: 0 the source's, 1 the target's, laid on it. Needs the source's overlay.
    /// Beyond 0 nothing is where the source's mesh has it, and the source's view shows no marks and picks nothing.
    #[wasm_bindgen(js_name = setMorph)]
    pub fn set_morph(&mut self, share: f32) {
        self.morph = share.clamp(0.0, 1.0);
    }

    /// Everything of a result goes.
    #[wasm_bindgen(js_name = clearResult)]
    pub fn clear_result(&mut self) {
        self.sides.iter_mut().for_each(Side::clear_result);
        self.map = None;
        self.morph = 0.0;
    }

    /// What to show: JSON `{"surface", "patchLines", "cones", "markers", "dark"?, "holes"?, "wipe"?}`; with `wipe`, a share of the
    /// source's view, the source is plain from the left to there.
    ///
    /// # Errors
    /// `{"code": "style", "message"}`.
    #[wasm_bindgen(js_name = setStyle)]
    pub fn set_style(&mut self, style: &str) -> Result<(), JsValue> {
        self.style = parsed("style", style)?;
        Ok(())
    }

    /// From now on, in this time, a view's camera glides to where it is put; without a duration it jumps.
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

    /// Back to the first look.
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
        // It stays as it was asked for when the mesh is turned upright or the window changes.
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
        if self.is_morphed(side) {
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

    /// Brings the image of what is in the middle of a view to the middle of the other one; whether there is a map and a place.
    pub fn follow(&mut self, leader: usize) -> bool {
        let leader = leader.min(1);
        if self.is_morphed(leader) {
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

    /// Marks what is seen at a place of a view with a ring.
    pub fn mark(&mut self, side: usize, x: f32, y: f32) {
        self.clear_probe();
        if self.is_morphed(side) {
            return;
        }
        let now = self.now;
        let side = self.side_mut(side);
        side.probe = side.pick_place(Vec2::new(x, y), now);
    }

    /// The surface point at a place of a view, x and y from -1 to 1, y up: JSON `{"face", "barycentric"}`. `undefined` where there
    /// is none, or a cap, which takes no landmark.
    pub fn pick(&self, side: usize, x: f32, y: f32) -> Option<String> {
        if self.is_morphed(side) {
            return None;
        }
        let side = self.side(side);
        let point = side.pick(Vec2::new(x, y), self.now)?;
        side.mesh.as_ref()?.on_skin(point)
    }

    /// The number of the pin at a place of a view, among those that the body does not hide; `slack` in pixels of the page.
    #[wasm_bindgen(js_name = pinAt)]
    pub fn pin_at(&self, side: usize, x: f32, y: f32, slack: f32) -> Option<usize> {
        if self.is_morphed(side) {
            return None;
        }
        self.side(side).pin_at(Vec2::new(x, y), slack, self.now, self.pixel_ratio)
    }

    /// Where the place of a pin is seen, x and y from -1 to 1, y up.
    #[wasm_bindgen(js_name = pinPlace)]
    pub fn pin_place(&self, side: usize, pin: usize) -> Option<Vec<f32>> {
        let side = self.side(side);
        let seen = side.pose(self.now).project(side.base(pin)?, side.aspect())?;
        Some(vec![seen.x, seen.y])
    }

    /// The surface point some pixels of the page beside a pin, y up: JSON `{"face", "barycentric"}`. `undefined` where there is
    /// none, or a cap.
    pub fn beside(&self, side: usize, pin: usize, dx: f32, dy: f32) -> Option<String> {
        let side = self.side(side);
        let point = side.beside(pin, Vec2::new(dx, dy), self.now, self.pixel_ratio)?;
        side.mesh.as_ref()?.on_skin(point)
    }

    /// Asks the map at a place of a view, and marks the place and its partner with rings: JSON `{"points", "positions",
    /// "distortion"}`, the first two by side, the last null where it is not known. `undefined` where there is no map.
    pub fn probe(&mut self, side: usize, x: f32, y: f32) -> Option<String> {
        self.clear_probe();
        let side = side.min(1);
        if self.is_morphed(side) {
            return None;
        }
        let view = &self.sides[side];
        let ray = view.pose(self.now).ray(Vec2::new(x, y), view.aspect());
        let (from, along) = view.mesh.as_ref()?.ray(ray);
        let place = self.map.as_mut()?.under_ray(side, from, along)?;
        self.show_probe(place)
    }

    /// Likewise at a landmark point, given as JSON.
    #[wasm_bindgen(js_name = probePoint)]
    pub fn probe_point(&mut self, side: usize, point: &str) -> Option<String> {
        self.clear_probe();
        let side = side.min(1);
        let mesh = self.sides[side].mesh.as_ref()?;
        let point = mesh.surface_point(serde_json::from_str(point).ok()?)?;
        let place = self.map.as_mut()?.nearest(side, point.position(&mesh.checked.mesh))?;
        self.show_probe(place)
    }

    /// The image of a landmark point of one side on the other one, both as JSON. `undefined` where there is no map, or the image
    /// lies in a cap, which takes no landmark.
    #[wasm_bindgen(js_name = imageOf)]
    pub fn image_of(&mut self, side: usize, point: &str) -> Option<String> {
        let side = side.min(1);
        let [mesh, other] = [side, 1 - side].map(|k| self.sides[k].mesh.as_ref());
        let (mesh, other) = (mesh?, other?);
        let point = mesh.surface_point(serde_json::from_str(point).ok()?)?;
        let place = self.map.as_mut()?.nearest(side, point.position(&mesh.checked.mesh))?;
        other.on_skin(other.picker.as_ref()?.nearest(&other.checked.mesh, place.positions[1 - side]))
    }

    /// Takes the rings away; whether there were any.
    #[wasm_bindgen(js_name = clearProbe)]
    pub fn clear_probe(&mut self) -> bool {
        let shown = self.sides.iter().any(|side| side.probe.is_some());
        self.sides.iter_mut().for_each(|side| side.probe = None);
        shown
    }

    /// For each landmark x and y of its head from -1 to 1, y up, and whether the number should be shown (1) or hides behind the
    /// surface (0).
    pub fn labels(&self, side: usize) -> Vec<f32> {
        self.shown(side, self.side(side).heads(self.now, self.pixel_ratio))
    }

    /// Where the suggested points are, as [`Viewer::labels`].
    pub fn suggestions(&self, side: usize) -> Vec<f32> {
        self.shown(side, self.side(side).suggested(self.now))
    }

    /// Draws a frame at a time; whether another one is to follow, as a camera is on its way.
    pub fn render(&mut self, now: f64) -> bool {
        self.now = now;
        for side in &mut self.sides {
            side.glide = side.glide.filter(|glide| !glide.is_over(now));
        }
        let palette = self.palette();
        let balls = [0, 1].map(|k: usize| self.balls(k));
        let pins = [0, 1].map(|k: usize| self.pins(k));
        let style = &self.style;
        let view = |k: usize| {
            let side: &Side = &self.sides[k];
            let own = side.mesh.as_ref().map(|m| &m.surface);
            let paint = style.surface.paint();
            let morph = if k == 0 && side.overlay.is_some() { self.morph } else { 0.0 };
            let shows_own =
                morph == 0.0 && (paint == Paint::Plain || (k == 1 && style.surface.is_of_places()));
            let overlay = side.overlay.as_ref().filter(|_| !shows_own);
            ViewDraw {
                rectangle: side.rectangle,
                pose: side.pose(now),
                paint: if overlay.is_some() || shows_own { paint } else { Paint::Plain },
                palette,
                line_half_width: 0.9 * self.pixel_ratio,
                morph,
                world_from_image: self.source_from_target,
                wipe: style.wipe.filter(|_| k == 0).unwrap_or(0.0),
                surface: overlay.or(own),
                under: own.filter(|_| style.holes && overlay.is_some() && morph == 0.0),
                lines: side.lines.as_ref().filter(|_| style.patch_lines && morph == 0.0),
                balls: &balls[k],
                pins: &pins[k],
            }
        };
        let views = [view(0), view(1)];
        // Linear RGB, chosen by eye.
        let background = if style.dark { [0.011, 0.013, 0.018] } else { [0.84, 0.86, 0.88] };
        self.renderer.draw(Clear(background), &views);
        self.sides.iter().any(|side| side.glide.is_some())
    }
}

impl Viewer {
    fn side(&self, side: usize) -> &Side {
        &self.sides[side.min(1)]
    }

    fn side_mut(&mut self, side: usize) -> &mut Side {
        &mut self.sides[side.min(1)]
    }

    /// Whether a view shows another shape than its mesh has.
    fn is_morphed(&self, side: usize) -> bool {
        side == 0 && self.morph > 0.0
    }

    /// Places of marks, x, y and visible for each, of which none is seen while the shape is another one.
    fn shown(&self, side: usize, mut places: Vec<f32>) -> Vec<f32> {
        if self.is_morphed(side) {
            places.chunks_exact_mut(3).for_each(|place| place[2] = 0.0);
        }
        places
    }

    /// Where the ring of a view is: on the surface as it is shown.
    fn ring(&self, side: usize) -> Option<Vec3> {
        let place = self.side(side).probe?;
        if !self.is_morphed(side) {
            return Some(place);
        }
        let image = self.source_from_target.transform_point3(self.sides[1].probe?);
        Some(place.lerp(image, self.morph))
    }

    fn show_probe(&mut self, place: MapPlace) -> Option<String> {
        let mut points = Vec::new();
        for (side, position) in self.sides.iter_mut().zip(place.positions) {
            let mesh = side.mesh.as_ref()?;
            let point = mesh.picker.as_ref()?.nearest(&mesh.checked.mesh, position);
            points.push(mesh.in_file(point));
            side.probe = Some(mesh.frame.place(position));
        }
        let positions = place.positions.map(|p| p.to_array());
        Some(json!({ "points": points, "positions": positions, "distortion": place.distortion }).to_string())
    }

    /// Linear RGB, chosen by eye.
    fn palette(&self) -> Palette {
        let light = Palette {
            surface: [0.60, 0.56, 0.50],
            under: [0.26, 0.27, 0.29],
            line: [0.62, 0.16, 0.01],
            pattern: [[0.80, 0.76, 0.68], [0.10, 0.19, 0.32]],
            rim: [1.0, 1.0, 1.0],
        };
        let dark = Palette {
            surface: [0.50, 0.47, 0.42],
            line: [0.95, 0.42, 0.05],
            rim: [0.93, 0.93, 0.93],
            ..light
        };
        if self.style.dark { dark } else { light }
    }

    /// Pins, hidden ones below and raised ones on top, then the rings of a place that is asked for.
    fn pins(&self, k: usize) -> Vec<PinInstance> {
        let side = self.side(k);
        let pose = side.pose(self.now);
        // In another shape nothing is where it was.
        let still = !self.is_morphed(k);
        let is_shown = |mark: &&Landmark| still && (self.style.markers || mark.pin.stand == Stand::Ghost);
        let shown = side.landmarks.iter().flatten().filter(is_shown);
        let mut pins: Vec<(bool, f32, PinInstance)> = shown
            .map(|Landmark { pin, .. }| {
                let hidden = side.is_hidden(pin.base, pose);
                let nearness = (pin.base - pose.eye()).dot(pose.back());
                (hidden, nearness, pin.instance(hidden, self.pixel_ratio))
            })
            .collect();
        pins.sort_by(|a, b| {
            let rank = |p: &(bool, f32, PinInstance)| (!p.0, p.2.radius.to_bits());
            rank(a).cmp(&rank(b)).then(a.1.total_cmp(&b.1))
        });
        let ring = self.ring(k).map(|place| PinInstance {
            base: place.to_array(),
            colour: [0.02, 0.02, 0.02],
            radius: 8.0 * self.pixel_ratio,
            stem: 0.0,
            kind: 2.0,
        });
        pins.into_iter().map(|(_, _, pin)| pin).chain(ring).collect()
    }

    /// Cones in red (positive) and blue (negative curvature).
    fn balls(&self, k: usize) -> Vec<MarkerInstance> {
        let ball = |Landmark { pin, cone }: &Landmark| {
            let curvature = *cone.as_ref()?;
            // A ball's radius is 0.012 to 0.03 of the surface's and grows with the root of the curvature.
            let size = (curvature.abs() as f32 / std::f32::consts::TAU).min(1.0).sqrt();
            let colour = if curvature >= 0.0 { [0.78, 0.04, 0.03] } else { [0.03, 0.16, 0.80] };
            Some(MarkerInstance { centre: pin.base.to_array(), radius: 0.012 + 0.018 * size, colour })
        };
        let is_shown = self.style.cones && !self.is_morphed(k);
        self.side(k).landmarks.iter().flatten().filter(|_| is_shown).filter_map(ball).collect()
    }
}

fn point(p: [f32; 3]) -> DVec3 {
    Vec3::from_array(p).as_dvec3()
}

fn parsed<T: DeserializeOwned>(code: &str, json: &str) -> Result<T, JsValue> {
    serde_json::from_str(json).map_err(|e| failure(code, e))
}

/// The variant of an enumeration by its name.
fn named<T: DeserializeOwned>(code: &str, name: &str) -> Result<T, JsValue> {
    serde_json::from_value(json!(name)).map_err(|e| failure(code, e))
}

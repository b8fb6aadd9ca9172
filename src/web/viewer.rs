//! The two views.

use super::failure;
use super::files::LoadedMesh;
use crate::gpu::{Clear, Mesh, Renderer, ViewDraw};
use crate::io::landmark_file::LandmarkPoint;
use crate::mesh::check::CheckedMesh;
use crate::mesh::{FaceId, SurfacePoint};
use crate::scene::buffers::{Frame, landmark_colour, ribbons, surface};
use crate::scene::{Camera, MarkerInstance, Picker, Ray, SurfaceVertex};
use glam::{DVec3, Vec2, Vec3};
use serde::Deserialize;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// The colour of landmark `k` in the views, linear RGB from 0 to 1.
#[wasm_bindgen(js_name = landmarkColour)]
pub fn colour_of_landmark(k: usize) -> Vec<f32> {
    landmark_colour(k).to_vec()
}

/// What the page wants to see.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Style {
    surface: String,
    patch_lines: bool,
    cones: bool,
    markers: bool,
    #[serde(default)]
    dark: bool,
    /// Whether parts of the surfaces may be unmapped: the plain meshes are drawn behind.
    #[serde(default)]
    holes: bool,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            surface: "checkerboard".into(),
            patch_lines: true,
            cones: true,
            markers: true,
            dark: false,
            holes: false,
        }
    }
}

/// Who chose where a camera stands.
#[derive(Clone, Copy, Default, PartialEq)]
enum Look {
    /// Nobody yet: the whole mesh stays in view, also when the window changes.
    #[default]
    Whole,
    /// The user.
    Chosen,
}

/// One view with its mesh.
#[derive(Default)]
struct Side {
    look: Look,
    rectangle: [f32; 4],
    camera: Camera,
    mesh: Option<SideMesh>,
    result: Option<SideResult>,
    /// Landmarks in pair order; `None` where not picked yet.
    landmarks: Vec<Option<Vec3>>,
    /// Points that the page marks itself.
    suggestions: Vec<Option<Vec3>>,
}

struct SideMesh {
    checked: CheckedMesh,
    frame: Frame,
    picker: Option<Picker>,
    surface: Mesh,
}

struct SideResult {
    surface: Mesh,
    lines: Mesh,
    cones: Vec<f64>,
}

/// A canvas with two views, source (0) and target (1).
#[wasm_bindgen]
pub struct Viewer {
    renderer: Renderer,
    sides: [Side; 2],
    style: Style,
    pixel_ratio: f32,
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
        Ok(Self { renderer, sides: Default::default(), style: Style::default(), pixel_ratio: 1.0 })
    }

    /// Follows the canvas, in physical pixels.
    pub fn resize(&mut self, width: u32, height: u32, pixel_ratio: f32) {
        self.renderer.resize(width, height);
        self.pixel_ratio = pixel_ratio;
    }

    /// Where a view is, in physical pixels from the top left.
    #[wasm_bindgen(js_name = setViewport)]
    pub fn set_viewport(&mut self, side: usize, x: f32, y: f32, width: f32, height: f32) {
        let side = &mut self.sides[side.min(1)];
        let rectangle = [x, y, width, height];
        if side.rectangle != rectangle {
            side.rectangle = rectangle;
            if side.look == Look::Whole {
                side.look_at_all();
            }
        }
    }

    /// Shows a mesh; its landmarks and result go.
    #[wasm_bindgen(js_name = setMesh)]
    pub fn set_mesh(&mut self, side: usize, mesh: &LoadedMesh) {
        let checked = mesh.checked.clone();
        let frame = Frame::of(&checked.mesh);
        let (vertices, indices) = surface(&checked.mesh, &frame);
        let uploaded = self.renderer.surface_mesh(&vertices, &indices);
        let picker = Picker::new(&checked.mesh);
        let side = &mut self.sides[side.min(1)];
        side.mesh = Some(SideMesh { checked, frame, picker, surface: uploaded });
        side.result = None;
        side.landmarks.clear();
        side.suggestions.clear();
        side.look_at_all();
    }

    /// Empties a view.
    #[wasm_bindgen(js_name = clearMesh)]
    pub fn clear_mesh(&mut self, side: usize) {
        let side = &mut self.sides[side.min(1)];
        side.mesh = None;
        side.result = None;
        side.landmarks.clear();
        side.suggestions.clear();
    }

    /// Shows landmarks: a JSON array, in pair order, of landmark points or null.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = setLandmarks)]
    pub fn set_landmarks(&mut self, side: usize, points: &str) -> Result<(), JsValue> {
        let side = &mut self.sides[side.min(1)];
        side.landmarks = side.placed(points)?;
        Ok(())
    }

    /// Takes suggested points, likewise; they are not drawn, see [`Viewer::suggestions`].
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = setSuggestions)]
    pub fn set_suggestions(&mut self, side: usize, points: &str) -> Result<(), JsValue> {
        let side = &mut self.sides[side.min(1)];
        side.suggestions = side.placed(points)?;
        Ok(())
    }

    /// Shows a result on one side. `distortion` has a number by vertex, or none.
    #[wasm_bindgen(js_name = setResult)]
    #[allow(clippy::too_many_arguments, reason = "typed arrays cannot be bundled")]
    pub fn set_result(
        &mut self,
        side: usize,
        positions: &[f32],
        normals: &[f32],
        uvs: &[f32],
        distortion: &[f32],
        triangles: &[u32],
        line_points: &[f32],
        line_starts: &[u32],
        cones: &[f64],
    ) {
        let side = &mut self.sides[side.min(1)];
        let Some(mesh) = &side.mesh else { return };
        let place = |p: &[f32]| mesh.frame.place(DVec3::new(p[0].into(), p[1].into(), p[2].into()));
        let corners = positions.chunks_exact(3).zip(normals.chunks_exact(3)).zip(uvs.chunks_exact(2));
        let vertices: Vec<SurfaceVertex> = corners
            .enumerate()
            .map(|(k, ((p, n), uv))| SurfaceVertex {
                position: place(p).to_array(),
                normal: [n[0], n[1], n[2]],
                uv: [uv[0], uv[1]],
                distortion: distortion.get(k).copied().unwrap_or(1.0),
            })
            .collect();
        let points: Vec<Vec3> = line_points.chunks_exact(3).map(place).collect();
        let strips: Vec<Vec<Vec3>> = line_starts
            .windows(2)
            .filter_map(|w| points.get(w[0] as usize..w[1] as usize).map(<[Vec3]>::to_vec))
            .collect();
        let (line_vertices, line_indices) = ribbons(&strips);
        side.result = Some(SideResult {
            surface: self.renderer.surface_mesh(&vertices, triangles),
            lines: self.renderer.line_mesh(&line_vertices, &line_indices),
            cones: cones.to_vec(),
        });
    }

    /// Shows the plain meshes again.
    #[wasm_bindgen(js_name = clearResult)]
    pub fn clear_result(&mut self) {
        self.sides.iter_mut().for_each(|side| side.result = None);
    }

    /// What to show: JSON `{"surface", "patchLines", "cones", "markers", "dark"?, "holes"?}`.
    ///
    /// # Errors
    /// `{"code": "style", "message"}`.
    #[wasm_bindgen(js_name = setStyle)]
    pub fn set_style(&mut self, style: &str) -> Result<(), JsValue> {
        self.style = serde_json::from_str(style).map_err(|e| failure("style", e))?;
        Ok(())
    }

    /// Turns a view by a drag in units of its height.
    pub fn orbit(&mut self, side: usize, dx: f32, dy: f32) {
        // Screen y grows upwards here: dragging up looks from below.
        self.moved(side).orbit(Vec2::new(dx, -dy));
    }

    /// Moves a view by a drag in units of its height, y up.
    pub fn pan(&mut self, side: usize, dx: f32, dy: f32) {
        self.moved(side).pan(Vec2::new(dx, -dy));
    }

    /// Multiplies a view's distance.
    pub fn zoom(&mut self, side: usize, factor: f32) {
        self.moved(side).zoom(factor);
    }

    /// Back to the first look.
    #[wasm_bindgen(js_name = resetCamera)]
    pub fn reset_camera(&mut self, side: usize) {
        self.sides[side.min(1)].look_at_all();
    }

    /// Where a camera stands, for [`Viewer::set_camera`]; empty before the user has moved it.
    pub fn camera(&self, side: usize) -> Vec<f32> {
        let side = &self.sides[side.min(1)];
        let Camera { yaw, pitch, distance, target } = side.camera;
        match side.look {
            Look::Whole => Vec::new(),
            Look::Chosen => vec![yaw, pitch, distance, target.x, target.y, target.z],
        }
    }

    /// Puts a camera where another viewer's stood.
    #[wasm_bindgen(js_name = setCamera)]
    pub fn set_camera(&mut self, side: usize, place: &[f32]) {
        if let [yaw, pitch, distance, x, y, z] = *place {
            *self.moved(side) = Camera { yaw, pitch, distance, target: Vec3::new(x, y, z) };
        }
    }

    /// The surface point at a place of a view, x and y from -1 to 1, y up: JSON `{"face", "barycentric"}`.
    pub fn pick(&self, side: usize, x: f32, y: f32) -> Option<String> {
        let side = &self.sides[side.min(1)];
        let mesh = side.mesh.as_ref()?;
        let Ray { origin, direction } = side.camera.ray(Vec2::new(x, y), side.aspect());
        let from = mesh.frame.unplace(origin);
        let along = (mesh.frame.unplace(origin + direction) - from).normalize();
        let hit = mesh.picker.as_ref()?.pick(&mesh.checked.mesh, from, along)?;
        let hit = mesh.checked.with_file_corners(hit);
        Some(json!({ "face": hit.face.0, "barycentric": hit.barycentric }).to_string())
    }

    /// For each landmark x and y from -1 to 1, y up, and whether the number should be shown (1) or hides behind the
    /// surface (0).
    pub fn labels(&self, side: usize) -> Vec<f32> {
        let side = &self.sides[side.min(1)];
        side.landmarks.iter().flat_map(|p| side.label(*p)).collect()
    }

    /// Where the suggested points are, as [`Viewer::labels`].
    pub fn suggestions(&self, side: usize) -> Vec<f32> {
        let side = &self.sides[side.min(1)];
        side.suggestions.iter().flat_map(|p| side.label(*p)).collect()
    }

    /// Draws a frame.
    pub fn render(&mut self) {
        // Colours are linear RGB, chosen by eye; widths are in pixels of the page.
        let background = if self.style.dark { [0.011, 0.013, 0.018] } else { [0.84, 0.86, 0.88] };
        let balls = [0, 1].map(|k: usize| self.balls(&self.sides[k]));
        let style = &self.style;
        let ratio = self.pixel_ratio;
        let view = |k: usize| {
            let side: &Side = &self.sides[k];
            let result = side.result.as_ref();
            let plain = side.mesh.as_ref().map(|m| &m.surface);
            let textured = match style.surface.as_str() {
                "checkerboard" => 1.0,
                "colours" => 2.0,
                "distortion" => 3.0,
                _ => 0.0,
            };
            ViewDraw {
                rectangle: side.rectangle,
                camera: &side.camera,
                style: if result.is_some() { textured } else { 0.0 },
                surface_colour: [0.55, 0.57, 0.60],
                line_colour: [0.95, 0.42, 0.05],
                line_half_width: 0.9 * ratio,
                surface: result.map(|r| &r.surface).or(plain),
                under: plain.filter(|_| style.holes && result.is_some()),
                under_colour: [0.26, 0.27, 0.29],
                lines: result.map(|r| &r.lines).filter(|_| style.patch_lines),
                balls: &balls[k],
            }
        };
        let views = [view(0), view(1)];
        self.renderer.draw(Clear(background), &views);
    }
}

impl Viewer {
    /// The camera of a side that the user moves.
    fn moved(&mut self, side: usize) -> &mut Camera {
        let side = &mut self.sides[side.min(1)];
        side.look = Look::Chosen;
        &mut side.camera
    }

    /// Landmarks in their colours, or cones in red (positive) and blue (negative curvature).
    fn balls(&self, side: &Side) -> Vec<MarkerInstance> {
        let cones = side.result.as_ref().filter(|_| self.style.cones).map(|r| &r.cones);
        let ball = |(k, p): (usize, &Option<Vec3>)| {
            let centre = (*p)?.to_array();
            match cones.and_then(|c| c.get(k)) {
                Some(curvature) => {
                    // A ball's radius is 0.014 to 0.036 of the surface's and grows with the root of the curvature.
                    let size = (curvature.abs() as f32 / std::f32::consts::TAU).min(1.0).sqrt();
                    let colour = if *curvature >= 0.0 { [0.78, 0.04, 0.03] } else { [0.03, 0.16, 0.80] };
                    Some(MarkerInstance { centre, radius: 0.014 + 0.022 * size, colour })
                }
                None if self.style.markers => {
                    Some(MarkerInstance { centre, radius: 0.02, colour: landmark_colour(k) })
                }
                None => None,
            }
        };
        side.landmarks.iter().enumerate().filter_map(ball).collect()
    }
}

impl Side {
    /// The places of a JSON array of landmark points or null.
    fn placed(&self, points: &str) -> Result<Vec<Option<Vec3>>, JsValue> {
        let points: Vec<Option<LandmarkPoint>> =
            serde_json::from_str(points).map_err(|e| failure("landmarks", e))?;
        let Some(mesh) = &self.mesh else { return Ok(Vec::new()) };
        let place = |p: Option<LandmarkPoint>| Some(mesh.frame.place(mesh.position(p?)?));
        Ok(points.into_iter().map(place).collect())
    }

    /// The first look: the whole mesh, as large as the view allows.
    fn look_at_all(&mut self) {
        self.camera = Camera::default();
        self.look = Look::Whole;
        let Some(mesh) = &self.mesh else { return };
        let positions = mesh.checked.mesh.positions();
        // Some 2000 points tell the size of a mesh well enough; 0.82 leaves a margin around it.
        let stride = positions.len() / 2000 + 1;
        let points: Vec<Vec3> = positions.iter().step_by(stride).map(|p| mesh.frame.place(*p)).collect();
        self.camera.fit(&points, self.aspect(), 0.82);
    }

    fn aspect(&self) -> f32 {
        if self.rectangle[3] < 1.0 { 1.0 } else { (self.rectangle[2] / self.rectangle[3]).max(0.05) }
    }

    fn label(&self, landmark: Option<Vec3>) -> [f32; 3] {
        let seen = landmark.and_then(|p| Some((p, self.camera.project(p, self.aspect())?)));
        let Some((p, at)) = seen else { return [0.0; 3] };
        [at.x, at.y, if self.is_hidden(p) { 0.0 } else { 1.0 }]
    }

    /// Whether the surface is well in front of a point.
    fn is_hidden(&self, p: Vec3) -> bool {
        let Some(mesh) = &self.mesh else { return true };
        let (eye, at) = (mesh.frame.unplace(self.camera.eye()), mesh.frame.unplace(p));
        let hit = mesh
            .picker
            .as_ref()
            .and_then(|picker| picker.pick(&mesh.checked.mesh, eye, (at - eye).normalize()));
        let distance = eye.distance(at);
        // 1 % of the distance: no point is hidden by its own face.
        hit.is_some_and(|h| h.position(&mesh.checked.mesh).distance(eye) < distance - 0.01 * distance)
    }
}

impl SideMesh {
    fn position(&self, point: LandmarkPoint) -> Option<DVec3> {
        let mesh = &self.checked.mesh;
        match point {
            LandmarkPoint::Vertex(v) => {
                let known = self.checked.vertex_from_file.get(v as usize).copied().flatten();
                known.map(|v| mesh.positions()[v])
            }
            LandmarkPoint::OnFace { face, barycentric } => {
                let inside = (face as usize) < mesh.face_count();
                let point = SurfacePoint { face: FaceId(face), barycentric };
                inside.then(|| self.checked.with_file_corners(point).position(mesh))
            }
        }
    }
}

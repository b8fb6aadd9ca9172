//! One of the two views: its mesh, its camera, and what is marked on it.

use super::defects::MeshDefects;
use super::failure;
use super::loaded_mesh::{LoadedMesh, surface_point};
use crate::gpu::{Mesh, Picture, Renderer};
use crate::io::landmark_file::LandmarkPoint;
use crate::landmark_suggestion::MirrorPlane;
use crate::mesh::check::CheckedMesh;
use crate::mesh::dressing::{Giver, dressed};
use crate::mesh::normals::vertex_normals;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::scene::buffers::{Frame, Triangles, surface};
use crate::scene::circles::circled;
use crate::scene::colours::landmark_colour;
use crate::scene::defects::{DefectBuffers, painted, surface_as_read};
use crate::scene::hollows::carried;
use crate::scene::looks::drawn;
use crate::scene::pins::{Pin, STEM, Stand, distance_to_pin};
use crate::scene::{Camera, Glide, Patches, Picker, PinInstance, Pose, Ray, Shading, SurfaceVertex, UpAxis};
use glam::{DVec3, Vec2, Vec3};
use rustc_hash::FxHashMap;
use serde::Deserialize;
use serde_json::json;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// Share of the view that a mesh fills at first.
const SHARE: f32 = 0.82;

/// Who chose where a camera stands.
#[derive(Clone, Copy, Default, PartialEq)]
pub(super) enum Look {
    /// Nobody yet: the whole mesh stays in view, also when the window changes.
    #[default]
    Whole,
    /// The user.
    Chosen,
}

/// A landmark as the page tells it.
#[derive(Deserialize)]
struct Mark {
    point: LandmarkPoint,
    colour: usize,
    stand: Stand,
    /// Curvature of its cone, in radians.
    cone: Option<f64>,
}

/// A landmark with its cone.
#[derive(Clone, Copy)]
pub(super) struct Landmark {
    pub pin: Pin,
    pub cone: Option<f64>,
}

/// One view.
#[derive(Default)]
pub(super) struct Side {
    pub look: Look,
    pub rectangle: [f32; 4],
    pub camera: Camera,
    pub glide: Option<Glide>,
    pub mesh: Option<SideMesh>,
    /// The map's own triangles on this side.
    pub overlay: Option<Mesh>,
    /// The map's triangles in the look of the mesh that gives its look.
    pub carried: Option<Mesh>,
    /// The pictures that are laid on the mesh by its look; `None` where a picture has not come.
    pub pictures: Vec<Option<Picture>>,
    pub lines: Option<Mesh>,
    /// The seams of the texture that the map carries.
    pub seams: Option<Mesh>,
    /// The mesh with the places to which a map that is being made takes its vertices.
    pub preview: Option<Preview>,
    /// The patches of the result, where they are asked for.
    pub patches: Option<Patches>,
    /// The patches and patch lines that are lit up.
    pub lit: Lit,
    /// The mesh in colours of a flow, while one is shown.
    pub factors: Option<Factors>,
    /// The mesh on its way to its landmarks, while that is shown.
    pub stage: Option<CoarseStage>,
    /// The landmarks in the order of the pairs; `None` where a point is not picked yet.
    pub landmarks: Vec<Option<Landmark>>,
    /// Points that the page marks itself.
    pub suggestions: Vec<Option<Vec3>>,
    /// A place that is asked for, or its partner.
    pub probe: Option<Vec3>,
    /// The plane that mirrors the mesh, while it is shown.
    pub mirror: Option<ShownMirror>,
    /// The defects of a mesh, which may be one that is shown in the place of the side's own.
    pub defects: Option<ShownDefects>,
    /// The camera on the side's own mesh before another one was shown in its place.
    covered: Option<Covered>,
}

/// A mesh that shows a map in the making.
pub(super) struct Preview {
    drawn: Triangles<SurfaceVertex>,
    pub mesh: Mesh,
}

impl Preview {
    /// A mesh with the places of its first vertices on the target, in the target's scene coordinates; what the last preview of the same
    /// mesh has made is used again.
    pub fn new(last: Option<Self>, own: &SideMesh, places: &[Vec3], renderer: &Renderer) -> Self {
        let mut drawn = match last {
            Some(last) => last.drawn,
            None => surface(&own.checked.mesh, &own.shading, &own.frame),
        };
        drawn.vertices.iter_mut().zip(places).for_each(|(vertex, place)| vertex.image = place.to_array());
        Self { mesh: renderer.surface_mesh(&drawn.vertices, &drawn.indices), drawn }
    }
}

/// A plane that mirrors a mesh, with the line in which it cuts the surface; `None` where it cuts none.
pub(super) struct ShownMirror {
    pub plane: MirrorPlane,
    pub line: Option<Mesh>,
}

/// A mesh after some of its collapses to its landmarks.
pub(super) struct CoarseStage {
    pub surface: Mesh,
    /// The edges of the mesh; `None` where they would lie too close to be told apart.
    pub edges: Option<Mesh>,
    /// The way of a vertex to its landmark, where one is shown.
    pub trail: Option<Mesh>,
}

/// A mesh in colours of factors of length.
pub(super) struct Factors {
    drawn: Triangles<SurfaceVertex>,
    pub mesh: Mesh,
    /// The circles of a packing, drawn in its place while they are shown.
    pub circles: Option<Mesh>,
}

impl Factors {
    /// A mesh with two places on the scale of factors for each vertex, between which it is shown; what the last one of the same mesh has
    /// made is used again.
    pub fn new(last: Option<Self>, own: &SideMesh, places: [&[f32]; 2], renderer: &Renderer) -> Self {
        let mut drawn = match last {
            Some(last) => last.drawn,
            None => surface(&own.checked.mesh, &own.shading, &own.frame),
        };
        let uvs = places[0].iter().zip(places[1]).map(|(from, to)| [*from, *to]);
        drawn.vertices.iter_mut().zip(uvs).for_each(|(vertex, uv)| vertex.uv = uv);
        Self { mesh: renderer.surface_mesh(&drawn.vertices, &drawn.indices), drawn, circles: None }
    }

    /// Draws circles around the vertices, of these radii in units of the root of the mesh's area, at a share of the way from the first places
    /// to the second.
    pub fn draw_circles(&mut self, radii: &[f32], share: f32, renderer: &Renderer) {
        let place = |vertex: &SurfaceVertex| vertex.uv[0] + share * (vertex.uv[1] - vertex.uv[0]);
        let places: Vec<f32> = self.drawn.vertices.iter().map(place).collect();
        let corners = circled(&self.drawn.vertices, self.drawn.indices.as_chunks().0, &places, radii);
        let indices: Vec<u32> = (0..corners.len() as u32).collect();
        self.circles = Some(renderer.surface_mesh(&corners, &indices));
    }

    /// The place on the scale at a point of the mesh, this share of the way from the first places to the second.
    pub fn at(&self, mesh: &SurfaceMesh, point: SurfacePoint, share: f32) -> f64 {
        let value = |v: VertexId| {
            let [from, to] = self.drawn.vertices[v.index()].uv;
            f64::from(from + share * (to - from))
        };
        let corners = mesh.triangles()[point.face].map(value);
        corners.iter().zip(point.barycentric).map(|(value, weight)| value * weight).sum()
    }
}

/// Parts of a map that are lit up on a mesh.
#[derive(Default)]
pub(super) struct Lit {
    pub surface: Option<Mesh>,
    pub lines: Option<Mesh>,
}

/// The camera on a mesh that another one covers.
#[derive(Clone, Copy)]
struct Covered {
    camera: Camera,
    look: Look,
}

/// The defects of a mesh, to be drawn.
pub(super) struct ShownDefects {
    pub frame: Frame,
    /// The mesh as read, where it is shown in the place of the side's own.
    surface: Option<RefusedSurface>,
    /// Painted faces.
    pub painted: Option<Mesh>,
    pub lines: Option<Mesh>,
    /// At one physical pixel per pixel of the page.
    pub signs: Vec<PinInstance>,
}

/// A mesh that was refused.
struct RefusedSurface {
    mesh: Mesh,
    /// Some of its points, by which its size is measured.
    points: Vec<Vec3>,
}

/// A mesh that is shown.
pub(super) struct SideMesh {
    pub checked: Rc<CheckedMesh>,
    shading: Rc<Shading>,
    pub frame: Frame,
    pub picker: Option<Picker>,
    pub surface: Mesh,
    pub look: Option<Rc<crate::mesh::look::Look>>,
    /// The mesh in its own look.
    pub dressed: Option<Mesh>,
}

impl Side {
    /// The pose of the camera at a time, in milliseconds.
    pub fn pose(&self, now: f64) -> Pose {
        let end = self.camera.pose();
        self.glide.map_or(end, |glide| glide.at(now, end))
    }

    /// The camera, which the user moves.
    pub fn moved(&mut self) -> &mut Camera {
        self.look = Look::Chosen;
        &mut self.camera
    }

    /// Width by height.
    pub fn aspect(&self) -> f32 {
        if self.rectangle[3] < 1.0 { 1.0 } else { (self.rectangle[2] / self.rectangle[3]).max(0.05) }
    }

    /// Moves the camera, which keeps its direction, so that the whole mesh is seen as large as the view allows.
    pub fn fit(&mut self) {
        self.look = Look::Whole;
        let aspect = self.aspect();
        if let Some(RefusedSurface { points, .. }) = self.refused_surface() {
            let points = points.clone();
            self.camera.fit(&points, aspect, SHARE);
            return;
        }
        let Some(mesh) = &self.mesh else { return };
        let positions = mesh.checked.mesh.positions();
        let points: Vec<Vec3> =
            positions.iter().step_by(stride(positions.len())).map(|p| mesh.frame.place(*p)).collect();
        self.camera.fit(&points, aspect, SHARE);
    }

    fn refused_surface(&self) -> Option<&RefusedSurface> {
        self.defects.as_ref()?.surface.as_ref()
    }

    /// The mesh that is shown in the place of the side's own.
    pub fn refused(&self) -> Option<&Mesh> {
        Some(&self.refused_surface()?.mesh)
    }

    /// Whether there is such a mesh.
    pub fn is_covered(&self) -> bool {
        self.refused_surface().is_some()
    }

    /// Shows a mesh that was refused in the place of the side's own.
    pub fn cover(&mut self, defects: ShownDefects, up: UpAxis) {
        if !self.is_covered() {
            self.covered = Some(Covered { camera: self.camera, look: self.look });
        }
        self.defects = Some(defects);
        self.probe = None;
        self.glide = None;
        self.camera.set_up(up);
        self.first_look();
    }

    /// Shows the side's own mesh again, as it was looked at, without defects.
    pub fn uncover(&mut self) {
        self.defects = None;
        self.probe = None;
        if let Some(Covered { camera, look }) = self.covered.take() {
            (self.camera, self.look, self.glide) = (camera, look, None);
            if look == Look::Whole {
                self.fit();
            }
        }
    }

    /// The first look: the whole mesh from ahead and a little above.
    pub fn first_look(&mut self) {
        self.camera = Camera::first(self.camera.up);
        self.fit();
    }

    /// Whether the camera is as at the start: nobody has turned it or brought it elsewhere.
    pub fn is_first_look(&self) -> bool {
        let (Camera { yaw, pitch, roll, .. }, first) = (self.camera, Camera::first(self.camera.up));
        self.look == Look::Whole && (yaw, pitch, roll) == (first.yaw, first.pitch, first.roll)
    }

    /// Another axis points up; where the user has not moved the camera, the whole mesh stays in view. Nothing changes where the axis is up
    /// already.
    pub fn set_up(&mut self, up: UpAxis) {
        if self.camera.up == up {
            return;
        }
        self.camera.set_up(up);
        if self.look == Look::Whole {
            self.fit();
        }
    }

    /// Removes everything that is marked.
    pub fn clear_marks(&mut self) {
        self.landmarks.clear();
        self.suggestions.clear();
        self.mirror = None;
        self.probe = None;
    }

    /// Removes what a result has brought.
    pub fn clear_result(&mut self) {
        self.overlay = None;
        self.carried = None;
        self.lines = None;
        self.seams = None;
        self.patches = None;
        self.lit = Lit::default();
        self.factors = None;
        self.stage = None;
        self.probe = None;
    }

    /// Landmarks from a JSON array of marks or null.
    pub fn set_landmarks(&mut self, marks: &str) -> Result<(), JsValue> {
        let marks: Vec<Option<Mark>> = serde_json::from_str(marks).map_err(|e| failure("landmarks", e))?;
        let landmark = |mark: Option<Mark>| {
            let Mark { point, colour, stand, cone } = mark?;
            let pin = Pin { base: self.place_of(point)?, colour: landmark_colour(colour), stand };
            Some(Landmark { pin, cone })
        };
        self.landmarks = marks.into_iter().map(landmark).collect();
        Ok(())
    }

    /// Suggested points from a JSON array of landmark points or null.
    pub fn set_suggestions(&mut self, points: &str) -> Result<(), JsValue> {
        let points: Vec<Option<LandmarkPoint>> =
            serde_json::from_str(points).map_err(|e| failure("landmarks", e))?;
        self.suggestions = points.into_iter().map(|p| self.place_of(p?)).collect();
        Ok(())
    }

    /// The place of a landmark point, in scene coordinates; `None` where the mesh has no such point.
    pub fn place_of(&self, point: LandmarkPoint) -> Option<Vec3> {
        let mesh = self.mesh.as_ref()?;
        Some(mesh.frame.place(mesh.surface_point(point)?.position(&mesh.checked.mesh)))
    }

    /// The surface point seen at a place of the view, x and y from -1 to 1, y up.
    pub fn pick(&self, at: Vec2, now: f64) -> Option<SurfacePoint> {
        let mesh = self.mesh.as_ref().filter(|_| !self.is_covered())?;
        let (from, along) = mesh.ray(self.pose(now).ray(at, self.aspect()));
        mesh.picker.as_ref()?.pick(&mesh.checked.mesh, from, along)
    }

    /// Likewise its place in scene coordinates.
    pub fn pick_place(&self, at: Vec2, now: f64) -> Option<Vec3> {
        let mesh = self.mesh.as_ref()?;
        Some(mesh.frame.place(self.pick(at, now)?.position(&mesh.checked.mesh)))
    }

    /// Makes sure that the camera turns about a point that is seen: where the pivot has gone out of the view, it becomes the
    /// point in the middle.
    pub fn grab(&mut self, now: f64) {
        let seen = self.pose(now).project(self.camera.pivot, self.aspect());
        if seen.is_none_or(|p| p.truncate().abs().max_element() > 1.0)
            && let Some(place) = self.pick_place(Vec2::ZERO, now)
        {
            self.camera.pivot = place;
        }
    }

    /// Multiplies the distance to what is seen at a place of the view, which stays there.
    pub fn zoom_at(&mut self, at: Vec2, factor: f32, now: f64) {
        let pose = self.pose(now);
        let point = self.pick_place(at, now).unwrap_or_else(|| pose.in_target_plane(at, self.aspect()));
        self.moved().zoom_about(point, factor);
    }

    /// Turns the camera to a point of the mesh, whose normal then comes to the viewer.
    pub fn face(&mut self, point: LandmarkPoint) {
        let Some(mesh) = &self.mesh else { return };
        let Some(point) = mesh.surface_point(point) else { return };
        let surface = &mesh.checked.mesh;
        let normals = vertex_normals(surface);
        let corners = surface.triangles()[point.face];
        let normal: DVec3 = (0..3).map(|k| point.barycentric[k] * normals[corners[k]]).sum();
        let place = mesh.frame.place(point.position(surface));
        self.moved().face(place, normal.normalize_or(DVec3::Z).as_vec3());
    }

    /// The place where a pin stands.
    pub fn base(&self, pin: usize) -> Option<Vec3> {
        Some(self.landmarks.get(pin).copied().flatten()?.pin.base)
    }

    /// The point of the mesh that lies some pixels of the page beside a pin, x to the right and y up on the screen.
    pub fn beside(&self, pin: usize, by: Vec2, now: f64, pixel_ratio: f32) -> Option<SurfacePoint> {
        let base = self.base(pin)?;
        let pose = self.pose(now);
        let pixel = pose.height_at(base, self.aspect()) * pixel_ratio / self.rectangle[3].max(1.0);
        let moved = base + (pose.right() * by.x + pose.up() * by.y) * pixel;
        let mesh = self.mesh.as_ref()?;
        mesh.picker.as_ref()?.nearest(&mesh.checked.mesh, mesh.frame.unplace(moved))
    }

    /// The number of the pin under the pointer, among those that the body does not hide.
    pub fn pin_at(&self, at: Vec2, slack: f32, now: f64, pixel_ratio: f32) -> Option<usize> {
        let half = 0.5 * Vec2::new(self.rectangle[2], self.rectangle[3]) / pixel_ratio;
        let pose = self.pose(now);
        let distance = |landmark: &Option<Landmark>| {
            let base = (*landmark)?.pin.base;
            let seen = pose.project(base, self.aspect())?.truncate();
            distance_to_pin(seen * half, at * half, slack).filter(|_| !self.is_hidden(base, pose))
        };
        let found = self.landmarks.iter().enumerate().filter_map(|(k, mark)| Some((k, distance(mark)?)));
        found.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }

    /// The places of the heads of the pins: x and y from -1 to 1, y up, and 1 where the body does not hide the head.
    pub fn heads(&self, now: f64, pixel_ratio: f32) -> Vec<f32> {
        let stem = 2.0 * STEM * pixel_ratio / self.rectangle[3].max(1.0);
        let place = |mark: &Option<Landmark>| self.label(mark.map(|mark| mark.pin.base), stem, now);
        self.landmarks.iter().flat_map(place).collect()
    }

    /// The places of the suggested points, likewise.
    pub fn suggested(&self, now: f64) -> Vec<f32> {
        self.suggestions.iter().flat_map(|p| self.label(*p, 0.0, now)).collect()
    }

    fn label(&self, place: Option<Vec3>, above: f32, now: f64) -> [f32; 3] {
        let pose = self.pose(now);
        let seen = place.and_then(|p| Some((p, pose.project(p, self.aspect())?)));
        let Some((p, at)) = seen else { return [0.0; 3] };
        [at.x, at.y + above, if self.is_hidden(p, pose) { 0.0 } else { 1.0 }]
    }

    /// Whether the surface is well in front of a point.
    pub fn is_hidden(&self, p: Vec3, pose: Pose) -> bool {
        let Some(mesh) = &self.mesh else { return true };
        let (eye, at) = (mesh.frame.unplace(pose.eye()), mesh.frame.unplace(p));
        let hit = mesh
            .picker
            .as_ref()
            .and_then(|picker| picker.pick(&mesh.checked.mesh, eye, (at - eye).normalize()));
        let distance = eye.distance(at);
        // 1 % of the distance: no point is hidden by its own face.
        hit.is_some_and(|h| h.position(&mesh.checked.mesh).distance(eye) < distance - 0.01 * distance)
    }
}

/// The step at which points are taken to measure the size of a mesh: some 2000 of them tell it well enough.
fn stride(points: usize) -> usize {
    points / 2000 + 1
}

impl ShownDefects {
    /// The marks of these defects, drawn in a frame.
    pub fn new(found: &MeshDefects, frame: Frame, renderer: &Renderer) -> Self {
        let DefectBuffers { faces, lines, signs } = painted(&found.defects, &found.normals, &frame);
        Self {
            frame,
            surface: None,
            painted: (!faces.indices.is_empty())
                .then(|| renderer.surface_mesh(&faces.vertices, &faces.indices)),
            lines: (!lines.indices.is_empty())
                .then(|| renderer.marked_line_mesh(&lines.vertices, &lines.indices)),
            signs,
        }
    }

    /// The same marks with the mesh as it was read.
    #[must_use]
    pub fn with_surface(self, found: &MeshDefects, renderer: &Renderer) -> Self {
        let Triangles { vertices, indices } = surface_as_read(&found.defects, &found.normals, &self.frame);
        let corners = indices.iter().step_by(stride(indices.len()));
        let points = corners.map(|&v| Vec3::from_array(vertices[v as usize].position)).collect();
        let mesh = renderer.surface_mesh(&vertices, &indices);
        Self { surface: Some(RefusedSurface { mesh, points }), ..self }
    }
}

impl SideMesh {
    /// A mesh, with its vertices as they are drawn.
    pub fn new(loaded: &LoadedMesh, renderer: &Renderer) -> Self {
        let LoadedMesh { checked, shading, look, .. } = loaded;
        let frame = Frame::of(&checked.mesh);
        let Triangles { vertices, indices } = surface(&checked.mesh, shading, &frame);
        let surface = renderer.surface_mesh(&vertices, &indices);
        let dressed = look.as_deref().map(|look| {
            renderer.dressed_mesh(drawn(&dressed(Giver { mesh: &checked.mesh, look }), &vertices))
        });
        let picker = Picker::begun(&checked.mesh);
        let (checked, shading, look) = (checked.clone(), shading.clone(), look.clone());
        Self { checked, shading, frame, picker, surface, look, dressed }
    }

    /// Does the next part of what takes long for a large mesh; true where more is left.
    pub fn prepare(&mut self) -> bool {
        let Some(picker) = self.picker.as_mut().filter(|picker| !picker.is_ready()) else { return false };
        if picker.grow(&self.checked.mesh).is_none() {
            self.picker = None;
        }
        true
    }

    /// The degree to which points of a finer triangulation lie in hollows; `positions` are in input coordinates, three numbers a point.
    pub fn hollows_at(&self, positions: &[f32], triangles: &[u32]) -> Vec<f32> {
        let bits = |p: [f32; 3]| p.map(f32::to_bits);
        let places = self.checked.mesh.positions().iter().map(|p| bits(p.as_vec3().to_array()));
        let hollows: FxHashMap<[u32; 3], f32> = places.zip(self.shading.hollows.iter().copied()).collect();
        let (points, _) = positions.as_chunks();
        let known: Vec<Option<f32>> = points.iter().map(|p| hollows.get(&bits(*p)).copied()).collect();
        carried(&known, triangles)
    }

    /// A ray of the scene in input coordinates.
    pub fn ray(&self, Ray { origin, direction }: Ray) -> (DVec3, DVec3) {
        let from = self.frame.unplace(origin);
        (from, (self.frame.unplace(origin + direction) - from).normalize())
    }

    /// The point of the mesh that a landmark point names; `None` where there is none.
    pub fn surface_point(&self, point: LandmarkPoint) -> Option<SurfacePoint> {
        surface_point(&self.checked, point)
    }

    /// A point of the mesh as landmark files write it, as JSON; `None` in a cap, where no landmark can be.
    pub fn on_skin(&self, point: SurfacePoint) -> Option<String> {
        (!self.checked.is_cap(point.face)).then(|| self.in_file(point).to_string())
    }

    /// A point of the mesh as landmark files write it.
    pub fn in_file(&self, point: SurfacePoint) -> serde_json::Value {
        let point = self.checked.on_file(point);
        json!({ "face": point.face.0, "barycentric": point.barycentric })
    }
}

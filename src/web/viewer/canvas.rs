//! The canvas with two views: what is shown on each.

use super::super::loaded_mesh::LoadedMesh;
use super::super::view_side::{Look, Side, SideMesh};
use super::super::{failure, mesh_side};
use super::compared_map::ComparedMap;
use super::reading::parsed;
use crate::gpu::{Paint, Picture, Renderer, Scale, Texture, TextureKind};
use crate::landmarks::MeshSide;
use crate::scene::MapPicker;
use crate::scene::looks::Pixels;
use crate::scene::morph::PackedWay;
use glam::Mat4;
use serde::Deserialize;
use wasm_bindgen::prelude::*;

/// The choices of the page for the views.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Style {
    pub(super) surface: SurfaceStyle,
    pub(super) patch_lines: bool,
    #[serde(default)]
    pub(super) texture_boundary: bool,
    pub(super) cones: bool,
    pub(super) markers: bool,
    #[serde(default)]
    pub(super) dark: bool,
    /// Share of the source's view, from the left, in which the source is plain.
    #[serde(default)]
    pub(super) wipe: Option<f32>,
    pub(super) texture: TexturePlace,
    /// Whether parts of the surfaces may be unmapped: the plain meshes are drawn behind.
    #[serde(default)]
    pub(super) holes: bool,
    /// Whether parts of the surfaces of the map that is compared with may be unmapped.
    #[serde(default)]
    pub(super) compared_holes: bool,
}

/// The quantity that the surfaces' colours show.
#[derive(Clone, Copy, Default, Deserialize, PartialEq, tsify::Tsify)]
#[serde(rename_all = "lowercase")]
pub(super) enum SurfaceStyle {
    #[default]
    Shaded,
    Pattern,
    Colours,
    Checkerboard,
    Circles,
    Ribbons,
    Coordinates,
    Picture,
    /// A scale from little to much, by the places of the overlays' points on it.
    Rising,
    /// A scale from what shrinks to what grows, by the same places.
    Diverging,
    Look,
}

/// The place of a texture on the flat metric.
#[derive(Clone, Copy, Default, Deserialize)]
pub(super) struct TexturePlace {
    /// Cells to a unit of texture coordinates.
    cells: f32,
    /// Counter-clockwise, in degrees.
    turn: f32,
    /// Shifts in cells.
    x: f32,
    y: f32,
}

impl TexturePlace {
    fn of(self, kind: TextureKind) -> Paint {
        let (sine, cosine) = self.turn.to_radians().sin_cos();
        Paint::Texture(Texture { kind, cells: [self.cells * cosine, self.cells * sine, self.x, self.y] })
    }
}

impl Style {
    pub(super) fn paint(&self) -> Paint {
        match self.surface {
            SurfaceStyle::Shaded => Paint::Plain,
            SurfaceStyle::Pattern => Paint::Pattern,
            SurfaceStyle::Colours => Paint::Places,
            SurfaceStyle::Checkerboard => self.texture.of(TextureKind::Checkerboard),
            SurfaceStyle::Circles => self.texture.of(TextureKind::Circles),
            SurfaceStyle::Ribbons => self.texture.of(TextureKind::Ribbons),
            SurfaceStyle::Coordinates => self.texture.of(TextureKind::Coordinates),
            SurfaceStyle::Picture => self.texture.of(TextureKind::Picture),
            SurfaceStyle::Rising => Paint::Scale(Scale::Rising),
            SurfaceStyle::Diverging => Paint::Scale(Scale::Diverging),
            SurfaceStyle::Look => Paint::Look,
        }
    }
}

impl SurfaceStyle {
    /// Whether the target's own mesh can show it: what follows from the place on the target alone.
    pub(super) fn is_of_places(self) -> bool {
        matches!(self, Self::Pattern | Self::Colours)
    }
}

/// A canvas with two views, of the source and of the target. Times are in milliseconds, as the browser gives them to animations.
#[wasm_bindgen]
pub struct Viewer {
    pub(super) renderer: Renderer,
    pub(super) sides: [Side; 2],
    pub(super) style: Style,
    pub(super) map: Option<MapPicker>,
    /// Another map, which the second view shows on the source.
    pub(super) compared: Option<ComparedMap>,
    /// Share of the way from the source's shape to the target's.
    pub(super) morph: f32,
    /// Lays the target on the source, in scene coordinates.
    pub(super) source_from_target: Mat4,
    /// The offsets of the map's points from straight lines on that way, once they are known.
    pub(super) way: Option<PackedWay>,
    /// The place of the rings among the map's points: a triangle, and the shares of its corners.
    pub(super) probed: Option<([u32; 3], [f64; 3])>,
    /// Share of the way between the two moments of a flow that is shown.
    pub(super) factor_share: f32,
    /// The user's own picture on the flat metric.
    pub(super) texture: [Option<Picture>; 1],
    /// The mesh whose look the map carries.
    pub(super) look_giver: Option<MeshSide>,
    pub(super) pixel_ratio: f32,
    /// The time of the last frame.
    pub(super) now: f64,
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
            compared: None,
            morph: 0.0,
            source_from_target: Mat4::IDENTITY,
            way: None,
            probed: None,
            factor_share: 0.0,
            texture: [None],
            look_giver: None,
            pixel_ratio: 1.0,
            now: 0.0,
        })
    }

    /// Follows the canvas, in physical pixels.
    pub fn resize(&mut self, width: u32, height: u32, pixel_ratio: f32) {
        self.renderer.resize(width, height);
        self.pixel_ratio = pixel_ratio;
    }

    /// Sets the place of a view, in physical pixels from the top left.
    #[wasm_bindgen(js_name = setViewport)]
    pub fn set_viewport(
        &mut self,
        side: usize,
        x: f32,
        y: f32,
        width: f32,
        height: f32,
    ) -> Result<(), JsValue> {
        let side = &mut self.sides[mesh_side(side)?];
        let rectangle = [x, y, width, height];
        if side.rectangle != rectangle {
            side.rectangle = rectangle;
            if side.look == Look::Whole {
                side.fit();
            }
        }
        Ok(())
    }

    /// Shows a mesh; its landmarks and result go.
    #[wasm_bindgen(js_name = setMesh)]
    pub fn set_mesh(&mut self, side: usize, mesh: &LoadedMesh) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        let shown = SideMesh::new(mesh, &self.renderer);
        self.clear_result();
        let side = &mut self.sides[side];
        side.uncover();
        side.preview = None;
        side.pictures.clear();
        side.mesh = Some(shown);
        side.clear_marks();
        side.glide = None;
        side.first_look();
        Ok(())
    }

    /// Does a part of what a large mesh needs before it can be pointed at, for some milliseconds; true where more is left.
    pub fn prepare(&mut self) -> bool {
        self.sides.iter_mut().filter_map(|side| side.mesh.as_mut()).any(SideMesh::prepare)
    }

    /// Lays the picture of this number on a side's look: 8-bit colours with opacity, row by row from the top. One that cannot be drawn is
    /// left out.
    #[wasm_bindgen(js_name = setPicture)]
    pub fn set_picture(
        &mut self,
        side: usize,
        number: u8,
        width: u32,
        height: u32,
        pixels: Vec<u8>,
    ) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        let picture = self.renderer.picture(Pixels { width, height, bytes: pixels });
        let pictures = &mut self.sides[side].pictures;
        let count = pictures.len().max(usize::from(number) + 1);
        pictures.resize_with(count, || None);
        pictures[usize::from(number)] = picture;
        Ok(())
    }

    /// Takes the picture that the style `picture` lays on the flat metric, as [`Viewer::set_picture`] does.
    #[wasm_bindgen(js_name = setTexture)]
    pub fn set_texture(&mut self, width: u32, height: u32, pixels: Vec<u8>) {
        self.texture = [self.renderer.picture(Pixels { width, height, bytes: pixels })];
    }

    /// Empties a view.
    #[wasm_bindgen(js_name = clearMesh)]
    pub fn clear_mesh(&mut self, side: usize) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        self.clear_result();
        let side = &mut self.sides[side];
        if !side.is_covered() {
            side.defects = None;
        }
        side.preview = None;
        side.mesh = None;
        side.clear_marks();
        Ok(())
    }

    /// Shows landmarks: a JSON array, in pair order, of `{"point", "colour", "stand", "cone"}` or null: `colour` is the number
    /// that [`colour_of_landmark`] takes, `stand` is `plain`, `raised` or `ghost`, and `cone` the curvature of the landmark's cone
    /// in radians or null.
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = setLandmarks)]
    pub fn set_landmarks(&mut self, side: usize, marks: &str) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].set_landmarks(marks)
    }

    /// Takes suggested points, a JSON array of landmark points or null; they are not drawn, see [`Viewer::suggestions`].
    ///
    /// # Errors
    /// `{"code": "landmarks", "message"}`.
    #[wasm_bindgen(js_name = setSuggestions)]
    pub fn set_suggestions(&mut self, side: usize, points: &str) -> Result<(), JsValue> {
        self.sides[mesh_side(side)?].set_suggestions(points)
    }

    /// Sets the choices for the views: JSON `{"surface", "patchLines", "textureBoundary"?, "cones", "markers", "dark"?, "holes"?,
    /// "comparedHoles"?, "wipe"?, "texture"?}`; `texture` is `{"cells", "turn", "x", "y"}`, cells to a unit of texture coordinates, degrees
    /// and cells; with `wipe`, a share of the source's view, the source is plain from the left to there.
    ///
    /// # Errors
    /// `{"code": "style", "message"}`.
    #[wasm_bindgen(js_name = setStyle)]
    pub fn set_style(&mut self, style: &str) -> Result<(), JsValue> {
        self.style = parsed("style", style)?;
        Ok(())
    }

    /// For each landmark x and y of its head from -1 to 1, y up, and whether the number should be shown (1) or hides behind the
    /// surface (0).
    pub fn labels(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let side = mesh_side(side)?;
        Ok(self.shown(side, self.sides[side].heads(self.now, self.pixel_ratio)))
    }

    /// The places of the suggested points, as [`Viewer::labels`].
    pub fn suggestions(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let side = mesh_side(side)?;
        Ok(self.shown(side, self.sides[side].suggested(self.now)))
    }
}

impl Viewer {
    /// Whether a view shows its mesh on the way to the other shape.
    pub(super) fn is_morphed(&self, view: MeshSide) -> bool {
        let source = &self.sides[0];
        view == MeshSide::Source && self.morph > 0.0 && source.preview.is_none() && !source.is_covered()
    }

    /// Whether a view shows another shape than its mesh has: that, a mesh that was refused, or the other mesh.
    pub(super) fn shows_another_shape(&self, view: MeshSide) -> bool {
        self.is_morphed(view) || self.sides[view].is_covered() || self.side_in(view) != view
    }

    /// Places of marks, x, y and visible for each, of which none is seen while the shape is another one.
    pub(super) fn shown(&self, side: MeshSide, mut places: Vec<f32>) -> Vec<f32> {
        if self.shows_another_shape(side) {
            places.chunks_exact_mut(3).for_each(|place| place[2] = 0.0);
        }
        places
    }
}

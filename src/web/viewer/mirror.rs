//! Left and right: the planes that mirror the meshes, and what lies across from a point.

use super::super::mesh_side;
use super::super::plane_numbers::PlaneNumbers;
use super::super::view_side::{ShownMirror, Side};
use super::canvas::Viewer;
use super::reading::parsed;
use crate::landmark_suggestion::{Partner, partner};
use crate::mesh::SurfacePoint;
use crate::scene::buffers::Triangles;
use crate::scene::plane_cut::drawn;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// A pin that is nearer than this to what lies across from a point, in units of the root of the area, is taken to stand there.
/// Chosen by hand.
const SAME_PLACE: f64 = 0.03;

#[wasm_bindgen]
impl Viewer {
    /// Takes the plane that mirrors a side's mesh, JSON as `mirrorPlane` answers it, and shows where it cuts the surface; `null` for none.
    ///
    /// # Errors
    /// `{"code": "mirror", "message"}`.
    #[wasm_bindgen(js_name = setMirror)]
    pub fn set_mirror(&mut self, side: usize, plane: &str) -> Result<(), JsValue> {
        let numbers: Option<PlaneNumbers> = parsed("mirror", plane)?;
        let side = mesh_side(side)?;
        let mesh = self.sides[side].mesh.as_ref();
        let shown = numbers.and_then(|numbers| numbers.plane()).zip(mesh).map(|(plane, mesh)| {
            let Triangles { vertices, indices } = drawn(&mesh.checked.mesh, &mesh.frame, plane);
            let line = (!indices.is_empty()).then(|| self.renderer.marked_line_mesh(&vertices, &indices));
            ShownMirror { plane, line }
        });
        self.sides[side].mirror = shown;
        Ok(())
    }

    /// The point across the plane from a landmark point of a side, as JSON: `{"point", "distance", "near"}`; `point` is `null` where the
    /// given one lies on the midline, `distance` says how far off the surface the mirror image was, in units of the root of the area, and
    /// `near` is the number of the pin that stands there already or `null`. `undefined` without a plane, and where no landmark can be.
    pub fn across(&self, side: usize, point: &str) -> Result<Option<String>, JsValue> {
        Ok(across(&self.sides[mesh_side(side)?], point))
    }
}

fn across(side: &Side, point: &str) -> Option<String> {
    let mesh = side.mesh.as_ref()?;
    let point = mesh.surface_point(serde_json::from_str(point).ok()?)?;
    let picker = mesh.picker.as_ref()?;
    let surface = &mesh.checked.mesh;
    let nearest = |place, normal| picker.nearest_facing(surface, place, normal);
    match partner(surface, side.mirror.as_ref()?.plane, point, nearest)? {
        Partner::Itself => Some(json!({ "point": null, "distance": 0.0, "near": null }).to_string()),
        Partner::Across { point, .. } if mesh.checked.is_cap(point.face) => None,
        Partner::Across { point, distance } => {
            let near = pin_at_place(side, point);
            Some(json!({ "point": mesh.in_file(point), "distance": distance, "near": near }).to_string())
        }
    }
}

/// The number of the pin that stands at a point, if there is one.
fn pin_at_place(side: &Side, point: SurfacePoint) -> Option<usize> {
    let mesh = side.mesh.as_ref()?;
    let surface = &mesh.checked.mesh;
    let place = point.position(surface);
    let limit = SAME_PLACE * surface.area().sqrt();
    let pins = side.landmarks.iter().enumerate();
    let distances =
        pins.filter_map(|(k, mark)| Some((mesh.frame.unplace((*mark)?.pin.base).distance(place), k)));
    distances.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|nearest| nearest.0 <= limit).map(|nearest| nearest.1)
}

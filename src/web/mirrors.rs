//! The planes that mirror meshes.

use super::failure;
use super::loaded_mesh::{LoadedMesh, surface_point};
use crate::io::landmark_file::LandmarkPoint;
use crate::landmark_suggestion::{Mirror, MirrorPlane, best_mirror, mirror_of};
use crate::monitor::Silent;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

/// Which plane is wanted.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", tag = "kind")]
enum Wish {
    /// The best one.
    Found,
    /// That across an axis of the file, 0 to 2, through the middle of the surface.
    Axis { axis: usize },
    /// That between two points.
    Points { points: [LandmarkPoint; 2] },
}

/// A plane in the numbers of the mesh.
#[derive(Deserialize, Serialize)]
pub(super) struct PlaneNumbers {
    normal: [f64; 3],
    through: [f64; 3],
}

impl PlaneNumbers {
    /// The plane; `None` where the numbers are none.
    pub(super) fn plane(&self) -> Option<MirrorPlane> {
        MirrorPlane::across(self.normal.into(), self.through.into())
    }
}

/// What is answered.
#[derive(Serialize)]
struct Answer {
    plane: PlaneNumbers,
    misfit: f64,
    fits: bool,
}

fn wished(loaded: &LoadedMesh, wish: Wish) -> Option<Mirror> {
    let mesh = &loaded.checked.mesh;
    match wish {
        // Who has enough of it ends the worker.
        Wish::Found => best_mirror(mesh, &mut Silent).ok()?,
        Wish::Axis { axis } => {
            mirror_of(mesh, MirrorPlane::across(DVec3::AXES.get(axis).copied()?, mesh.centre()?)?)
        }
        Wish::Points { points: [p, q] } => {
            let place = |point| Some(surface_point(&loaded.checked, point)?.position(mesh));
            mirror_of(mesh, MirrorPlane::between([place(p)?, place(q)?])?)
        }
    }
}

/// A plane that mirrors a mesh: JSON `{"plane": {"normal", "through"}, "misfit", "fits"}` or `null` where there is none. `wish` is
/// `{"kind": "found"}`, `{"kind": "axis", "axis": 0 | 1 | 2}` or `{"kind": "points", "points": [point, point]}`; `misfit` is the mean distance
/// of the reflected surface from the surface in units of the root of its area.
///
/// # Errors
/// `{"code": "mirror", "message"}`.
#[wasm_bindgen(js_name = mirrorPlane)]
pub fn mirror_plane(loaded: &LoadedMesh, wish: &str) -> Result<String, JsValue> {
    let wish: Wish = serde_json::from_str(wish).map_err(|e| failure("mirror", e))?;
    let answer = wished(loaded, wish).map(|mirror| {
        let normal = mirror.plane.normal();
        let through = normal * -mirror.plane.height(DVec3::ZERO);
        let plane = PlaneNumbers { normal: normal.to_array(), through: through.to_array() };
        Answer { plane, misfit: mirror.misfit, fits: mirror.fits() }
    });
    serde_json::to_string(&answer).map_err(|e| failure("mirror", e))
}

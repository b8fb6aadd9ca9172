//! The planes that mirror meshes, and mirrored targets.

use super::failure;
use super::loaded_mesh::{LoadedMesh, surface_point};
use super::plane_numbers::PlaneNumbers;
use crate::export;
use crate::io::landmark_file::{self, LandmarkPoint};
use crate::landmark_suggestion::{Mirror, MirrorPlane, best_mirror, mirror_of};
use crate::mesh::mirror::mirrored;
use crate::mesh::{FaceId, SurfacePoint};
use crate::monitor::Silent;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

/// Which plane is wanted.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", tag = "kind", deny_unknown_fields)]
enum Wish {
    /// The plane that mirrors the mesh best.
    Found,
    /// The plane across an axis of the file, 0 to 2, through the middle of the surface.
    Axis { axis: usize },
    /// The plane half-way between two points.
    Points { points: [LandmarkPoint; 2] },
}

/// The answer of the search for a mirror plane.
#[derive(Serialize)]
struct Answer {
    plane: PlaneNumbers,
    misfit: f64,
    fits: bool,
}

fn wished(loaded: &LoadedMesh, wish: Wish) -> Option<Mirror> {
    let mesh = &loaded.checked.mesh;
    match wish {
        // Nothing asks this search to stop: the page ends its worker.
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
    let answer = wished(loaded, wish).map(|mirror| Answer {
        plane: PlaneNumbers::of(&mirror.plane),
        misfit: mirror.misfit,
        fits: mirror.fits(),
    });
    serde_json::to_string(&answer).map_err(|e| failure("mirror", e))
}

/// The mirror image of a target with the landmarks carried along.
#[wasm_bindgen]
pub struct MirroredTarget {
    mesh: Vec<u8>,
    landmarks: Vec<u8>,
}

#[wasm_bindgen]
impl MirroredTarget {
    /// The mirror image as OBJ.
    pub fn mesh(&self) -> Vec<u8> {
        self.mesh.clone()
    }

    /// The landmark file; nothing is said of a true map.
    pub fn landmarks(&self) -> Vec<u8> {
        self.landmarks.clone()
    }
}

/// Mirrors a target, for landmarks whose left and right are exchanged.
///
/// # Errors
/// `{"code": "landmarks" | "mesh", "message"}`.
#[wasm_bindgen(js_name = mirrorTarget)]
pub fn mirror_target(target: &LoadedMesh, landmarks: &[u8]) -> Result<MirroredTarget, JsValue> {
    let mut file = landmark_file::read(landmarks).map_err(|e| failure("landmarks", e))?;
    let mesh = mirrored(&target.checked.mesh).map_err(|e| failure("mesh", e))?;
    // The image's file has the checked mesh's vertices only, and its faces as they were turned.
    for [_, point] in &mut file.pairs {
        let on_mesh = match *point {
            LandmarkPoint::Vertex(v) => {
                let known = target.checked.numbered_vertex(v as usize);
                LandmarkPoint::Vertex(known.map_or(v, |v| v.0))
            }
            LandmarkPoint::OnFace { face, barycentric } => {
                let known = target.checked.face_from_file(FaceId(face));
                known.map_or(*point, |face| {
                    let on_mesh = target.checked.with_file_corners(SurfacePoint { face, barycentric });
                    LandmarkPoint::OnFace { face: face.0, barycentric: on_mesh.barycentric }
                })
            }
        };
        *point = on_mesh.mirrored();
    }
    file.ground_truth = None;
    Ok(MirroredTarget { mesh: export::obj::mesh(&mesh), landmarks: landmark_file::write(&file) })
}

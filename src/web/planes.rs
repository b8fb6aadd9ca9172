//! The flat cone metrics of both meshes in the plane, in a worker that stays while they are looked at.

use super::compute::{Messenger, RunListener, flat3};
use super::page_job::read_job;
use super::{failure, mesh_side};
use crate::job::{Job, JobError};
use crate::mesh::FaceId;
use crate::monitor::{PlannedStage, Stage};
use crate::pipeline::{FlatSurface, PipelineOptions, PlaneLayout};
use wasm_bindgen::prelude::*;

/// Both mapped meshes with their flat metrics: the checked meshes with landmarks inside faces as vertices. The plane's unit is such that
/// each mesh has area 1.
#[wasm_bindgen]
pub struct FlatPlanes {
    job: Job,
    surfaces: [FlatSurface; 2],
}

/// Runs the flows of both meshes with these curvatures of the landmarks' cones, in radians, as a finished map tells them.
///
/// # Errors
/// `{"code", "message"}` with the stage's code.
#[wasm_bindgen(js_name = flatPlanes)]
pub fn flat_planes(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    cones: &[f64],
    listener: &RunListener,
) -> Result<FlatPlanes, JsValue> {
    let mut messenger = Messenger::new(listener);
    let planned = |stage| PlannedStage { stage, time: 1.0 };
    messenger.plan(vec![planned(Stage::SourceConeMetric), planned(Stage::TargetConeMetric)]);
    let job = read_job([source, target], landmarks, &mut messenger)?;
    let failed = |error: JobError| failure(error.code(), error);
    let surfaces = job
        .flat_surfaces(cones, &PipelineOptions::default(), &mut messenger)
        .map_err(|error| failed(error.into()))?;
    Ok(FlatPlanes { job, surfaces })
}

#[wasm_bindgen]
impl FlatPlanes {
    /// Triangles of the mapped source (0) or target (1): three vertices each.
    pub fn triangles(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let mesh = self.job.mapped_meshes()[mesh_side(side)?];
        Ok(mesh.triangles().iter().flatten().map(|v| v.0).collect())
    }

    /// The positions of its vertices in the coordinates of the checked mesh, three numbers each.
    pub fn positions(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        Ok(flat3(&self.job.positions()[mesh_side(side)?]))
    }

    /// The face of the checked mesh that contains each triangle.
    #[wasm_bindgen(js_name = checkedFaces)]
    pub fn checked_faces(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        Ok(self.job.checked_faces()[mesh_side(side)?].iter().map(|f| f.0).collect())
    }

    /// The vertex of each landmark.
    #[wasm_bindgen(js_name = landmarkVertices)]
    pub fn landmark_vertices(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        Ok(self.job.landmark_vertices()[mesh_side(side)?].iter().map(|v| v.0).collect())
    }

    /// The radius of each vertex's circle, in units of the plane.
    pub fn radii(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        Ok(self.surfaces[mesh_side(side)?].radii().iter().map(|&r| r as f32).collect())
    }

    /// The layout of the source (0) or the target (1) grown from one of its triangles; from the first one where there is no such.
    pub fn grow(&self, side: usize, triangle: u32) -> Result<GrownPlane, JsValue> {
        let side = mesh_side(side)?;
        let mesh = self.job.mapped_meshes()[side];
        let seed = FaceId(if (triangle as usize) < mesh.face_count() { triangle } else { 0 });
        Ok(GrownPlane { layout: self.surfaces[side].grown_from(mesh, seed) })
    }
}

/// One mesh in the plane.
#[wasm_bindgen]
pub struct GrownPlane {
    layout: PlaneLayout,
}

#[wasm_bindgen]
impl GrownPlane {
    /// Places in the plane, two numbers each; a vertex on the cut has several.
    pub fn points(&self) -> Vec<f32> {
        self.layout.points.iter().flat_map(|p| [p.x as f32, p.y as f32]).collect()
    }

    /// The vertex at each of these places.
    pub fn vertices(&self) -> Vec<u32> {
        self.layout.vertices.iter().map(|v| v.0).collect()
    }

    /// The number of the place of each corner of each triangle.
    pub fn corners(&self) -> Vec<u32> {
        self.layout.corners.raw.clone()
    }

    /// The triangles in the order in which they were placed.
    pub fn order(&self) -> Vec<u32> {
        self.layout.order.iter().map(|f| f.0).collect()
    }

    /// Where each ring around the seed starts in that order, and one past the end.
    pub fn rings(&self) -> Vec<u32> {
        self.layout.rings.iter().map(|&ring| ring as u32).collect()
    }

    /// Whether the layout is cut along the edge from corner k to k + 1 of each triangle.
    pub fn cut(&self) -> Vec<u8> {
        self.layout.cut.iter().map(|&is_cut| u8::from(is_cut)).collect()
    }

    /// Triangles that lie turned over: straight edges of the mesh cross there in the flat metric.
    #[wasm_bindgen(js_name = turnedOver)]
    pub fn turned_over(&self) -> usize {
        self.layout.inverted_faces
    }
}

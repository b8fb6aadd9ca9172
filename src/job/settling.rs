//! Soft landmarks of a job, settled before the map is made.

use crate::io::landmark_file::{LandmarkFile, LandmarkPoint};
use crate::map_file::FileMesh;
use crate::mesh::SurfacePoint;
use crate::monitor::{Cancelled, Monitor, PlannedStage, Stage};
use crate::pipeline::PipelineOptions;
use crate::soft_landmarks::{SettlingInput, SettlingOptions, settle};
use serde::Serialize;

/// A soft landmark where it settled, stable as JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct SettledLandmark {
    /// The pair, 0-based.
    pub pair: usize,
    /// Its point on the target's file.
    #[cfg_attr(
        all(feature = "web", target_arch = "wasm32"),
        tsify(type = "number | { face: number; barycentric: [number, number, number] }")
    )]
    pub point: LandmarkPoint,
    /// The distance of this point from where the landmark was given, in units of the root of the target's area.
    pub moved: f64,
}

/// The usual time of settling, in per cent of the run after it: 100 to 170 on horse-horse05, cat-lion and horse-camel, with one soft
/// landmark or a third of them.
const SETTLING_TIME: f64 = 120.0;

/// The stages of reading these landmarks and of the run after it, in their order: where some are soft they settle after they are placed.
pub fn planned_stages(landmarks: &LandmarkFile, options: &PipelineOptions) -> Vec<PlannedStage> {
    let mut plan = options.stages(landmarks.pairs.len());
    if landmarks.radii.iter().flatten().any(|radius| *radius > 0.0) {
        let placed = plan.iter().take_while(|planned| planned.stage < Stage::Settling).count();
        plan.insert(placed, PlannedStage { stage: Stage::Settling, time: SETTLING_TIME });
    }
    plan
}

/// Moves the target's points of soft landmarks, both on the mesh (`points`, by landmark its points on source and target) and in the
/// landmark file, which has no radii from then on.
pub(super) fn settle_landmarks(
    meshes: [&FileMesh; 2],
    landmarks: &mut LandmarkFile,
    points: &mut [[SurfacePoint; 2]],
    monitor: &mut dyn Monitor,
) -> Result<Vec<SettledLandmark>, Cancelled> {
    let mut radii = landmarks.radii.take().unwrap_or_default();
    // Pairs that the program found come after those that were given, and are held.
    radii.resize(points.len(), 0.0);
    if radii.iter().all(|radius| *radius == 0.0) {
        return Ok(Vec::new());
    }
    monitor.enter(Stage::Settling);
    let target = meshes[1];
    let may_hold = |face| !target.checked().is_cap(face);
    let input =
        SettlingInput { meshes: meshes.map(FileMesh::mesh), points, radii: &radii, may_hold: &may_hold };
    let settled = settle(input, &SettlingOptions::default(), monitor)?;
    let mut told = Vec::new();
    for (pair, place) in settled.places.into_iter().enumerate().filter(|(pair, _)| radii[*pair] > 0.0) {
        if settled.moved[pair] > 0.0 {
            let SurfacePoint { face, barycentric } = target.on_file(place);
            landmarks.pairs[pair][1] = LandmarkPoint::OnFace { face: face.0, barycentric };
            points[pair][1] = place;
        }
        told.push(SettledLandmark { pair, point: landmarks.pairs[pair][1], moved: settled.moved[pair] });
    }
    Ok(told)
}

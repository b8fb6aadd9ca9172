//! Tests of maps between poses of one body, whose true map is known.

use crate::common;
use conemap::landmarks::Landmarks;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use conemap::pipeline::{CapFaces, DistortionReport, GroundTruth, MapInput, PipelineOptions, run};
use conemap::registration::rigid_patches::{RigidPatchOptions, SmallMeshes};
use std::path::Path;

tests![patches_hold_small_meshes_of_poses; long: rigid_patches_bring_the_map_nearer_to_the_known_one];

/// Checks that a map has hardly any dents, and that the report lists the worst places in order, at points of the meshes.
fn no_dents(distortion: &DistortionReport, faces: [usize; 2]) {
    let DistortionReport { max, dented, worst, .. } = distortion;
    assert!(*max < 1e3 && *dented < 1e-3, "{max}, {dented} of the area");
    assert!(worst.len() == 10 && worst[0].density == *max);
    assert!(worst.is_sorted_by(|a, b| a.density >= b.density));
    for piece in worst {
        for (place, faces) in [&piece.source, &piece.target].into_iter().zip(faces) {
            let sum: f64 = place.barycentric.iter().sum();
            assert!(place.face < faces && (sum - 1.0).abs() < 1e-9, "{place:?}");
            assert!(place.barycentric.iter().all(|weight| *weight > -1e-9), "{place:?}");
        }
        assert!(piece.area > 0.0 && piece.area < 1e-3);
    }
}

fn rigid_patches_bring_the_map_nearer_to_the_known_one(data: &Path) {
    let pair = common::read_pair(data, "horse-horse01");
    let landmarks = common::landmarks(&pair);
    let input = pair.input(&landmarks, GroundTruth::SameConnectivity);
    let error = |rigid_patches: RigidPatchOptions| {
        let mut options = PipelineOptions::default();
        options.multilevel.rigid_patches = rigid_patches;
        let result = run(input, &options, &mut Silent).unwrap();
        assert!(result.report.certificate.as_ref().unwrap().bijective);
        if rigid_patches == RigidPatchOptions::default() {
            no_dents(&result.report.distortion, [pair.source.face_count(), pair.target.face_count()]);
        }
        result.report.ground_truth.unwrap().mean
    };
    let with = error(RigidPatchOptions::default());
    let without = error(RigidPatchOptions { rounds: 0, ..RigidPatchOptions::default() });
    assert!(with < 0.0024 && with < 0.85 * without, "{with} of the root of the area, {without} without");
}

/// Two horses coarsened to 3,000 vertices in the same way: .24 % of the root of the area from the known map; .30 where patches are asked to fit
/// exactly, so that the map of the full meshes is settled without them.
fn patches_hold_small_meshes_of_poses(data: &Path) {
    let pair = common::read_pair(data, "horse-horse05");
    let held: Vec<VertexId> = common::vertex_pairs(&pair.file).iter().map(|ends| VertexId(ends[0])).collect();
    let ([source, target], landmarks) = common::coarsened([&pair.source, &pair.target], &held, 3000);
    let landmarks = Landmarks { source: landmarks.clone().into(), target: landmarks.into() };
    let input = MapInput {
        source: &source,
        target: &target,
        landmarks: &landmarks,
        ground_truth: GroundTruth::SameConnectivity,
        caps: CapFaces::default(),
    };
    let error = |least_fit: f64| {
        let mut options = PipelineOptions::default();
        let small = &mut options.multilevel.rigid_patches.small;
        *small = SmallMeshes { least_fit, ..*small };
        let result = run(input, &options, &mut Silent).unwrap();
        assert!(result.report.certificate.as_ref().unwrap().bijective);
        result.report.ground_truth.unwrap().mean
    };
    let [with, without] = [RigidPatchOptions::default().small.least_fit, 1.0].map(error);
    assert!(with < 0.0027 && with < 0.9 * without, "{with} of the root of the area, {without} without");
}

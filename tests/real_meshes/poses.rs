//! Tests of maps between poses of one body, whose true map is known.

use crate::common;
use conemap::monitor::Silent;
use conemap::pipeline::{DistortionReport, GroundTruth, PipelineOptions, run};
use conemap::registration::rigid_patches::RigidPatchOptions;
use std::path::Path;

tests![; long: rigid_patches_bring_the_map_nearer_to_the_known_one];

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
    assert!(with < 0.0037 && with < 0.85 * without, "{with} of the root of the area, {without} without");
}

//! Landmarks where people click: inside faces, not only at vertices.

use crate::clicked::{Random, moved};
use crate::common;
use crate::points::{with_landmarks_at, with_points};
use conemap::mesh::{SurfacePoint, VertexId};
use conemap::pipeline::DistortionReport;
use std::path::Path;

tests![
    cat_and_lion_have_as_good_a_map_from_points_in_faces,
    a_vertex_that_promises_too_much_stops_no_other,
    two_animals_are_not_taken_for_two_poses,
];

/// The distortion of a pair's map with its landmarks clicked beside their vertices, as `cargo xtask survey clicks` does.
fn clicked(data: &Path, name: &str, seed: u64) -> DistortionReport {
    let pair = common::read_pair(data, name);
    let landmarks = common::landmarks(&pair);
    let mut random = Random::new(seed);
    let places =
        [(&pair.source, &landmarks.source), (&pair.target, &landmarks.target)].map(|(mesh, vertices)| {
            let points: Vec<_> = vertices.iter().map(|&v| SurfacePoint::at_vertex(mesh, v)).collect();
            moved(mesh, &points, &mut random)
        });
    with_landmarks_at([&pair.source, &pair.target], places)
}

/// E is 4.456 with the landmarks at their vertices. Here it was 4.787, with a dent of 2e4, while a single vertex of the coarser levels ended the
/// relaxation of all.
fn a_vertex_that_promises_too_much_stops_no_other(data: &Path) {
    let distortion = clicked(data, "shrec07-381-397", 1);
    assert!(distortion.energy < 4.62, "{distortion:?}");
}

/// E is 4.388 with the landmarks at their vertices. Here it was 5.159 and took six times as long, while the map was relaxed as one between two
/// poses.
fn two_animals_are_not_taken_for_two_poses(data: &Path) {
    let distortion = clicked(data, "shrec07-387-397", 2);
    assert!(distortion.energy < 4.5, "{distortion:?}");
}

fn cat_and_lion_have_as_good_a_map_from_points_in_faces(data: &Path) {
    let pair = common::read_pair(data, "cat-lion");
    let landmarks = common::landmarks(&pair);
    let vertices: [&[VertexId]; 2] = [&landmarks.source.raw, &landmarks.target.raw];
    let distortion = with_points([&pair.source, &pair.target], vertices, [0.6, 0.2, 0.2]);
    assert!(distortion.energy < 4.4 && distortion.max < 1e4, "{distortion:?}");
}

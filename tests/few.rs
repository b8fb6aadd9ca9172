//! Few landmarks: the program's own cones, and suggestions.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod common;

use conemap::landmarks::Landmarks;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use conemap::pipeline::{GroundTruth, MapResult, OwnConeOptions, PipelineOptions, run};
use glam::DVec3;

/// `count` of the pairs by farthest points of the source in space, from the one farthest from their mean on.
fn farthest_pairs(pair: &common::Pair, count: usize) -> Landmarks {
    let pairs = common::vertex_pairs(&pair.file);
    let place = |p: &[u32; 2]| pair.source.positions()[VertexId(p[0])];
    let mean = pairs.iter().map(place).sum::<DVec3>() / pairs.len() as f64;
    let mut nearest: Vec<f64> = pairs.iter().map(|p| place(p).distance(mean)).collect();
    let mut chosen = Vec::new();
    while chosen.len() < count {
        let far = (0..pairs.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).unwrap();
        let first = chosen.is_empty();
        chosen.push(pairs[far]);
        for (distance, p) in nearest.iter_mut().zip(&pairs) {
            let here = place(p).distance(place(&pairs[far]));
            *distance = if first { here } else { distance.min(here) };
        }
    }
    Landmarks::from_vertices(&pair.source, &pair.target, &chosen).unwrap()
}

fn map(pair: &common::Pair, landmarks: &Landmarks, own_cones: OwnConeOptions) -> MapResult {
    let ground_truth = GroundTruth::SameConnectivity;
    run(
        pair.input(landmarks, ground_truth),
        &PipelineOptions { own_cones, ..PipelineOptions::default() },
        &mut Silent,
    )
    .unwrap()
}

#[test]
fn own_cones_lower_the_distortion_of_twelve_landmarks() {
    let Some(data) = common::data_folder("own_cones_lower_the_distortion_of_twelve_landmarks") else {
        return;
    };
    let pair = common::read_pair(&data, "horse-horse05");
    let landmarks = farthest_pairs(&pair, 12);
    let with = map(&pair, &landmarks, OwnConeOptions::default());
    let without = map(&pair, &landmarks, OwnConeOptions { count: 0, ..OwnConeOptions::default() });
    assert_eq!(without.report.own_landmarks, 0);
    assert!(with.report.own_landmarks > 0 && with.report.own_landmarks <= OwnConeOptions::default().count);
    assert!(with.report.certificate.as_ref().unwrap().bijective);
    assert_eq!(with.base.mesh.vertex_count(), 12);
    let [own, none] = [&with, &without].map(|result| &result.report.distortion);
    assert!(own.energy < none.energy - 0.05 && own.mean < none.mean - 0.03, "{own:?} {none:?}");
    let [own, none] = [&with, &without].map(|result| result.report.ground_truth.as_ref().unwrap().mean);
    assert!(own < 0.006 && own < none, "{own} of the root of the area, {none} without");
    // The user's landmarks are met, on the mesh that the user gave.
    for (&s, &t) in landmarks.source.iter().zip(&landmarks.target) {
        let image = with.target_from_source[s].unwrap();
        let miss = image.position(&pair.target).distance(pair.target.positions()[t]);
        assert!(miss < 1e-9 * pair.target.area().sqrt(), "landmark {s:?} is missed by {miss}");
    }
}

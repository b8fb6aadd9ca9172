//! The whole way on real pairs: what a user of the library may rely on.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod common;

use conemap::landmarks::Landmarks;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::{Cancelled, Monitor, Silent, Step};
use conemap::pipeline::{GroundTruth, MapInput, MapResult, PipelineError, PipelineOptions, run};
use glam::DVec3;

fn map(pair: &common::Pair, monitor: &mut dyn Monitor) -> Result<MapResult, PipelineError> {
    let landmarks = common::landmarks(pair);
    let ground_truth = match pair.file.ground_truth {
        Some(_) => GroundTruth::SameConnectivity,
        None => GroundTruth::Unknown,
    };
    run(pair.input(&landmarks, ground_truth), &PipelineOptions::default(), monitor)
}

fn images(result: &MapResult) -> Vec<SurfacePoint> {
    result.target_from_source.iter().map(|p| p.expect("the relaxed map leaves nothing out")).collect()
}

/// Certificate, energy bound, valid images, landmarks onto landmarks.
fn check_map(pair: &common::Pair, largest_energy: f64) -> MapResult {
    let name = &pair.name;
    let result = map(pair, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
    let report = &result.report;
    let certificate = report.certificate.as_ref().expect("the relaxed map has a certificate");
    assert!(certificate.bijective && certificate.flipped_triangles == 0, "{name}: {certificate:?}");
    assert!(certificate.max_angle_sum_error < 1e-6, "{name}: {certificate:?}");
    let energy = report.distortion.energy;
    assert!((4.0..largest_energy).contains(&energy), "{name}: energy {energy}");
    assert_eq!(report.unmapped_share, 0.0);
    for flow in [&report.cone_metric.source, &report.cone_metric.target] {
        assert!(flow.as_ref().is_some_and(|flow| flow.max_curvature_error < 1e-8), "{name}: {flow:?}");
    }
    assert!((result.cone_curvatures.iter().sum::<f64>() - 4.0 * std::f64::consts::PI).abs() < 1e-8);

    let images = images(&result);
    assert_eq!(images.len(), pair.source.vertex_count());
    for image in &images {
        assert!(image.face.index() < pair.target.face_count());
        assert!((image.barycentric.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{name}: {image:?}");
        assert!(image.barycentric.iter().all(|w| *w >= -1e-9), "{name}: {image:?}");
    }
    let landmarks = common::landmarks(pair);
    let scale = pair.target.area().sqrt();
    for (&s, &t) in landmarks.source.iter().zip(&landmarks.target) {
        let miss = images[s.index()].position(&pair.target).distance(pair.target.positions()[t]);
        assert!(miss < 1e-9 * scale, "{name}: landmark {s:?} is missed by {miss}");
    }
    result
}

#[test]
fn cat_to_lion() {
    let Some(data) = common::data_folder("cat_to_lion") else { return };
    let result = check_map(&common::read_pair(&data, "cat-lion"), 5.0);
    let report = serde_json::to_value(&result.report).unwrap();
    assert!(report["ground_truth"].is_null(), "nothing is known of the true map");
}

#[test]
fn two_animals_with_few_landmarks() {
    let Some(data) = common::data_folder("two_animals_with_few_landmarks") else { return };
    check_map(&common::read_pair(&data, "shrec07-397-400"), 12.0);
}

#[test]
fn two_poses_come_near_the_true_map() {
    let Some(data) = common::data_folder("two_poses_come_near_the_true_map") else { return };
    let result = check_map(&common::read_pair(&data, "horse-horse05"), 4.6);
    let truth = result.report.ground_truth.as_ref().expect("the true map is known");
    assert!(truth.mean < 0.004 && truth.mean <= truth.p95 && truth.p95 <= truth.max, "{truth:?}");

    let fields = common::json_fields(&serde_json::to_value(&result.report).unwrap());
    let mut expected: Vec<_> = common::REPORT_FIELDS.iter().filter(|f| **f != "ground_truth").collect();
    expected.extend([&"ground_truth.max", &"ground_truth.mean", &"ground_truth.p95", &"seconds"]);
    expected.sort();
    assert!(fields.iter().eq(expected), "{fields:#?}");
}

/// Stops at the n-th step; never when there is no such step.
struct StopAt {
    steps: usize,
    limit: usize,
}

impl Monitor for StopAt {
    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        assert!((0.0..=1.0).contains(&step.fraction), "{step:?}");
        if self.steps == self.limit {
            return Err(Cancelled);
        }
        self.steps += 1;
        Ok(())
    }
}

#[test]
fn runs_repeat_exactly_and_stop_when_asked() {
    let Some(data) = common::data_folder("runs_repeat_exactly_and_stop_when_asked") else { return };
    let pair = common::read_pair(&data, "shrec07-397-400");
    let mut counter = StopAt { steps: 0, limit: usize::MAX };
    let first = map(&pair, &mut counter).unwrap();
    let second = map(&pair, &mut Silent).unwrap();
    assert_eq!(first.target_from_source, second.target_from_source);
    assert_eq!(first.report, second.report);

    let total = counter.steps;
    assert!(total > 20, "only {total} steps");
    for limit in [0, 1, total / 2, total - 1] {
        let outcome = map(&pair, &mut StopAt { steps: 0, limit });
        assert!(matches!(outcome, Err(PipelineError::Cancelled(_))), "step {limit} of {total}: not stopped");
    }
}

/// A mesh mapped onto itself.
fn identity(mesh: &SurfaceMesh, chosen: &[VertexId]) {
    let landmarks = Landmarks { source: chosen.to_vec(), target: chosen.to_vec() };
    let ground_truth = GroundTruth::SameConnectivity;
    let input = MapInput { source: mesh, target: mesh, landmarks: &landmarks, ground_truth };
    let result = run(input, &PipelineOptions::default(), &mut Silent).unwrap();
    let distortion = &result.report.distortion;
    assert!((distortion.energy - 4.0).abs() < 1e-6, "{distortion:?}");
    assert!((distortion.mean - 1.0).abs() < 1e-6, "{distortion:?}");
    let bound = 1e-6 * mesh.area().sqrt();
    for (v, image) in mesh.vertices().zip(images(&result)) {
        let miss = image.position(mesh).distance(mesh.positions()[v]);
        assert!(miss < bound, "vertex {v:?} is missed by {miss}");
    }
}

#[test]
fn a_mesh_maps_identically_onto_itself() {
    let mesh = conemap::mesh::generators::icosphere(3);
    identity(&mesh, &common::farthest_points(&mesh, 12));
    let Some(data) = common::data_folder("a_mesh_maps_identically_onto_itself") else { return };
    let mesh = common::read_mesh(&data.join("single/spot.off"));
    identity(&mesh, &common::farthest_points(&mesh, 12));
}

#[test]
fn exchanging_source_and_target_gives_the_inverse_map() {
    let Some(data) = common::data_folder("exchanging_source_and_target_gives_the_inverse_map") else {
        return;
    };
    let pair = common::read_pair(&data, "shrec07-397-400");
    let there = common::landmarks(&pair);
    let back = Landmarks { source: there.target.clone(), target: there.source.clone() };
    let run = |source, target, landmarks| {
        let input = MapInput { source, target, landmarks, ground_truth: GroundTruth::Unknown };
        run(input, &PipelineOptions::default(), &mut Silent).unwrap()
    };
    let forth = run(&pair.source, &pair.target, &there);
    let inverse = run(&pair.target, &pair.source, &back);
    let [first, second] = [&forth.report, &inverse.report];
    assert!((first.distortion.energy - second.distortion.energy).abs() < 1e-9, "{first:?} {second:?}");
    assert_eq!(first.layout, second.layout);
    for (v, image) in pair.source.vertices().zip(images(&forth)) {
        let image = image.position(&pair.target);
        let miss = preimage(&inverse, pair.source.positions()[v], &pair.source).distance(image);
        assert!(miss < 1e-9 * pair.target.area().sqrt(), "{v:?} is missed by {miss}");
    }
}

/// The source's point that a map takes to a vertex of its target at `place`.
fn preimage(map: &MapResult, place: DVec3, target: &SurfaceMesh) -> DVec3 {
    let common = &map.common;
    let nearest = common.target_positions.iter().zip(&common.source_positions);
    let found = nearest.min_by(|a, b| a.0.distance_squared(place).total_cmp(&b.0.distance_squared(place)));
    let (there, here) = found.expect("the overlay has points");
    assert!(there.distance(place) < 1e-9 * target.area().sqrt(), "the overlay has every vertex");
    *here
}

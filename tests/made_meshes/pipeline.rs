//! Tests of the whole pipeline on the demos, for properties that a user of the library may rely on.

use crate::common::farthest_points;
use crate::fixtures;
use crate::theorems::{
    exchange_gives_the_inverse, identity_is_found, images, map_is_certified, run_repeats_and_stops,
};
use conemap::mesh::generators::icosphere;

#[test]
fn every_demo_is_certified() {
    for case in fixtures::demos() {
        let result = map_is_certified(&case, 5.0);
        assert!(result.report.ground_truth.is_none(), "nothing is known of the true map");
    }
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn demos_of_other_sizes_are_certified() {
    for (id, faces) in [("horse-cat", [2000, 12_000]), ("poses", [12_000, 2000])] {
        map_is_certified(&fixtures::remeshed_demo(id, faces), 5.0);
    }
}

#[test]
fn rough_demos_are_certified() {
    map_is_certified(&fixtures::rough_demo("horse-cat"), 5.0);
}

#[test]
fn a_bent_horse_comes_near_the_true_map() {
    let result = map_is_certified(&fixtures::bent_horse(), 4.6);
    let truth = result.report.ground_truth.as_ref().expect("the true map is known");
    assert!(truth.mean < 0.004 && truth.mean <= truth.p95 && truth.p95 <= truth.max, "{truth:?}");
}

/// A surface onto a moved, scaled copy in other triangles: the map is the known one, with nearly no distortion.
#[test]
fn a_moved_surface_with_other_triangles_has_an_isometry() {
    let case = fixtures::split_horse();
    let images = images(&map_is_certified(&case, 4.02));
    let scale = case.target.area().sqrt();
    let misses = case
        .source
        .vertices()
        .map(|v| images[v.index()].position(&case.target).distance(case.target.positions()[v]) / scale);
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for miss in misses {
        (worst, sum) = (worst.max(miss), sum + miss);
    }
    let mean = sum / images.len() as f64;
    assert!(mean < 2e-4 && worst < 0.02, "mean {mean}, worst {worst}");
}

#[test]
fn runs_repeat_exactly_and_stop_when_asked() {
    run_repeats_and_stops(&fixtures::demo("sphere-tetrahedron"));
}

#[test]
fn meshes_map_identically_onto_themselves() {
    let ball = icosphere(3);
    identity_is_found("ball", &ball, &farthest_points(&ball, 12));
    let cat = fixtures::demo("horse-cat");
    identity_is_found("cat", &cat.target, &cat.landmarks.target.raw);
}

#[test]
fn exchanging_source_and_target_gives_the_inverse_map() {
    exchange_gives_the_inverse(&fixtures::demo("horse-cat"));
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn exchanging_meshes_of_other_sizes_gives_the_inverse_map() {
    exchange_gives_the_inverse(&fixtures::remeshed_demo("poses", [3000, 6000]));
}

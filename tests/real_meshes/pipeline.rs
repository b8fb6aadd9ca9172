//! Tests of the whole pipeline on real pairs, for properties that a user of the library may rely on.

use crate::common::{REPORT_FIELDS, farthest_points, json_fields, read_mesh, read_pair};
use crate::theorems::{
    exchange_gives_the_inverse, identity_is_found, map_is_certified, run_repeats_and_stops,
};
use std::path::Path;

tests![
    cat_to_lion,
    two_animals_with_few_landmarks,
    two_poses_come_near_the_true_map,
    a_mesh_maps_identically_onto_itself;
    long:
    runs_repeat_exactly_and_stop_when_asked,
    exchanging_source_and_target_gives_the_inverse_map,
];

fn cat_to_lion(data: &Path) {
    let result = map_is_certified(&read_pair(data, "cat-lion").into(), 5.0);
    let report = serde_json::to_value(&result.report).unwrap();
    assert!(report["ground_truth"].is_null(), "nothing is known of the true map");
}

fn two_animals_with_few_landmarks(data: &Path) {
    map_is_certified(&read_pair(data, "shrec07-397-400").into(), 12.0);
}

fn two_poses_come_near_the_true_map(data: &Path) {
    let result = map_is_certified(&read_pair(data, "horse-horse05").into(), 4.6);
    let truth = result.report.ground_truth.as_ref().expect("the true map is known");
    assert!(truth.mean < 0.0018 && truth.mean <= truth.p95 && truth.p95 <= truth.max, "{truth:?}");

    let fields = json_fields(&serde_json::to_value(&result.report).unwrap());
    let mut expected: Vec<_> = REPORT_FIELDS.iter().filter(|f| **f != "ground_truth").collect();
    expected.extend([&"ground_truth.max", &"ground_truth.mean", &"ground_truth.p95", &"seconds"]);
    expected.sort();
    assert!(fields.iter().eq(expected), "{fields:#?}");
}

fn runs_repeat_exactly_and_stop_when_asked(data: &Path) {
    run_repeats_and_stops(&read_pair(data, "shrec07-397-400").into());
}

fn a_mesh_maps_identically_onto_itself(data: &Path) {
    let mesh = read_mesh(&data.join("single/spot.off"));
    identity_is_found("spot", &mesh, &farthest_points(&mesh, 12));
}

fn exchanging_source_and_target_gives_the_inverse_map(data: &Path) {
    exchange_gives_the_inverse(&read_pair(data, "shrec07-397-400").into());
}

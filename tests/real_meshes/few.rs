//! Tests of the program's own cones, with few landmarks on a real pair.

use crate::common::read_pair;
use crate::theorems::{Case, farthest_landmarks, maps_with_and_without_own_cones};
use conemap::monitor::Silent;
use conemap::pipeline::{PipelineOptions, run};
use std::path::Path;

tests![
    legs_without_landmarks_go_to_their_own,
    unmarked_legs_of_a_pose_are_not_turned,
    of_two_maps_of_a_pose_each_leg_is_taken_from_the_one_that_distorts_it_less;
    long:
    a_pose_that_is_seen_late_is_seen,
    own_cones_lower_the_distortion_of_twelve_landmarks,
];

fn own_cones_lower_the_distortion_of_twelve_landmarks(data: &Path) {
    let results =
        maps_with_and_without_own_cones(&farthest_landmarks(&read_pair(data, "horse-horse05").into(), 12));
    let [own, none] = results.each_ref().map(|result| &result.report.distortion);
    assert!(own.energy < none.energy - 0.05 && own.mean < none.mean - 0.03, "{own:?} {none:?}");
    let [own, none] = results.each_ref().map(|result| result.report.ground_truth.as_ref().unwrap().mean);
    assert!(own < 0.006 && own < none, "{own} of the root of the area, {none} without");
}

/// Eight landmarks, two of them at ends of limbs. Without ends that the matching finds legs go to the wrong ones.
fn legs_without_landmarks_go_to_their_own(data: &Path) {
    let all: Case = read_pair(data, "horse-camel").into();
    let few = all.only(&[6, 10, 18, 20, 21, 22, 26, 27]);
    let map = run(few.input(), &PipelineOptions::default(), &mut Silent).unwrap();
    assert!(map.report.certificate.as_ref().is_some_and(|c| c.bijective));
    assert!(map.report.distortion.mean_log < 0.29, "{:?}", map.report.distortion);
    let root = all.target.area().sqrt();
    for (&from, &onto) in all.landmarks.source.iter().zip(&all.landmarks.target) {
        let image = map.target_from_source[from].unwrap().position(&all.target);
        let off = image.distance(all.target.positions()[onto]) / root;
        assert!(off < 0.25, "{from:?} is {off} off");
    }
}

/// Eight landmarks of two poses of a horse, which leave limbs unmarked: .2 % of the root of the area from the known map. Where rounds of own cones
/// begin with images under the map of these landmarks, and not with matched ends, it is .6 %.
fn unmarked_legs_of_a_pose_are_not_turned(data: &Path) {
    let error = error_with(data, "horse-horse01", &[12, 0, 24, 2, 20, 29, 28, 27]);
    assert!(error < 0.0035, "{error} of the root of the area");
}

/// The map that begins with matched ends has the larger mean log density, and turns no leg; the other one does. Where own points are placed by the
/// latter alone the map is .47 % of the root of the area from the known one, by both .15.
fn of_two_maps_of_a_pose_each_leg_is_taken_from_the_one_that_distorts_it_less(data: &Path) {
    let error = error_with(data, "horse-horse05", &[5, 3, 24, 0, 21, 8, 30, 29]);
    assert!(error < 0.003, "{error} of the root of the area");
}

/// The map of these five landmarks distorts as much as between two bodies, until own points have moved with it for seven rounds; with six rounds
/// it is 3.6 % of the root of the area from the known map.
fn a_pose_that_is_seen_late_is_seen(data: &Path) {
    let error = error_with(data, "cat-cat1", &[15, 25, 9, 13, 28]);
    assert!(error < 0.008, "{error} of the root of the area");
}

/// The mean distance from the known map of a pair of poses with these landmarks; the root of the area is 1.
fn error_with(data: &Path, pair: &str, landmarks: &[usize]) -> f64 {
    let few = Case::from(read_pair(data, pair)).only(landmarks);
    let map = run(few.input(), &PipelineOptions::default(), &mut Silent).unwrap();
    assert!(map.report.certificate.as_ref().is_some_and(|c| c.bijective));
    map.report.ground_truth.unwrap().mean
}

//! Tests of the program's own cones, with few landmarks on a real pair.

use crate::common::read_pair;
use crate::theorems::{farthest_landmarks, maps_with_and_without_own_cones};
use std::path::Path;

tests![; long: own_cones_lower_the_distortion_of_twelve_landmarks];

fn own_cones_lower_the_distortion_of_twelve_landmarks(data: &Path) {
    let results =
        maps_with_and_without_own_cones(&farthest_landmarks(&read_pair(data, "horse-horse05").into(), 12));
    let [own, none] = results.each_ref().map(|result| &result.report.distortion);
    assert!(own.energy < none.energy - 0.05 && own.mean < none.mean - 0.03, "{own:?} {none:?}");
    let [own, none] = results.each_ref().map(|result| result.report.ground_truth.as_ref().unwrap().mean);
    assert!(own < 0.006 && own < none, "{own} of the root of the area, {none} without");
}

//! Few landmarks on two poses whose map is known: the program's own cones.

use crate::fixtures;
use crate::theorems::{farthest_landmarks, maps_with_and_without_own_cones};

#[test]
fn own_cones_lower_the_distortion_of_eight_landmarks() {
    let results = maps_with_and_without_own_cones(&farthest_landmarks(&fixtures::bent_horse(), 8));
    let [own, none] = results.each_ref().map(|result| &result.report.distortion);
    assert!(own.energy < none.energy - 0.3 && own.mean < none.mean - 0.2, "{own:?} {none:?}");
    let [own, none] = results.each_ref().map(|result| result.report.ground_truth.as_ref().unwrap().mean);
    assert!(own < 0.007 && own < 0.7 * none, "{own} of the root of the area, {none} without");
}

//! Poses of one body whose true map is known.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod common;

use conemap::monitor::Silent;
use conemap::pipeline::{GroundTruth, PipelineOptions, run};
use conemap::surface_map::relief::ReliefOptions;

#[test]
fn the_relief_of_the_skin_brings_the_map_nearer_to_the_known_one() {
    let Some(data) = common::data_folder("the_relief_of_the_skin_brings_the_map_nearer_to_the_known_one")
    else {
        return;
    };
    let pair = common::read_pair(&data, "horse-horse01");
    let landmarks = common::landmarks(&pair);
    let input = pair.input(&landmarks, GroundTruth::SameConnectivity);
    let error = |relief: ReliefOptions| {
        let mut options = PipelineOptions::default();
        options.multilevel.relief = relief;
        let result = run(input, &options, &mut Silent).unwrap();
        assert!(result.report.certificate.as_ref().unwrap().bijective);
        result.report.ground_truth.unwrap().mean
    };
    let with = error(ReliefOptions::default());
    let without = error(ReliefOptions { rounds: 0, ..ReliefOptions::default() });
    assert!(with < 0.0037 && with < 0.85 * without, "{with} of the root of the area, {without} without");
}

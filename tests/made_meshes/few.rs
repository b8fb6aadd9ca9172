//! Tests of the program's own cones, with few landmarks on two poses whose true map is known.

use crate::fixtures;
use crate::theorems::{farthest_landmarks, maps_with_and_without_own_cones};
use conemap::demo;
use conemap::job::{Job, JobFiles, TargetImage};
use conemap::landmark_exchange::GivenFile;
use conemap::landmarks::Landmarks;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use conemap::pipeline::{MapInput, OwnConeOptions, PipelineOptions, run};

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn own_cones_lower_the_distortion_of_eight_landmarks() {
    let results = maps_with_and_without_own_cones(&farthest_landmarks(&fixtures::bent_horse(), 8));
    let [own, none] = results.each_ref().map(|result| &result.report.distortion);
    assert!(own.energy < none.energy - 0.3 && own.mean < none.mean - 0.2, "{own:?} {none:?}");
    let [own, none] = results.each_ref().map(|result| result.report.ground_truth.as_ref().unwrap().mean);
    assert!(own < 0.007 && own < 0.7 * none, "{own} of the root of the area, {none} without");
}

/// The coarse levels of small meshes are the meshes themselves, with all points that a round of own cones inserts.
#[test]
fn small_meshes_take_own_cones_in_several_rounds() {
    let [source, target] = [
        include_bytes!("../../verify/tests/data/bean.off").as_slice(),
        include_bytes!("../../verify/tests/data/ball.off").as_slice(),
    ];
    let landmarks = br#"{"pairs": [[144, 43], [74, 50], [17, 60], [37, 67], [26, 0], [29, 113],
        [{"face": 83, "barycentric": [0.3, 0.3, 0.4]}, {"face": 45, "barycentric": [0.25, 0.5, 0.25]}]]}"#;
    let landmarks = [GivenFile { name: "pairs.json", bytes: landmarks }];
    let files = JobFiles { source, target, landmarks: &landmarks };
    let job = Job::read(files, TargetImage::AsGiven, &mut Silent).unwrap();
    let report = job.run(&PipelineOptions::default(), &mut Silent).unwrap().report;
    assert!(report.own_landmarks > 0, "no own cone was taken");
    assert!(report.certificate.is_some_and(|c| c.bijective));
}

/// Two poses of a hand with all landmarks of the demo, more than where own cones are added between different bodies: the map is looked for
/// again, on levels with more vertices and with own cones.
#[test]
fn a_second_look_at_poses_with_many_landmarks_lowers_the_distortion() {
    let demo = demo::build("hands").unwrap();
    assert!(demo.landmarks.len() > OwnConeOptions::default().most_landmarks);
    let [source, target] = [&demo.source, &demo.target];
    let landmarks = Landmarks::from_vertices(source, target, &demo.landmarks).unwrap();
    let own = OwnConeOptions::default();
    let [with, without] = [own.most_pose_landmarks, own.most_landmarks].map(|most_pose_landmarks| {
        let own_cones = OwnConeOptions { most_pose_landmarks, ..own };
        let options = PipelineOptions { own_cones, ..PipelineOptions::default() };
        run(MapInput::new(source, target, &landmarks), &options, &mut Silent).unwrap().report
    });
    assert_eq!(without.own_landmarks, 0);
    assert!(with.certificate.as_ref().is_some_and(|c| c.bijective));
    let [mean_log, alone] = [with, without].map(|report| report.distortion.mean_log);
    assert!(mean_log < 0.85 * alone, "{mean_log} {alone}");
}

/// A horse and a cat with all landmarks of the demo but that at the tip of the tail.
#[test]
fn a_tail_without_a_landmark_goes_to_a_tail() {
    let demo = demo::build("horse-cat").unwrap();
    let tail = demo.labels.iter().position(|label| label == "tail tip").unwrap();
    let [from, onto] = demo.landmarks[tail].map(VertexId);
    let mut kept = demo.landmarks.clone();
    kept.remove(tail);
    let [source, target] = [&demo.source, &demo.target];
    let landmarks = Landmarks::from_vertices(source, target, &kept).unwrap();
    let usual = OwnConeOptions { most_landmarks: 4, ..OwnConeOptions::default() };
    let results = [12, 0].map(|ends| {
        let options =
            PipelineOptions { own_cones: OwnConeOptions { ends, ..usual }, ..PipelineOptions::default() };
        run(MapInput::new(source, target, &landmarks), &options, &mut Silent).unwrap()
    });
    let [with, without] = results.each_ref().map(|result| &result.report);
    assert_eq!([with.own_landmarks, without.own_landmarks], [1, 0]);
    assert!(with.certificate.as_ref().is_some_and(|c| c.bijective));
    assert!(with.distortion.mean_log < 0.95 * without.distortion.mean_log);
    let [off, off_without] = results.each_ref().map(|result| {
        let image = result.target_from_source[from].unwrap().position(target);
        image.distance(target.positions()[onto]) / target.area().sqrt()
    });
    assert!(off < 0.06 && off < off_without, "{off} {off_without}");
}

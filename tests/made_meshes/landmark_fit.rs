//! Landmarks that do not fit: no false alarms on the demos, and faults put in on purpose are found.

use crate::fit::{self, Case, mirrored, only_the_mirror_image_raises_an_alarm};
use crate::fixtures;
use conemap::landmark_fit::order_agreement;
use conemap::landmarks::Landmarks;
use conemap::layout::LandmarkDistances;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;

#[test]
fn demos_raise_no_alarm_and_their_mirror_images_do() {
    for case in [fixtures::demo("horse-cat"), fixtures::demo("poses")] {
        only_the_mirror_image_raises_an_alarm(Case::of(&case));
    }
}

#[test]
fn exchanged_targets_are_named() {
    fit::exchanged_targets_are_named(&Case::of(&fixtures::demo("horse-cat")));
}

#[test]
fn agreement_changes_sign_in_the_mirror() {
    let demo = conemap::demo::build("horse-cat").expect("a demo");
    let vertices = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect::<Vec<_>>();
    let landmarks = Landmarks { source: vertices(0).into(), target: vertices(1).into() };
    let agreement = |target: &SurfaceMesh| {
        let meshes = [&demo.source, target];
        order_agreement(meshes, &landmarks, &LandmarkDistances::new(meshes, &landmarks, &mut Silent).unwrap())
    };
    let (straight, reflected) = (agreement(&demo.target), agreement(&mirrored(&demo.target)));
    assert!(straight > 0.6 && reflected < -0.6, "{straight} {reflected}");
}

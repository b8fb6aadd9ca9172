//! The flow converges on all demos, as they are, with other triangles and made rough.

use crate::fixtures;
use crate::theorems::{Case, fixed_triangulation_fails_and_says_so, flow_converges};

fn both_sides_converge(case: &Case) {
    flow_converges(&case.name, &case.source, &case.landmarks.source.raw);
    flow_converges(&case.name, &case.target, &case.landmarks.target.raw);
}

#[test]
fn every_demo_converges() {
    fixtures::demos().iter().for_each(both_sides_converge);
}

#[test]
fn demos_of_other_sizes_converge() {
    for faces in [[1000, 20_000], [20_000, 1000]] {
        both_sides_converge(&fixtures::remeshed_demo("horse-cat", faces));
    }
}

#[test]
fn rough_demos_converge() {
    for id in ["horse-cat", "poses", "sphere-tetrahedron"] {
        both_sides_converge(&fixtures::rough_demo(id));
    }
}

#[test]
fn the_fixed_triangulation_says_that_it_did_not_converge() {
    let Case { target: cat, landmarks, .. } = fixtures::rough_demo("horse-cat");
    fixed_triangulation_fails_and_says_so(&cat, &landmarks.target.raw);
}

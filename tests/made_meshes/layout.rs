//! The base domain drawn on the demos, as they are, with other triangles and made rough.

use crate::fixtures;
use crate::theorems::has_a_valid_layout;

#[test]
fn every_demo_has_a_valid_layout() {
    fixtures::demos().iter().for_each(has_a_valid_layout);
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn demos_of_other_sizes_have_a_valid_layout() {
    for id in ["horse-cat", "poses"] {
        for faces in [[1500, 3000], [3000, 1500], [10_000, 2000]] {
            has_a_valid_layout(&fixtures::remeshed_demo(id, faces));
        }
    }
}

#[test]
fn rough_demos_have_a_valid_layout() {
    for id in ["horse-cat", "poses", "sphere-tetrahedron"] {
        has_a_valid_layout(&fixtures::rough_demo(id));
    }
}

//! The base domain drawn on the demos, as they are, with other triangles and made rough.

use crate::fixtures;
use crate::theorems::has_a_valid_layout;
use conemap::landmarks::Landmarks;
use conemap::layout::{self, Candidates, LayoutError, LayoutOptions};
use conemap::mesh::VertexId;
use conemap::mesh::generators::icosphere;
use conemap::monitor::Silent;

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

#[test]
fn fewer_than_four_landmarks_are_told() {
    let ball = icosphere(2);
    for count in 0..4 {
        let at: Vec<VertexId> = (0..count).map(VertexId).collect();
        let landmarks = Landmarks { source: at.clone().into(), target: at.into() };
        let few = LayoutError::TooFew { landmarks: landmarks.len() };
        let drawn = layout::joint([&ball; 2], &landmarks, &LayoutOptions::default(), &mut Silent);
        assert_eq!(drawn.unwrap_err(), few);
        assert_eq!(Candidates::new([&ball; 2], &landmarks, &mut Silent).err(), Some(few));
    }
}

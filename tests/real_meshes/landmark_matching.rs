//! A test of matching a real pair without a landmark.

use crate::common;
use conemap::landmark_matching::{MatchInput, MatchOptions, Verdict, match_landmarks};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use std::path::Path;

tests![cat_and_lion_are_matched_limb_by_limb];

/// The numbers of the known pairs at the ends of limbs; all other pairs lie on the head or between the limbs.
const FEET_AND_TAIL: [usize; 5] = [2, 4, 10, 18, 0];

fn cat_and_lion_are_matched_limb_by_limb(data: &Path) {
    let pair = common::read_pair(data, "cat-lion");
    let known = common::vertex_pairs(&pair.file);
    let input = MatchInput::new(&pair.source, &pair.target);
    let found = match_landmarks(input, &MatchOptions::default(), &mut Silent).unwrap();
    assert_eq!(found.verdict, Verdict::Sure);
    let nearest = |mesh: &SurfaceMesh, side: usize, v: VertexId| {
        let place = mesh.positions()[v];
        let distance = |k: &usize| mesh.positions()[VertexId(known[*k][side])].distance(place);
        (0..known.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    };
    let ends: Vec<[usize; 2]> = found.candidates[0]
        .pairs
        .iter()
        .map(|p| [nearest(&pair.source, 0, p.source), nearest(&pair.target, 1, p.target)])
        .collect();
    for end in FEET_AND_TAIL {
        assert!(ends.contains(&[end, end]), "{end}: {ends:?}");
    }
}

//! Tests of the search for limbs without a landmark, on real animals.

use crate::common;
use conemap::landmarks::MeshSide::{self, Source, Target};
use conemap::monitor::Silent;
use conemap::pipeline::{FindingKind, MapInput, findings};
use std::path::Path;

tests![tails_without_a_landmark_are_named_and_nothing_else];

/// The meshes of a pair on which limbs are named, each with their number.
fn named(data: &Path, name: &str) -> Vec<(MeshSide, usize)> {
    let pair = common::read_pair(data, name);
    let landmarks = common::landmarks(&pair);
    let input = MapInput::new(&pair.source, &pair.target, &landmarks);
    let found = findings(input, &[], &mut Silent).unwrap();
    let limbs = found.iter().filter(|f| f.kind == FindingKind::UnmarkedLimbs);
    limbs.map(|f| (f.side.unwrap(), f.vertices.len())).collect()
}

/// The 21 landmarks of the SHREC07 pairs leave the tails out, of which five of eight are long. The 33 landmarks of the other pairs leave no
/// limb out.
fn tails_without_a_landmark_are_named_and_nothing_else(data: &Path) {
    for name in ["cat-cat1", "cat-dog", "cat-lion", "horse-camel", "horse-horse05"] {
        assert_eq!(named(data, name), [], "{name}");
    }
    let expected: [(&str, &[(MeshSide, usize)]); 4] = [
        ("shrec07-381-383", &[(Target, 1)]),
        ("shrec07-385-387", &[(Source, 1)]),
        ("shrec07-392-394", &[(Target, 1)]),
        ("shrec07-397-400", &[(Source, 1), (Target, 1)]),
    ];
    for (name, sides) in expected {
        assert_eq!(named(data, name), sides, "{name}");
    }
}

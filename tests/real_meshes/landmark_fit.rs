//! Landmarks that do not fit: no false alarms on real pairs, and faults put in on purpose are found.

use crate::common;
use crate::data::{self, pair_names};
use crate::ends::{ends, partners_among};
use crate::fit::{self, Case, mirrored, only_the_mirror_image_raises_an_alarm, swaps};
use crate::shrec07;
use conemap::landmark_fit::{Finding, Repair};
use conemap::landmarks::{LandmarkId, Landmarks, MeshSide};
use conemap::layout::LandmarkDistances;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use std::path::Path;

tests![
    real_pairs_raise_no_alarm_and_their_mirror_images_do,
    few_landmarks_of_real_pairs_raise_no_alarm,
    exchanged_targets_are_named,
    feet_exchanged_among_few_ends_are_named_by_maps,
    ears_and_eyes_exchanged_together_are_named_both,
    an_exchange_in_a_mirrored_set_is_named_after_the_mirror,
    a_target_on_the_wrong_limb_is_named;
    long:
    exchanged_left_and_right_partners_are_named_first,
];

fn read(data: &Path, name: &str) -> Case {
    Case::of(&common::read_pair(data, name).into())
}

fn real_pairs_raise_no_alarm_and_their_mirror_images_do(data: &Path) {
    for name in pair_names() {
        only_the_mirror_image_raises_an_alarm(read(data, &name));
    }
}

fn few_landmarks_of_real_pairs_raise_no_alarm(data: &Path) {
    for name in ["cat-lion", "horse-camel", "horse-horse05", "shrec07-381-385", "shrec07-394-400"] {
        let case = read(data, name);
        for count in [4, 6, 12] {
            let step = case.landmarks.len() / count;
            let some = |all: &[VertexId]| all.iter().copied().step_by(step).take(count).collect();
            let landmarks = Landmarks {
                source: some(&case.landmarks.source.raw),
                target: some(&case.landmarks.target.raw),
            };
            let findings = case.findings(&landmarks);
            assert!(findings.is_empty(), "{name}, {count} landmarks: {findings:?}");
        }
    }
}

fn exchanged_targets_are_named(data: &Path) {
    for name in ["cat-lion", "horse-camel", "shrec07-381-387", "shrec07-383-400"] {
        fit::exchanged_targets_are_named(&read(data, name));
    }
}

/// Among six and eight ends distances and orders leave exchanged feet undecided; maps with and without the exchange tell.
fn feet_exchanged_among_few_ends_are_named_by_maps(data: &Path) {
    let (mut named, mut tried) = (0, 0);
    for name in ["shrec07-381-385", "shrec07-383-400", "shrec07-385-397", "shrec07-387-397"] {
        let case = read(data, name);
        for count in [6, 8] {
            let chosen = ends(&case.source, &case.landmarks.source.raw, count);
            let of = |all: &[VertexId]| chosen.iter().map(|&k| all[k]).collect();
            let ends =
                Landmarks { source: of(&case.landmarks.source.raw), target: of(&case.landmarks.target.raw) };
            let findings = case.findings(&ends);
            assert!(findings.is_empty(), "{name}, {count}: {findings:?}");
            for [a, b] in partners_among(&chosen, &shrec07::PARTNERS) {
                let mut wrong = ends.clone();
                wrong.target.raw.swap(a, b);
                let swaps = swaps(&case.findings(&wrong));
                assert!(swaps.iter().all(|pair| *pair == [a.min(b), a.max(b)]), "{name}: {swaps:?}, {a} {b}");
                tried += 1;
                named += swaps.len();
            }
        }
    }
    assert!(tried >= 12 && 10 * named >= 9 * tried, "{named} of {tried}");
}

/// Left and right ears, eyes, corners of the mouth and knees of cat and lion.
const CAT_LION: [[usize; 2]; 6] = [[9, 13], [23, 24], [27, 29], [31, 32], [8, 15], [25, 26]];

fn exchanged_left_and_right_partners_are_named_first(data: &Path) {
    let (mut missed, mut tried) = (Vec::new(), 0);
    for name in pair_names() {
        let partners = match name.as_str() {
            "cat-lion" => &CAT_LION[..],
            shrec if shrec07::is_of(shrec) => &shrec07::PARTNERS[..],
            _ => continue,
        };
        let case = read(data, &name);
        for &[a, b] in partners {
            let mut landmarks = case.landmarks.clone();
            landmarks.target.raw.swap(a, b);
            let findings = case.findings(&landmarks);
            let pairs = [a, b].map(LandmarkId::from);
            let named = findings.first().is_some_and(|f| f.repair() == Repair::Swap { pairs });
            assert!(named || name != "cat-lion", "{name}, {a} and {b}: {findings:?}");
            tried += 1;
            if !named {
                missed.push(format!("{name}, {a} and {b}: {findings:?}"));
            }
        }
    }
    let animals = data::SHREC07.len();
    assert_eq!(tried, animals * (animals - 1) / 2 * shrec07::PARTNERS.len() + CAT_LION.len());
    assert!(20 * missed.len() <= tried, "{} of {tried}: {missed:#?}", missed.len());
}

fn ears_and_eyes_exchanged_together_are_named_both(data: &Path) {
    let case = read(data, "cat-lion");
    let mut landmarks = case.landmarks.clone();
    let both = [[9, 13], [27, 29]];
    both.iter().for_each(|&[a, b]| landmarks.target.raw.swap(a, b));
    let findings = case.findings(&landmarks);
    let mut swaps = swaps(&findings);
    swaps.sort_unstable();
    assert_eq!(swaps, both, "{findings:?}");
    assert_eq!(findings.len(), 2, "{findings:?}");
}

fn an_exchange_in_a_mirrored_set_is_named_after_the_mirror(data: &Path) {
    let case = read(data, "cat-lion");
    let case = Case { target: mirrored(&case.target), ..case };
    let mut landmarks = case.landmarks.clone();
    landmarks.target.raw.swap(9, 13);
    let repairs: Vec<Repair> = case.findings(&landmarks).iter().map(Finding::repair).collect();
    assert_eq!(repairs, [Repair::MirrorTarget, Repair::Swap { pairs: [LandmarkId(9), LandmarkId(13)] }]);
}

fn a_target_on_the_wrong_limb_is_named(data: &Path) {
    for name in ["cat-lion", "horse-horse05", "shrec07-383-397"] {
        let case = read(data, name);
        let distances = LandmarkDistances::new([&case.source, &case.target], &case.landmarks, &mut Silent)
            .expect("nobody stops");
        let mut found = 0;
        let n = case.landmarks.len();
        for pair in case.landmarks.target.keys() {
            let far = |v: &VertexId| {
                distances.field(MeshSide::Target, pair)[*v] > 0.6 && !case.landmarks.target.contains(v)
            };
            let turned = (0..800).map(|k| VertexId((k * 37 + pair.0 * 101) % 800));
            let wrong = turned.into_iter().find(far).expect("the body is longer than that");
            let mut landmarks = case.landmarks.clone();
            landmarks.target[pair] = wrong;
            let findings = case.findings(&landmarks);
            assert!(swaps(&findings).is_empty(), "{name}, {pair:?}: {findings:?}");
            found += usize::from(findings.iter().any(|f| f.repair() == Repair::Check { pair }));
        }
        assert!(found * 10 >= n * 9, "{name}: {found} of {n}");
    }
}

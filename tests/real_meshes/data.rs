//! The files of the data folder that the tests read.

use std::path::Path;

tests![every_file_is_there];

pub const SINGLE: [&str; 6] = [
    "single/bunny60k.off",
    "single/cheburashka.off",
    "single/homer.off",
    "single/horse97k.off",
    "single/spot.off",
    "single/springer.off",
];
pub const SUMNER: [&str; 6] = [
    "sumner/camel.off",
    "sumner/cat.off",
    "sumner/horse-pose01.off",
    "sumner/horse-pose05.off",
    "sumner/horse.off",
    "sumner/lion.off",
];
pub const TOSCA: [&str; 3] = ["tosca/cat0.off", "tosca/cat1.off", "tosca/dog0.off"];
pub const SHREC07: [&str; 8] = [
    "shrec07/381.off",
    "shrec07/383.off",
    "shrec07/385.off",
    "shrec07/387.off",
    "shrec07/392.off",
    "shrec07/394.off",
    "shrec07/397.off",
    "shrec07/400.off",
];
/// Meshes on which searches once did not end.
pub const HANG: [&str; 3] = ["hang/centaur0.off", "hang/centaur1-remeshed.off", "hang/remeshed-horse.off"];
/// Meshes that a user may drop by mistake.
pub const BAD: [&str; 6] = [
    "bad/camel-nonmanifold.off",
    "bad/cow-pinched-vertex.off",
    "bad/genus1-rocker-arm.off",
    "bad/horse-slit.off",
    "bad/open-teapot.off",
    "bad/suzanne-parts.off",
];

/// Meshes as they are found, with holes, loose parts and handles.
pub const OPEN: [&str; 7] = [
    "open/alligator-open.off",
    "open/bunny-open.off",
    "open/demosthenes-open.off",
    "open/dog0-open.off",
    "open/falcon-open.off",
    "open/human-parts.off",
    "open/skull-genus2.off",
];

/// The names of six pairs of animals and poses, and of all pairs of SHREC07.
pub fn pair_names() -> Vec<String> {
    let named = ["cat-cat1", "cat-dog", "cat-lion", "horse-camel", "horse-horse01", "horse-horse05"];
    let number = |k: usize| SHREC07[k].trim_start_matches("shrec07/").trim_end_matches(".off");
    let animals = (0..SHREC07.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    let pairs = animals.map(|(a, b)| format!("shrec07-{}-{}", number(a), number(b)));
    named.map(str::to_owned).into_iter().chain(pairs).collect()
}

fn every_file_is_there(data: &Path) {
    let meshes = [&SINGLE[..], &SUMNER, &TOSCA, &SHREC07, &HANG, &BAD, &OPEN].concat();
    let pairs = pair_names().into_iter().map(|name| format!("pairs/{name}.json"));
    let files = meshes.into_iter().map(str::to_owned).chain(pairs);
    let missing: Vec<String> = files.filter(|file| !data.join(file).is_file()).collect();
    assert!(missing.is_empty(), "{} lacks {}", data.display(), missing.join(", "));
}

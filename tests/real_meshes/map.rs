//! Both parametrisations onto the cone surface, certified, and their composition, on real pairs.

use crate::common::read_pair;
use crate::theorems::parametrisations_are_certified;
use std::path::Path;

tests![pairs_are_certified];

/// Pairs with poses of one animal, different animals, few and many landmarks, slivers, and long limbs.
const PAIRS: [&str; 7] = [
    "cat-lion",
    "horse-camel",
    "horse-horse05",
    "shrec07-381-400",
    "shrec07-385-397",
    "shrec07-392-394",
    "shrec07-397-400",
];

fn pairs_are_certified(data: &Path) {
    for name in PAIRS {
        parametrisations_are_certified(&read_pair(data, name).into());
    }
}

//! The base domain drawn on real pairs.

use crate::common::read_pair;
use crate::data::pair_names;
use crate::theorems::has_a_valid_layout;
use std::path::Path;

tests![; long: every_pair_has_a_valid_layout];

fn every_pair_has_a_valid_layout(data: &Path) {
    for name in pair_names() {
        has_a_valid_layout(&read_pair(data, &name).into());
    }
}

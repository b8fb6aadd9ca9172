//! The search for the isotopy class on poses whose map is known.

use crate::classes::known_class_is_found;
use crate::common::read_pair;
use std::path::Path;

tests![poses_find_the_class_of_the_known_map];

fn poses_find_the_class_of_the_known_map(data: &Path) {
    for name in ["horse-horse05", "cat-cat1"] {
        known_class_is_found(&read_pair(data, name).into());
    }
}

//! The thesis' patchwise map on a real pair.

use crate::common::read_pair;
use crate::theorems::patchwise_map_tells_what_is_missing;
use std::path::Path;

tests![the_patchwise_map_of_cat_and_lion_tells_what_is_missing];

fn the_patchwise_map_of_cat_and_lion_tells_what_is_missing(data: &Path) {
    patchwise_map_tells_what_is_missing(&read_pair(data, "cat-lion").into());
}

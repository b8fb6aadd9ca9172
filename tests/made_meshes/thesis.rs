//! The thesis' patchwise map on a demo.

use crate::fixtures;
use crate::theorems::patchwise_map_tells_what_is_missing;

#[test]
fn the_patchwise_map_of_horse_and_cat_tells_what_is_missing() {
    patchwise_map_tells_what_is_missing(&fixtures::demo("horse-cat"));
}

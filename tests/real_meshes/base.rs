//! Base domains by quadric error simplification, drawn on both meshes of every real pair, in both directions.

use crate::common::read_pair;
use crate::data::pair_names;
use crate::theorems::{Case, simplified_base_is_drawn};
use std::path::Path;

tests![simplified_base_domains_are_drawn_or_refused];

fn simplified_base_domains_are_drawn_or_refused(data: &Path) {
    let mut refused = Vec::new();
    for name in pair_names() {
        let forwards = Case::from(read_pair(data, &name));
        for case in [forwards.exchanged(), forwards] {
            if !simplified_base_is_drawn(&case) {
                refused.push(case.name);
            }
        }
    }
    assert!(refused.is_empty(), "{refused:?}");
}

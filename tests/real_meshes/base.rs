//! Base domains by quadric error simplification, drawn on both meshes of every real pair, in both directions.

use crate::common::read_pair;
use crate::data::pair_names;
use crate::theorems::{Case, simplified_base_is_drawn};
use std::path::Path;

tests![; long: every_simplified_base_domain_is_drawn];

fn every_simplified_base_domain_is_drawn(data: &Path) {
    for name in pair_names() {
        let case = Case::from(read_pair(data, &name));
        simplified_base_is_drawn(&case);
        simplified_base_is_drawn(&case.exchanged());
    }
}

//! The flow converges on every real mesh and landmark set.

use crate::common::{farthest_points, read_mesh};
use crate::data::SINGLE;
use crate::theorems::{fixed_triangulation_fails_and_says_so, flow_converges};
use std::path::Path;

tests![every_single_mesh_converges; long: the_fixed_triangulation_says_that_it_did_not_converge];

fn every_single_mesh_converges(data: &Path) {
    for name in SINGLE {
        let mesh = read_mesh(&data.join(name));
        flow_converges(name, &mesh, &farthest_points(&mesh, 33));
    }
}

fn the_fixed_triangulation_says_that_it_did_not_converge(data: &Path) {
    let mesh = read_mesh(&data.join("single/homer.off"));
    fixed_triangulation_fails_and_says_so(&mesh, &farthest_points(&mesh, 33));
}

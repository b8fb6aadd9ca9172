//! Tests of the command line on real meshes.

use crate::command_line::{a_failed_flow_reports, conemap_in_a_minute, errors, folder, map_and_check};
use crate::common::{farthest_points, read_mesh};
use crate::data::{HANG, SINGLE};
use conemap::io::landmark_file;
use serde_json::Value;
use std::ffi::OsStr;
use std::path::Path;

tests![
    suggestions_end_on_all_meshes,
    maps_a_real_pair;
    long:
    a_flow_that_does_not_converge_fails_and_still_reports,
];

fn suggestions_end_on_all_meshes(data: &Path) {
    for name in SINGLE.iter().chain(&HANG) {
        let output = conemap_in_a_minute([OsStr::new("suggest"), data.join(name).as_os_str()]);
        assert!(output.status.success(), "{name}: {}", errors(&output));
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(!json["suggestions"].as_array().unwrap().is_empty(), "{name}");
    }
}

fn maps_a_real_pair(data: &Path) {
    let pairs = data.join("pairs/shrec07-397-400.json");
    let text = std::fs::read(&pairs).unwrap_or_else(|e| panic!("{}: {e}", pairs.display()));
    let file = landmark_file::read(&text).unwrap();
    let [source, target] = [file.source, file.target].map(|mesh| data.join(mesh.unwrap()));
    map_and_check([&source, &target, &pairs], &folder("maps_a_real_pair"));
}

fn a_flow_that_does_not_converge_fails_and_still_reports(data: &Path) {
    let mesh = data.join("single/homer.off");
    let vertices = farthest_points(&read_mesh(&mesh), 33);
    a_failed_flow_reports(&mesh, &vertices, &folder("a_flow_that_does_not_converge/homer"));
}

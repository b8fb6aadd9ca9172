//! Tests that files that a user may drop by mistake end in the sentence that says what is wrong.

use crate::common::read_mesh;
use crate::data::{SHREC07, SINGLE, SUMNER, TOSCA};
use conemap::io;
use conemap::mesh::check::{MeshFault, closed_genus_zero};
use std::path::Path;

tests![bad_meshes_end_in_the_right_fault, good_meshes_pass];

fn bad_meshes_end_in_the_right_fault(data: &Path) {
    let fault = |name: &str| {
        let path = data.join("bad").join(format!("{name}.off"));
        let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        closed_genus_zero(&io::read_mesh(&bytes).unwrap()).unwrap_err()
    };
    let edges = |name: &str| match fault(name) {
        MeshFault::NonManifoldEdges { edges, parts } => (edges.count, parts),
        MeshFault::OpenEdges(edges) => (edges.count, 0),
        other => panic!("{name}: {other}"),
    };
    assert_eq!(edges("camel-nonmanifold").0, 26);
    assert_eq!(edges("horse-slit"), (19, 0));
    assert_eq!(edges("open-teapot"), (1036, 0));
    assert_eq!(edges("suzanne-parts"), (1, 4));
    assert_eq!(fault("genus1-rocker-arm"), MeshFault::Genus { genus: 1 });
    assert!(matches!(fault("cow-pinched-vertex"), MeshFault::PinchedVertices(v) if v.first == [253]));
}

fn good_meshes_pass(data: &Path) {
    for name in SINGLE.iter().chain(&SUMNER).chain(&TOSCA).chain(&SHREC07) {
        assert_eq!(read_mesh(&data.join(name)).euler_characteristic(), 2, "{name}");
    }
}

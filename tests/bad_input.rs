//! What a user drops by mistake ends in the sentence that says what is wrong.

mod common;

use conemap::io;
use conemap::mesh::check::{MeshFault, closed_genus_zero};

#[test]
fn bad_meshes_end_in_the_right_fault() {
    let Some(data) = common::data_folder("bad_meshes_end_in_the_right_fault") else { return };
    let fault = |name: &str| {
        let bytes = std::fs::read(data.join("bad").join(format!("{name}.off"))).unwrap();
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

#[test]
fn good_meshes_pass() {
    let Some(data) = common::data_folder("good_meshes_pass") else { return };
    let mut count = 0;
    for folder in ["single", "sumner", "tosca", "shrec07"] {
        for entry in std::fs::read_dir(data.join(folder)).unwrap() {
            let mesh = common::read_mesh(&entry.unwrap().path());
            assert_eq!(mesh.euler_characteristic(), 2);
            count += 1;
        }
    }
    assert!(count >= 23, "{count} meshes");
}

//! What a user drops by mistake ends in the sentence that says what is wrong.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod common;

use conemap::io;
use conemap::mesh::check::{MeshFault, closed_genus_zero};

fn fault(name: &str) -> Option<MeshFault> {
    let data = common::data_folder(name)?;
    let bytes = std::fs::read(data.join("bad").join(format!("{name}.off"))).unwrap();
    let fault = closed_genus_zero(&io::read_mesh(&bytes).unwrap()).unwrap_err();
    Some(fault)
}

type Check = fn(&MeshFault) -> bool;

#[test]
fn bad_meshes_end_in_the_right_fault() {
    let expected: [(&str, Check); 6] = [
        ("camel-nonmanifold", |f| matches!(f, MeshFault::NonManifoldEdges { .. })),
        ("cow-pinched-vertex", |f| matches!(f, MeshFault::PinchedVertices(_))),
        ("genus1-rocker-arm", |f| *f == MeshFault::Genus { genus: 1 }),
        ("horse-slit", |f| matches!(f, MeshFault::OpenEdges(_))),
        ("open-teapot", |f| matches!(f, MeshFault::OpenEdges(_))),
        (
            "suzanne-parts",
            |f| matches!(f, MeshFault::NonManifoldEdges { edges, parts: 2.. } if edges.count == 1),
        ),
    ];
    for (name, is_right) in expected {
        let Some(fault) = fault(name) else { return };
        assert!(is_right(&fault), "{name}: {fault}");
    }
}

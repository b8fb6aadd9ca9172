//! Tests on bodies with sharp edges: their flat faces are slivers, and many of their landmarks lie in line.

use crate::points::with_landmarks_at;
use conemap::math::scalar::{cos, sin};
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::pipeline::DistortionReport;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A polygon, moved along z by a height. `cap` has the triangles of the polygon, counter-clockwise.
fn prism(outline: &[DVec2], cap: &[[u32; 3]], height: f64) -> SurfaceMesh {
    let count = outline.len() as u32;
    let at = |z: f64| outline.iter().map(move |p| p.extend(z));
    let positions: Vec<DVec3> = at(0.0).chain(at(height)).collect();
    let mut faces: Vec<[u32; 3]> =
        cap.iter().flat_map(|&[a, b, c]| [[a, c, b], [a, b, c].map(|v| v + count)]).collect();
    for a in 0..count {
        let b = (a + 1) % count;
        faces.extend([[a, b, b + count], [a, b + count, a + count]]);
    }
    SurfaceMesh::from_triangles(positions.into(), faces.iter().map(|f| f.map(VertexId)).collect()).unwrap()
}

/// A round prism whose ends are fans of slivers.
fn round(sides: u32, height: f64) -> SurfaceMesh {
    let corner = |k: u32| {
        let angle = TAU * f64::from(k) / f64::from(sides);
        DVec2::new(cos(angle), sin(angle))
    };
    let fan: Vec<[u32; 3]> = (1..sides - 1).map(|k| [0, k, k + 1]).collect();
    prism(&(0..sides).map(corner).collect::<Vec<_>>(), &fan, height)
}

/// A comb of three teeth.
fn comb(height: f64) -> SurfaceMesh {
    let corners = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 4.0],
        [4.0, 4.0],
        [4.0, 1.0],
        [3.0, 1.0],
        [3.0, 4.0],
        [2.0, 4.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 4.0],
        [0.0, 4.0],
    ];
    let cap = [
        [1, 2, 3],
        [1, 3, 4],
        [0, 1, 4],
        [0, 4, 5],
        [5, 6, 7],
        [5, 7, 8],
        [0, 5, 8],
        [0, 8, 9],
        [11, 0, 9],
        [9, 10, 11],
    ];
    prism(&corners.map(DVec2::from), &cap, height)
}

/// The distortion of the certified map between two meshes with the same vertices, these among them as landmarks.
fn onto(source: &SurfaceMesh, target: &SurfaceMesh, landmarks: &[u32]) -> DistortionReport {
    let meshes = [source, target];
    let at = |mesh| landmarks.iter().map(|&v| SurfacePoint::at_vertex(mesh, VertexId(v))).collect();
    with_landmarks_at(meshes, meshes.map(at))
}

#[test]
fn slivers_do_not_spoil_the_identity() {
    for (sides, height) in [(64, 1.0), (48, 2.0)] {
        let mesh = round(sides, height);
        // Four corners in a row.
        let found = onto(&mesh, &mesh, &[0, 1, 2, 3]);
        assert!(found.energy < 4.03 && found.dented < 3e-4, "{sides}: {} {}", found.energy, found.dented);
    }
    let tall = round(64, 20.0);
    let every_third: Vec<u32> = (0..128).step_by(3).collect();
    let found = onto(&tall, &tall, &every_third);
    assert!(found.energy < 4.1, "{}", found.energy);
}

#[test]
fn landmarks_in_line_have_a_map() {
    let (thin, thick) = (comb(1.0), comb(1.5));
    let all: Vec<u32> = (0..24).collect();
    let found = onto(&thin, &thin, &all);
    assert!(found.energy < 4.01, "{}", found.energy);
    let found = onto(&thin, &thick, &all);
    assert!(found.energy < 4.5, "{}", found.energy);
}

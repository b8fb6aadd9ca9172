//! Landmarks where people click: inside faces and beside edges, not only at vertices.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod common;

use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::mesh::insertion::insert;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{DistortionReport, GroundTruth, MapInput, PipelineOptions, run};

/// The distortion of the certified map whose landmarks lie at points of the faces beside the given vertices.
fn with_points(meshes: [&SurfaceMesh; 2], vertices: [&[VertexId]; 2], weights: [f64; 3]) -> DistortionReport {
    let inserted = [0, 1].map(|k| {
        let beside = |&v: &VertexId| {
            let at = SurfacePoint::at_vertex(meshes[k], v);
            let own = (0..3).find(|&c| at.barycentric[c] == 1.0).unwrap();
            let mut barycentric = [0.0; 3];
            (0..3).for_each(|c| barycentric[(own + c) % 3] = weights[c]);
            SurfacePoint { face: at.face, barycentric }
        };
        insert(meshes[k], &vertices[k].iter().map(beside).collect::<Vec<_>>()).unwrap()
    });
    let landmarks = Landmarks { source: inserted[0].vertices.clone(), target: inserted[1].vertices.clone() };
    let input = MapInput {
        source: &inserted[0].mesh,
        target: &inserted[1].mesh,
        landmarks: &landmarks,
        ground_truth: GroundTruth::Unknown,
    };
    let report = run(input, &PipelineOptions::default(), &mut Silent).unwrap().report;
    assert!(report.certificate.unwrap().bijective);
    report.distortion
}

#[test]
fn the_demo_has_as_good_a_map_from_points_in_faces() {
    let demo = demo::build("horse-cat").unwrap();
    let side = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect::<Vec<_>>();
    let vertices = [side(0), side(1)];
    let map =
        |weights| with_points([&demo.source, &demo.target], [&vertices[0], &vertices[1]], weights).energy;
    let at_vertices = map([1.0, 0.0, 0.0]);
    for weights in [[0.6, 0.2, 0.2], [0.5, 0.5, 0.0]] {
        let energy = map(weights);
        assert!((energy / at_vertices - 1.0).abs() < 0.05, "{weights:?}: {energy} against {at_vertices}");
    }
    // Nearer to the edge than anybody can click is on the edge.
    let (on, beside) = (map([0.5, 0.5, 0.0]), map([0.5, 0.5 - 1e-7, 1e-7]));
    assert!((on / beside - 1.0).abs() < 0.005, "{on} {beside}");
}

#[test]
fn cat_and_lion_have_as_good_a_map_from_points_in_faces() {
    let Some(data) = common::data_folder("cat_and_lion_have_as_good_a_map_from_points_in_faces") else {
        return;
    };
    let pair = common::read_pair(&data, "cat-lion");
    let landmarks = common::landmarks(&pair);
    let vertices: [&[VertexId]; 2] = [&landmarks.source, &landmarks.target];
    let distortion = with_points([&pair.source, &pair.target], vertices, [0.6, 0.2, 0.2]);
    assert!(distortion.energy < 4.4 && distortion.max < 1e4, "{distortion:?}");
}

//! Maps whose landmarks lie inside faces.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::landmarks::Landmarks;
use conemap::mesh::insertion::insert;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{CapFaces, DistortionReport, GroundTruth, MapInput, PipelineOptions, run};

/// The distortion of the certified map whose landmarks lie at points of the faces beside the given vertices.
pub fn with_points(
    meshes: [&SurfaceMesh; 2],
    vertices: [&[VertexId]; 2],
    weights: [f64; 3],
) -> DistortionReport {
    let places = [0, 1].map(|k| {
        let beside = |&v: &VertexId| {
            let at = SurfacePoint::at_vertex(meshes[k], v);
            let own = (0..3).find(|&c| at.barycentric[c] == 1.0).unwrap();
            let mut barycentric = [0.0; 3];
            (0..3).for_each(|c| barycentric[(own + c) % 3] = weights[c]);
            SurfacePoint { face: at.face, barycentric }
        };
        vertices[k].iter().map(beside).collect()
    });
    with_landmarks_at(meshes, places)
}

/// The distortion of the certified map whose landmarks lie at the given points.
pub fn with_landmarks_at(meshes: [&SurfaceMesh; 2], places: [Vec<SurfacePoint>; 2]) -> DistortionReport {
    let inserted = [0, 1].map(|k| insert(meshes[k], &places[k]).unwrap());
    let landmarks = Landmarks {
        source: inserted[0].vertices.clone().into(),
        target: inserted[1].vertices.clone().into(),
    };
    let input = MapInput {
        source: &inserted[0].mesh,
        target: &inserted[1].mesh,
        landmarks: &landmarks,
        ground_truth: GroundTruth::Unknown,
        caps: CapFaces::default(),
    };
    let report = run(input, &PipelineOptions::default(), &mut Silent).unwrap().report;
    assert!(report.certificate.unwrap().bijective);
    report.distortion
}

//! Tests of remeshing on surfaces that are given with slivers.

use crate::common;
use crate::remeshing::remeshed;
use conemap::remesh::Options;
use std::path::Path;

tests![real_meshes_with_slivers];

fn real_meshes_with_slivers(data: &Path) {
    for (name, share) in [("sumner/camel", 0.25), ("single/spot", 1.0), ("shrec07/400", 2.0)] {
        let surface = common::read_mesh(&data.join(name).with_extension("off"));
        let faces = (share * surface.face_count() as f64) as usize;
        let report = remeshed(name, &surface, &Options::to_faces(faces)).report;
        assert!(report.mean_min_angle > 48.0, "{name}: {report:?}");
        assert!(report.edge_length.deviation < 0.2 * report.edge_length.mean, "{name}: {report:?}");
        let edges = 3.0 * report.edge_length.mean;
        assert!(report.distance.to_original < edges && report.distance.from_original < edges, "{report:?}");
    }
}

//! The flow converges on every real mesh and landmark set.

use crate::common::{farthest_points, read_mesh};
use crate::data::SINGLE;
use crate::theorems::flow_converges;
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::monitor::Silent;
use std::path::Path;

tests![every_single_mesh_converges, the_fixed_triangulation_says_that_it_did_not_converge];

fn every_single_mesh_converges(data: &Path) {
    for name in SINGLE {
        let mesh = read_mesh(&data.join(name));
        flow_converges(name, &mesh, &farthest_points(&mesh, 33));
    }
}

fn the_fixed_triangulation_says_that_it_did_not_converge(data: &Path) {
    let mesh = read_mesh(&data.join("single/homer.off"));
    let target = uniform_curvature(mesh.vertex_count(), &farthest_points(&mesh, 33));
    let options = FlowOptions { scheme: Scheme::FixedTriangulation, ..FlowOptions::default() };
    match flow(&mesh, &target, &options, &mut Silent) {
        Err(FlowError::NotConverged { best, report }) => {
            assert!(best > 1e-3 && best.is_finite());
            assert_eq!(report.residuals.len(), report.newton_steps + 1);
        }
        other => panic!("expected not converged, got {:?}", other.map(|(_, r)| r)),
    }
}

//! The flow converges on every real mesh and landmark set.

mod common;

use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::monitor::Silent;

#[test]
fn every_single_mesh_converges() {
    let Some(data) = common::data_folder("every_single_mesh_converges") else { return };
    for name in ["homer", "cheburashka", "springer", "spot", "bunny60k", "horse97k"] {
        let mesh = common::read_mesh(&data.join("single").join(format!("{name}.off")));
        let landmarks = common::farthest_points(&mesh, 33);
        let target = uniform_curvature(mesh.vertex_count(), &landmarks);
        for scheme in [Scheme::InversiveDistance, Scheme::VertexScaling] {
            let options = FlowOptions { scheme, ..FlowOptions::default() };
            let (_, report) =
                flow(&mesh, &target, &options, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert!(report.max_curvature_error < 1e-8, "{name} {scheme:?}: {report:?}");
        }
    }
}

#[test]
fn the_fixed_triangulation_says_that_it_did_not_converge() {
    let Some(data) = common::data_folder("the_fixed_triangulation_says_that_it_did_not_converge") else {
        return;
    };
    let mesh = common::read_mesh(&data.join("single/homer.off"));
    let target = uniform_curvature(mesh.vertex_count(), &common::farthest_points(&mesh, 33));
    let options = FlowOptions { scheme: Scheme::FixedTriangulation, ..FlowOptions::default() };
    match flow(&mesh, &target, &options, &mut Silent) {
        Err(FlowError::NotConverged { best, report }) => {
            assert!(best > 1e-3 && best.is_finite());
            assert_eq!(report.residuals.len(), report.newton_steps + 1);
        }
        other => panic!("expected not converged, got {:?}", other.map(|(_, r)| r)),
    }
}

//! The flow converges on all demos, as they are, with other triangles and made rough.

use crate::fixtures;
use crate::theorems::{Case, flow_converges};
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::monitor::Silent;

fn both_sides_converge(case: &Case) {
    flow_converges(&case.name, &case.source, &case.landmarks.source);
    flow_converges(&case.name, &case.target, &case.landmarks.target);
}

#[test]
fn every_demo_converges() {
    fixtures::demos().iter().for_each(both_sides_converge);
}

#[test]
fn demos_of_other_sizes_converge() {
    for faces in [[1000, 20_000], [20_000, 1000]] {
        both_sides_converge(&fixtures::remeshed_demo("horse-cat", faces));
    }
}

#[test]
fn rough_demos_converge() {
    for id in ["horse-cat", "poses", "sphere-tetrahedron"] {
        both_sides_converge(&fixtures::rough_demo(id));
    }
}

#[test]
fn the_fixed_triangulation_says_that_it_did_not_converge() {
    let case = fixtures::demo("horse-cat");
    let target = uniform_curvature(case.source.vertex_count(), &case.landmarks.source);
    let options = FlowOptions { scheme: Scheme::FixedTriangulation, ..FlowOptions::default() };
    match flow(&case.source, &target, &options, &mut Silent) {
        Err(FlowError::NotConverged { best, report }) => {
            assert!(best > 1e-3 && best.is_finite());
            assert_eq!(report.residuals.len(), report.newton_steps + 1);
        }
        other => panic!("expected not converged, got {:?}", other.map(|(_, r)| r)),
    }
}

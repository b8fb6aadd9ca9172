//! The flow converges on every real mesh and landmark set.

use crate::common::{farthest_points, read_mesh, read_pair};
use crate::data::SINGLE;
use crate::other_triangles::cut_by_planes;
use crate::theorems::{Case, fixed_triangulation_fails_and_says_so, flow_converges, map_is_certified};
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::mesh::SurfaceMesh;
use conemap::monitor::Silent;
use conemap::pipeline::Warning;
use conemap::remesh::EdgeLengths;
use std::path::Path;

tests![
    every_single_mesh_converges,
    slivers_converge;
    long:
    a_map_onto_slivers_has_a_cone_metric,
    the_fixed_triangulation_says_that_it_did_not_converge,
];

fn every_single_mesh_converges(data: &Path) {
    for name in SINGLE {
        let mesh = read_mesh(&data.join(name));
        flow_converges(name, &mesh, &farthest_points(&mesh, 33));
    }
}

/// Cut by planes, a camel has triangles of a height of 1e-8 of their length. Vertex scaling takes a few steps more than on the camel as it is;
/// inversive distances may be lost in rounding, and then say so soon.
fn slivers_converge(data: &Path) {
    let mesh = read_mesh(&data.join("sumner/camel.off"));
    let landmarks = farthest_points(&mesh, 33);
    let cut = cut_by_planes(&mesh, 2.0 * EdgeLengths::of(&mesh).mean);
    let flown = |mesh: &SurfaceMesh, scheme: Scheme| {
        let options = FlowOptions { scheme, ..FlowOptions::default() };
        flow(mesh, &uniform_curvature(mesh.vertex_count(), &landmarks), &options, &mut Silent)
    };
    let [even, slivers] = [&mesh, &cut].map(|mesh| flown(mesh, Scheme::VertexScaling).unwrap().1);
    assert!(slivers.newton_steps <= even.newton_steps + 6, "{even:?} {slivers:?}");
    if let Err(error) = flown(&cut, Scheme::Inversive) {
        let FlowError::NotConverged { report, .. } = error else { panic!("{error}") };
        assert!(report.newton_steps < 50, "{report:?}");
    }
}

/// Where the flow of inversive distances is lost, that of vertex scaling gives the texture.
fn a_map_onto_slivers_has_a_cone_metric(data: &Path) {
    let mut case: Case = read_pair(data, "horse-camel").into();
    // Vertices keep their numbers.
    case.target = cut_by_planes(&case.target, 2.0 * EdgeLengths::of(&case.target).mean);
    let report = map_is_certified(&case, 4.7).report;
    assert!(
        !report.warnings.iter().any(|w| matches!(w, Warning::NoConeMetric { .. })),
        "{:?}",
        report.warnings
    );
}

fn the_fixed_triangulation_says_that_it_did_not_converge(data: &Path) {
    let mesh = read_mesh(&data.join("single/homer.off"));
    fixed_triangulation_fails_and_says_so(&mesh, &farthest_points(&mesh, 33));
}

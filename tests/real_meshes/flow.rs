//! The flow converges on every real mesh and landmark set.

use crate::common::{farthest_points, read_mesh};
use crate::data::SINGLE;
use crate::other_triangles::cut_by_planes;
use crate::theorems::{fixed_triangulation_fails_and_says_so, flow_converges};
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::mesh::SurfaceMesh;
use conemap::monitor::Silent;
use conemap::remesh::EdgeLengths;
use std::path::Path;

tests![every_single_mesh_converges, slivers_converge; long: the_fixed_triangulation_says_that_it_did_not_converge];

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

fn the_fixed_triangulation_says_that_it_did_not_converge(data: &Path) {
    let mesh = read_mesh(&data.join("single/homer.off"));
    fixed_triangulation_fails_and_says_so(&mesh, &farthest_points(&mesh, 33));
}

//! The flow converges on every real mesh and landmark set.

mod common;

use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;

/// Landmarks by farthest points in space: the first vertex, then the one farthest from all so far.
fn farthest_points(mesh: &SurfaceMesh, count: usize) -> Vec<VertexId> {
    let mut chosen = vec![VertexId(0)];
    let mut nearest: Vec<f64> = vec![f64::INFINITY; mesh.vertex_count()];
    while chosen.len() < count {
        let last = mesh.positions()[chosen[chosen.len() - 1]];
        for (d, p) in nearest.iter_mut().zip(mesh.positions()) {
            *d = d.min(p.distance(last));
        }
        let far = (0..nearest.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).expect("vertices");
        chosen.push(far.into());
    }
    chosen
}

#[test]
fn every_single_mesh_converges() {
    let Some(data) = common::data_folder("every_single_mesh_converges") else { return };
    for name in ["homer", "cheburashka", "springer", "spot", "bunny60k", "horse97k"] {
        let mesh = common::read_mesh(&data.join("single").join(format!("{name}.off")));
        let landmarks = farthest_points(&mesh, 33);
        let target = uniform_curvature(mesh.vertex_count(), &landmarks);
        for scheme in [Scheme::InversiveDistance, Scheme::VertexScaling] {
            let begun = std::time::Instant::now();
            let options = FlowOptions { scheme, ..FlowOptions::default() };
            let (_, report) =
                flow(&mesh, &target, &options, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
            println!(
                "{name} {scheme:?}: {} steps, {} cg, {} flips, {:.2e}, {:.3} s",
                report.newton_steps,
                report.cg_iterations,
                report.edge_flips,
                report.max_curvature_error,
                begun.elapsed().as_secs_f64()
            );
            assert!(report.max_curvature_error < 1e-8);
        }
    }
}

#[test]
fn the_fixed_triangulation_says_that_it_did_not_converge() {
    let Some(data) = common::data_folder("the_fixed_triangulation_says_that_it_did_not_converge") else {
        return;
    };
    let mesh = common::read_mesh(&data.join("single/homer.off"));
    let target = uniform_curvature(mesh.vertex_count(), &farthest_points(&mesh, 33));
    let options = FlowOptions { scheme: Scheme::FixedTriangulation, ..FlowOptions::default() };
    match flow(&mesh, &target, &options, &mut Silent) {
        Err(FlowError::NotConverged { best, report }) => {
            println!("fixed triangulation: best {best:.2e}, {:?}", report.residuals);
            assert!(best > 1e-3 && best.is_finite());
        }
        other => panic!("expected not converged, got {:?}", other.map(|(_, r)| r)),
    }
}

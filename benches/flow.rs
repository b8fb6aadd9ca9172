//! The flow to the base domain's cones, 33 landmarks by farthest points.

#[path = "../tests/common/mod.rs"]
mod common;

use conemap::base_domain::simplify;
use conemap::cone_metric::{FlowOptions, base_domain_curvature, flow};
use conemap::monitor::Silent;
use criterion::Criterion;

fn main() {
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    if let Some(data) = common::data_folder("the benchmarks of the flow") {
        for name in ["homer", "horse97k"] {
            let mesh = common::read_mesh(&data.join("single").join(format!("{name}.off")));
            let landmarks = common::farthest_points(&mesh, 33);
            let base = simplify(&mesh, &landmarks, &mut Silent).expect("a base domain");
            let target = base_domain_curvature(mesh.vertex_count(), &landmarks, &base);
            let options = FlowOptions::default();
            criterion.bench_function(&format!("flow/{name}"), |bencher| {
                bencher.iter(|| flow(&mesh, &target, &options, &mut Silent).expect("the flow converges"));
            });
        }
    }
    criterion.final_summary();
}

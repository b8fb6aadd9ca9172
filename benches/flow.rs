//! Times the discrete Ricci flow of a mesh to the cones of its base domain; 33 farthest points are the landmarks.

#[path = "../tests/common/mod.rs"]
mod common;

use conemap::base_domain::simplify;
use conemap::cone_metric::{FlowOptions, base_domain_curvature};
use conemap::monitor::Silent;
use divan::Bencher;

fn main() {
    divan::main();
}

#[divan::bench(args = ["homer", "horse97k"], sample_count = 10, sample_size = 1)]
fn flow(bencher: Bencher, name: &str) {
    let Some(data) = common::data_folder("the benchmarks of the flow") else { return };
    let mesh = common::read_mesh(&data.join("single").join(format!("{name}.off")));
    let landmarks = common::farthest_points(&mesh, 33);
    let base = simplify(&mesh, &landmarks, &mut Silent).expect("a base domain");
    let target = base_domain_curvature(mesh.vertex_count(), &landmarks, &base);
    let options = FlowOptions::default();
    let to_target = || conemap::cone_metric::flow(&mesh, &target, &options, &mut Silent);
    bencher.bench_local(|| to_target().expect("the flow converges"));
}

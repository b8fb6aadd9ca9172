//! The map from cat to lion: the whole, and each stage on its own.

#[path = "../tests/common/mod.rs"]
mod common;

use conemap::layout::{self, LayoutOptions};
use conemap::monitor::Silent;
use conemap::pipeline::{self, MapInput, PipelineOptions};
use conemap::surface_map::overlay::location::locate;
use conemap::surface_map::parametrisation::initial::{InitialOptions, embed, relax};
use conemap::surface_map::parametrisation::problem::FlatRelaxOptions;
use conemap::surface_map::{ConeSurface, overlay};
use criterion::Criterion;
use std::path::Path;
use std::sync::Arc;

fn main() {
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    if let Some(data) = common::data_folder("the benchmarks of the map") {
        cat_to_lion(&mut criterion, &data);
    }
    criterion.final_summary();
}

fn cat_to_lion(criterion: &mut Criterion, data: &Path) {
    let pair = common::read_pair(data, "cat-lion");
    let landmarks = common::landmarks(&pair);
    let meshes = [&pair.source, &pair.target];
    criterion.bench_function("cat-lion/whole", |bencher| {
        let [source, target] = meshes;
        let input = MapInput::new(source, target, &landmarks);
        let options = PipelineOptions::default();
        bencher.iter(|| pipeline::run(input, &options, &mut Silent).expect("a certified map"));
    });

    let options = LayoutOptions::default();
    let lay_out = || layout::joint(meshes, &landmarks, &options, &mut Silent).expect("a layout");
    criterion.bench_function("cat-lion/layout", |bencher| bencher.iter(lay_out));

    let layout = lay_out();
    let surface = Arc::new(ConeSurface::of_layout(&layout).expect("a cone surface"));
    let sides = [&layout.source, &layout.target];
    let options = InitialOptions::default();
    let start = || sides.map(|side| embed(side, &surface, &options, &mut Silent).expect("a start").0);
    criterion.bench_function("cat-lion/initial map, both sides", |bencher| bencher.iter(start));

    let starts = start();
    let options = FlatRelaxOptions::default();
    let relaxed = || {
        let side = |k: usize| {
            relax(sides[k].parametrised(&starts[k]), &surface, &options, &mut Silent).expect("runs").0
        };
        [side(0), side(1)]
    };
    criterion.bench_function("cat-lion/relaxation, both sides", |bencher| bencher.iter(relaxed));

    let ends = relaxed();
    let [source, target] = [0, 1].map(|k| sides[k].parametrised(&ends[k]));
    criterion.bench_function("cat-lion/composition and overlay", |bencher| {
        bencher.iter(|| {
            let locations = locate(source, target, &surface, &mut Silent).expect("every vertex is found");
            overlay::overlay(source, target, &locations, &mut Silent).expect("an overlay")
        });
    });
}

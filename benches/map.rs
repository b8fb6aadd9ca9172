//! Times the map from cat to lion as a whole, and single stages of it.

#[path = "../tests/common/mod.rs"]
mod common;

use conemap::landmarks::Landmarks;
use conemap::layout::{BaseLayout, LayoutOptions, PatchedMesh, joint};
use conemap::mesh::SurfaceMesh;
use conemap::monitor::Silent;
use conemap::pipeline::{self, MapInput, PipelineOptions};
use conemap::surface_map::overlay::location::locate;
use conemap::surface_map::parametrisation::embedding::Embedding;
use conemap::surface_map::parametrisation::initial::{self, InitialOptions, embed};
use conemap::surface_map::parametrisation::problem::FlatRelaxOptions;
use conemap::surface_map::{ConeSurface, overlay};
use divan::Bencher;
use std::sync::{Arc, LazyLock};

fn main() {
    divan::main();
}

/// Two meshes with their landmarks.
struct Pair {
    meshes: [SurfaceMesh; 2],
    landmarks: Landmarks,
}

/// The cat and the lion; `None` in a plain checkout, which has no data folder.
static CAT_AND_LION: LazyLock<Option<Pair>> = LazyLock::new(|| {
    let pair = common::read_pair(&common::data_folder("the benchmarks of the map")?, "cat-lion");
    let landmarks = common::landmarks(&pair);
    Some(Pair { meshes: [pair.source, pair.target], landmarks })
});

impl Pair {
    fn layout(&self) -> BaseLayout {
        let options = LayoutOptions::default();
        joint(self.meshes.each_ref(), &self.landmarks, &options, &mut Silent).expect("a layout")
    }
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn whole(bencher: Bencher) {
    let Some(Pair { meshes: [source, target], landmarks }) = &*CAT_AND_LION else { return };
    let input = MapInput::new(source, target, landmarks);
    let options = PipelineOptions::default();
    bencher.bench_local(|| pipeline::run(input, &options, &mut Silent).expect("a certified map"));
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn layout(bencher: Bencher) {
    let Some(pair) = &*CAT_AND_LION else { return };
    bencher.bench_local(|| pair.layout());
}

/// The layout of the pair and its cone surface, with which the later stages begin.
struct Laid {
    layout: BaseLayout,
    surface: Arc<ConeSurface>,
}

impl Laid {
    /// Makes the layout; `None` in a plain checkout.
    fn new() -> Option<Self> {
        let layout = CAT_AND_LION.as_ref()?.layout();
        let surface = Arc::new(ConeSurface::of_layout(&layout));
        Some(Self { layout, surface })
    }

    fn sides(&self) -> [&PatchedMesh; 2] {
        [&self.layout.source, &self.layout.target]
    }

    fn start(&self) -> [Embedding; 2] {
        let options = InitialOptions::default();
        self.sides().map(|side| embed(side, &self.surface, &options, &mut Silent).expect("a start").0)
    }

    fn relaxed(&self, starts: &[Embedding; 2]) -> [Embedding; 2] {
        let options = FlatRelaxOptions::default();
        let relaxed = |k: usize| {
            let start = self.sides()[k].parametrised(&starts[k]);
            initial::relax(start, &self.surface, &options, &mut Silent).expect("it runs").0
        };
        [relaxed(0), relaxed(1)]
    }
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn initial_map_of_both_sides(bencher: Bencher) {
    let Some(laid) = Laid::new() else { return };
    bencher.bench_local(|| laid.start());
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn relaxation_of_both_sides(bencher: Bencher) {
    let Some(laid) = Laid::new() else { return };
    let starts = laid.start();
    bencher.bench_local(|| laid.relaxed(&starts));
}

#[divan::bench(sample_count = 10, sample_size = 1)]
fn composition_and_overlay(bencher: Bencher) {
    let Some(laid) = Laid::new() else { return };
    let ends = laid.relaxed(&laid.start());
    let [source, target] = [0, 1].map(|k| laid.sides()[k].parametrised(&ends[k]));
    bencher.bench_local(|| {
        let locations = locate(source, target, &laid.surface, &mut Silent).expect("every vertex is found");
        overlay::overlay(source, target, &locations, &mut Silent).expect("an overlay")
    });
}

//! Measures how the time of a whole map (all stages, on one thread) grows with the number of faces, and how near the map's energy is to
//! that of a map that is relaxed until nothing moves. The horse and cat demo, or a pair of the data folder that the command line names
//! (`cargo bench --bench scaling -- cat-dog`), is subdivided again and again. A table is printed, with the exponent of the growth.
#![allow(clippy::print_stdout, clippy::expect_used, reason = "a benchmark prints its figures")]

#[path = "../tests/common/mod.rs"]
mod common;

use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::math::scalar::ln;
use conemap::mesh::generators::midpoint_subdivision;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{self, MapInput, PipelineOptions, Report};
use conemap::surface_map::relaxation::map_relaxation::MapRelaxationOptions;
use std::time::Instant;

/// The largest number of faces of a mesh that is mapped.
const MOST_FACES: usize = 350_000;
/// The largest number of faces of a mesh that is also relaxed until nothing moves, which takes minutes.
const MOST_CONVERGED: usize = 100_000;

fn main() {
    let named = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let Some((mut source, mut target, landmarks)) = named.map_or_else(|| Some(demo()), |name| pair(&name))
    else {
        return;
    };
    println!("faces source  faces target  seconds       E  bijective  E converged  seconds");
    let mut measured: Vec<(f64, f64)> = Vec::new();
    while source.face_count().max(target.face_count()) <= MOST_FACES {
        let input = MapInput::new(&source, &target, &landmarks);
        let (report, seconds) = timed(input, &PipelineOptions::default());
        print!(
            "{:12}  {:12}  {seconds:7.2}  {:6.4}  {:9}",
            source.face_count(),
            target.face_count(),
            report.distortion.energy,
            report.certificate.is_some_and(|c| c.bijective)
        );
        if source.face_count().max(target.face_count()) <= MOST_CONVERGED {
            let (converged, seconds) = timed(input, &until_nothing_moves());
            print!("  {:11.4}  {seconds:7.2}", converged.distortion.energy);
        }
        println!();
        measured.push(((source.face_count() + target.face_count()) as f64, seconds));
        // The subdivision keeps the numbers of the vertices, and with them the landmarks.
        (source, target) = (midpoint_subdivision(&source), midpoint_subdivision(&target));
    }
    if let [first, .., last] = measured[..] {
        println!("exponent {:.2}", ln(last.1 / first.1) / ln(last.0 / first.0));
    }
}

fn demo() -> (SurfaceMesh, SurfaceMesh, Landmarks) {
    let demo = demo::build("horse-cat").expect("a demo");
    let side = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect();
    let landmarks = Landmarks { source: side(0), target: side(1) };
    (demo.source, demo.target, landmarks)
}

fn pair(name: &str) -> Option<(SurfaceMesh, SurfaceMesh, Landmarks)> {
    let pair = common::read_pair(&common::data_folder("the benchmark of a named pair")?, name);
    let landmarks = common::landmarks(&pair);
    Some((pair.source, pair.target, landmarks))
}

fn timed(input: MapInput<'_>, options: &PipelineOptions) -> (Report, f64) {
    let start = Instant::now();
    let map = pipeline::run(input, options, &mut Silent).expect("a certified map");
    (map.report, start.elapsed().as_secs_f64())
}

/// The default options, except that every finer level is relaxed until a round lowers the energy by less than 1e-6 of it, or for 200 rounds.
fn until_nothing_moves() -> PipelineOptions {
    let mut options = PipelineOptions::default();
    let fine = options.multilevel.fine;
    options.multilevel.fine = MapRelaxationOptions { max_rounds: 200, relative_decrease: 1e-6, ..fine };
    options
}

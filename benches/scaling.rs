//! How the time of a whole map grows with the meshes: the horse and cat demo subdivided from about 5 000 to 300 000 faces
//! each, all stages, one thread. Prints a table and the exponent of the growth.
#![allow(clippy::print_stdout, clippy::expect_used, reason = "a benchmark prints its figures")]

use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::math::scalar::ln;
use conemap::mesh::VertexId;
use conemap::mesh::generators::midpoint_subdivision;
use conemap::monitor::Silent;
use conemap::pipeline::{self, GroundTruth, MapInput, PipelineOptions};
use std::time::Instant;

fn main() {
    let demo = demo::build("horse-cat").expect("a demo");
    let side = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect();
    let landmarks = Landmarks { source: side(0), target: side(1) };
    let (mut source, mut target) = (demo.source, demo.target);
    println!("faces source  faces target  seconds      E   bijective");
    let mut measured: Vec<(f64, f64)> = Vec::new();
    while source.face_count().max(target.face_count()) <= 350_000 {
        let start = Instant::now();
        let input = MapInput {
            source: &source,
            target: &target,
            landmarks: &landmarks,
            ground_truth: GroundTruth::Unknown,
        };
        let map = pipeline::run(input, &PipelineOptions::default(), &mut Silent).expect("a certified map");
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{:12}  {:12}  {seconds:7.2}  {:5.3}   {}",
            source.face_count(),
            target.face_count(),
            map.report.distortion.energy,
            map.report.certificate.is_some_and(|c| c.bijective)
        );
        measured.push(((source.face_count() + target.face_count()) as f64, seconds));
        // Midpoints keep the vertices' numbers, and with them the landmarks.
        (source, target) = (midpoint_subdivision(&source), midpoint_subdivision(&target));
    }
    let (first, last) = (measured[0], measured[measured.len() - 1]);
    println!("exponent {:.2}", ln(last.1 / first.1) / ln(last.0 / first.0));
}

//! The whole pipeline on the demos, natively and as wasm in Node: the same expectations, and the same bits.
//!
//! The native run leaves its results in Cargo's folder for temporary test files; the run in Node compares its own with
//! them. So the native run comes first: `cargo test --test node`, then
//! `cargo test --target wasm32-unknown-unknown --no-default-features --test node`.

#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

use conemap::cone_metric::{FlowOptions, flow, uniform_curvature};
use conemap::demo::{self, Demo};
use conemap::landmarks::Landmarks;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use conemap::pipeline::{self, CapFaces, GroundTruth, MapInput, MapResult, PipelineOptions};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// What a native run leaves for the run in Node.
#[cfg(not(target_arch = "wasm32"))]
mod kept {
    fn path(name: &str) -> std::path::PathBuf {
        std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.native.txt"))
    }

    /// Keeps the results for the run in Node.
    pub fn settle(name: &str, results: &str) {
        std::fs::write(path(name), results).expect("Cargo's folder for temporary test files is writable");
    }
}

/// Compares with what the native run has left.
#[cfg(target_arch = "wasm32")]
mod kept {
    use wasm_bindgen::prelude::*;

    #[wasm_bindgen(module = "node:fs")]
    extern "C" {
        #[wasm_bindgen(js_name = readFileSync, catch)]
        fn read_file(path: &str, encoding: &str) -> Result<String, JsValue>;
    }

    /// Fails where the native results differ, or are missing.
    pub fn settle(name: &str, results: &str) {
        // Builds for another target have their own folder, two below the native one.
        let path = format!("{}/../../tmp/{name}.native.txt", env!("CARGO_TARGET_TMPDIR"));
        let native = read_file(&path, "utf8")
            .unwrap_or_else(|_| panic!("{path} is missing: run `cargo test --test node` first"));
        assert_eq!(results, native, "{name}: wasm (left) differs from native (right, as of its last run)");
    }
}

/// A digest of the exact bits of numbers (FNV-1a). The sign of zero is left out: platforms differ in max(-0, 0).
fn digest(numbers: impl Iterator<Item = f64>) -> u64 {
    let bytes = numbers.flat_map(|x| (x + 0.0).to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn demo_and_landmarks(id: &str) -> (Demo, Landmarks) {
    let demo = demo::build(id).unwrap_or_else(|| panic!("there is a demo {id}"));
    let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &demo.landmarks).unwrap();
    (demo, landmarks)
}

/// Both meshes of a demo flow to equal cones at the landmarks.
#[test]
fn flows_converge_and_agree_with_native() {
    let (demo, landmarks) = demo_and_landmarks("horse-cat");
    let mut results = String::new();
    for (mesh, cones) in [(&demo.source, &landmarks.source), (&demo.target, &landmarks.target)] {
        let goal = uniform_curvature(mesh.vertex_count(), cones);
        let (_, report) = flow(mesh, &goal, &FlowOptions::default(), &mut Silent).unwrap();
        assert!(report.max_curvature_error <= FlowOptions::default().tolerance, "{report:?}");
        assert!(report.residuals.len() == report.newton_steps + 1, "{report:?}");
        results += &format!("{report:?}\n");
    }
    kept::settle("node_flow", &results);
}

#[test]
fn a_ball_onto_a_tetrahedron_agrees_with_native() {
    map_demo("sphere-tetrahedron", 6.0);
}

#[test]
fn a_horse_onto_a_cat_agrees_with_native() {
    map_demo("horse-cat", 8.0);
}

/// Maps a demo, checks the result against what is true of every map, and settles its bits.
fn map_demo(id: &str, most_energy: f64) {
    let (demo, landmarks) = demo_and_landmarks(id);
    let input = MapInput {
        source: &demo.source,
        target: &demo.target,
        landmarks: &landmarks,
        ground_truth: GroundTruth::Unknown,
        caps: CapFaces::default(),
    };
    let result = pipeline::run(input, &PipelineOptions::default(), &mut Silent).unwrap();
    check(&demo, &landmarks, &result, most_energy);
    let images = result.target_from_source.iter().flatten();
    let images = digest(images.flat_map(|p| p.barycentric.into_iter().chain([usize::from(p.face) as f64])));
    let distortion = digest(result.vertex_distortion.iter().copied());
    let report = serde_json::to_string_pretty(&result.report).unwrap();
    kept::settle(
        &format!("node_{id}"),
        &format!("images {images:016x}\ndistortion {distortion:016x}\n{report}\n"),
    );
}

fn check(demo: &Demo, landmarks: &Landmarks, result: &MapResult, most_energy: f64) {
    let certificate = result.report.certificate.as_ref().unwrap();
    assert!(certificate.bijective && certificate.flipped_triangles == 0, "{certificate:?}");
    let energy = result.report.distortion.energy;
    assert!((4.0..most_energy).contains(&energy), "energy {energy}");
    for flow in [&result.report.cone_metric.source, &result.report.cone_metric.target] {
        let flow = flow.as_ref().unwrap();
        assert!(flow.max_curvature_error <= FlowOptions::default().tolerance, "{flow:?}");
    }
    // The theorem of Gauss and Bonnet.
    let total: f64 = result.cone_curvatures.iter().sum();
    assert!((total - 4.0 * std::f64::consts::PI).abs() < 1e-9, "total curvature {total}");
    let image = |v: VertexId| result.target_from_source[v].unwrap();
    for v in demo.source.vertices() {
        let weights = image(v).barycentric;
        assert!(weights.iter().all(|w| (-1e-9..=1.0 + 1e-9).contains(w)), "vertex {v:?}: {weights:?}");
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-9, "vertex {v:?}: {weights:?}");
    }
    for (&from, &to) in landmarks.source.iter().zip(&landmarks.target) {
        let distance = image(from).position(&demo.target).distance(demo.target.positions()[to]);
        assert!(distance < 1e-9, "landmark {from:?} ends {distance} away from {to:?}");
    }
}

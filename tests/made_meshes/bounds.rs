//! Tests that landmarks in a senseless order, or as near to each other as possible, end in a certified map or in an error with a sentence,
//! after bounded work.

use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::math::random::SplitMix;
use conemap::mesh::SurfaceMesh;
use conemap::mesh::VertexId;
use conemap::mesh::generators::{icosphere, octahedron, tetrahedron};
use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use conemap::pipeline::{MapInput, MapResult, PipelineError, PipelineOptions, run};
use glam::DVec3;
use typed_index_collections::TiVec;

/// The number of questions to the monitor above which a run counts as unbounded; a usual run on these meshes asks some thousand times.
pub const MOST_QUESTIONS: usize = 400_000;

/// A monitor that counts the questions of a run, and stops the run after a given number.
pub struct Counter {
    asked: usize,
    most: usize,
    stage: Option<Stage>,
}

impl Counter {
    /// A monitor that stops the run after `most` questions.
    pub fn up_to(most: usize) -> Self {
        Self { asked: 0, most, stage: None }
    }
}

impl Monitor for Counter {
    fn enter(&mut self, stage: Stage) {
        self.stage = Some(stage);
    }

    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        self.asked += 1;
        if self.asked > self.most { Err(Cancelled) } else { Ok(()) }
    }
}

/// The outcome of a run; fails where the run asks too many questions.
fn bounded(meshes: [&SurfaceMesh; 2], pairs: &[[u32; 2]]) -> Result<MapResult, String> {
    let landmarks = Landmarks::from_vertices(meshes[0], meshes[1], pairs).unwrap();
    let input = MapInput::new(meshes[0], meshes[1], &landmarks);
    let mut counter = Counter::up_to(MOST_QUESTIONS);
    let outcome = run(input, &PipelineOptions::default(), &mut counter);
    match outcome {
        Ok(result) => {
            assert!(result.report.certificate.as_ref().unwrap().bijective);
            Ok(result)
        }
        Err(PipelineError::Cancelled(_)) => panic!("{} questions in {:?}", counter.asked, counter.stage),
        Err(error) => Err(error.to_string()),
    }
}

/// The same pairs with the targets in random order.
fn permuted(pairs: &[[u32; 2]], seed: u64) -> Vec<[u32; 2]> {
    let mut random = SplitMix::new(seed);
    let mut targets: Vec<u32> = pairs.iter().map(|pair| pair[1]).collect();
    for k in (1..targets.len()).rev() {
        targets.swap(k, (random.unit() * (k + 1) as f64) as usize);
    }
    pairs.iter().zip(targets).map(|(pair, target)| [pair[0], target]).collect()
}

/// Pairs of every `step`-th vertex with itself.
fn every(step: usize, count: u32) -> Vec<[u32; 2]> {
    (0..count).step_by(step).map(|v| [v, v]).collect()
}

#[test]
fn senseless_orders_end_in_a_sentence() {
    let ball = icosphere(3);
    let pairs = permuted(&every(20, 642), 2);
    let Err(sentence) = bounded([&ball, &ball], &pairs) else { panic!("a map in a senseless order") };
    assert!(sentence.contains("no map was found") && sentence.contains("landmarks"), "{sentence}");
    assert!(sentence.contains("the first is 1") && sentence.contains("exchanged"), "{sentence}");
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn senseless_orders_on_animals_end_too() {
    let demo = demo::build("horse-cat").unwrap();
    let pairs = permuted(&demo.landmarks, 3);
    if let Err(sentence) = bounded([&demo.source, &demo.target], &pairs) {
        assert!(sentence.contains("no map was found"), "{sentence}");
    }
}

#[test]
fn few_landmarks_in_any_order_end() {
    let ball = icosphere(2);
    for seed in 0..4 {
        let pairs = permuted(&[[0, 0], [1, 1], [4, 4], [7, 7], [9, 9], [60, 60]], seed);
        if let Err(sentence) = bounded([&ball, &ball], &pairs) {
            assert!(sentence.contains("no map was found"), "{sentence}");
        }
    }
}

fn cube() -> SurfaceMesh {
    let corner = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        DVec3::new(sign(0), sign(1), sign(2))
    };
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces: TiVec<_, _> =
        sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|f| f.map(VertexId)).collect();
    SurfaceMesh::from_triangles((0..8).map(corner).collect(), faces).unwrap()
}

#[test]
fn platonic_solids_map_onto_themselves_by_all_their_vertices() {
    for solid in [tetrahedron(), octahedron(), cube(), icosphere(0)] {
        let pairs = every(1, solid.vertex_count() as u32);
        let result = bounded([&solid, &solid], &pairs).unwrap();
        assert!(result.report.distortion.energy < 4.0 + 1e-3, "{}", result.report.distortion.energy);
        assert!(result.correspondence.is_some(), "it has an overlay");
    }
}

#[test]
fn landmarks_on_neighbouring_vertices_have_a_good_map() {
    let ball = icosphere(3);
    let bend = |p: &DVec3| DVec3::new(1.1 * p.x, p.y + 0.1 * p.x * p.x, p.z * (1.0 + 0.1 * p.y));
    let bent = ball.with_positions(ball.positions().iter().map(bend).collect());
    for face in [7, 300, 901] {
        // The landmarks are the corners of a triangle, the apexes of its three neighbours, and four corners of the icosahedron.
        let [a, b, c] = ball.triangles().raw[face];
        let sides = [[a, b], [b, c], [c, a]].map(|[v, w]| ball.halfedge_between(v, w).unwrap());
        let apexes = sides.map(|h| ball.tail(ball.twin(h).prev()));
        let mut vertices: Vec<u32> = [a, b, c].into_iter().chain(apexes).map(|v| v.0).collect();
        vertices.extend([0, 3, 5, 9].into_iter().filter(|v| !vertices.contains(v)).collect::<Vec<_>>());
        let pairs: Vec<[u32; 2]> = vertices.iter().map(|&v| [v, v]).collect();
        for target in [&ball, &bent] {
            let result = bounded([&ball, target], &pairs).unwrap();
            let energy = result.report.distortion.energy;
            assert!(energy < 4.2, "face {face}: {energy}");
            assert!(result.correspondence.is_some(), "it has an overlay");
        }
    }
}

#[test]
fn the_same_mesh_with_other_landmarks_has_the_inverse_map_when_exchanged() {
    let ball = icosphere(2);
    // The targets are turned by nearly a quarter turn about the x axis, so that the landmarks differ and fit.
    let turned = |v: u32| {
        let p = ball.positions()[VertexId(v)];
        let goal = DVec3::new(p.x, -p.z, p.y);
        let distance = |w: &VertexId| ball.positions()[*w].distance(goal);
        ball.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap().0
    };
    let pairs: Vec<[u32; 2]> = (0..12).map(|v| [v, turned(v)]).collect();
    let exchanged: Vec<[u32; 2]> = pairs.iter().map(|&[s, t]| [t, s]).collect();
    let there = bounded([&ball, &ball], &pairs).unwrap().report;
    let back = bounded([&ball, &ball], &exchanged).unwrap().report;
    let difference = there.distortion.energy - back.distortion.energy;
    assert!(difference.abs() < 1e-9, "{difference}");
    assert_eq!(there.layout.map(|layout| layout.judged), back.layout.map(|layout| layout.judged));
}

#[test]
fn a_run_stops_wherever_it_is_asked_to() {
    let ball = icosphere(2);
    let bent =
        ball.with_positions(ball.positions().iter().map(|p| DVec3::new(1.4 * p.x, p.y, p.z)).collect());
    // With few landmarks the program adds cones of its own.
    let landmarks = Landmarks::from_vertices(&ball, &bent, &every(27, 162)).unwrap();
    let input = MapInput::new(&ball, &bent, &landmarks);
    let mut whole = Counter::up_to(usize::MAX);
    let result = run(input, &PipelineOptions::default(), &mut whole).unwrap();
    assert!(result.report.own_landmarks > 0);
    let mut random = SplitMix::new(5);
    for _ in 0..12 {
        let mut counter = Counter::up_to((random.unit() * whole.asked as f64) as usize);
        let stopped = run(input, &PipelineOptions::default(), &mut counter);
        assert!(matches!(stopped, Err(PipelineError::Cancelled(_))), "after {} questions", counter.asked);
        assert_eq!(counter.asked, counter.most + 1, "asked again in {:?}", counter.stage);
    }
}

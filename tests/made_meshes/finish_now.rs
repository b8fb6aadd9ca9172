//! Tests that a map that is asked for before its relaxation ends is whole and certified at any time.

use conemap::demo::{self, Demo};
use conemap::landmarks::Landmarks;
use conemap::mesh::generators::icosphere;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use conemap::pipeline::{GroundTruth, MapInput, MapResult, PipelineOptions, Warning, run};
use glam::DVec3;
use typed_index_collections::TiVec;

/// A monitor that wants the result from the n-th step on.
#[derive(Default)]
struct AskAt {
    steps: usize,
    limit: usize,
    /// The number of steps up to the stage of the program's own cones.
    searched: usize,
    /// The number of steps up to the certificate; the flows for the textures come after it.
    relaxed: usize,
    /// The energies of the steps of each relaxation.
    energies: Vec<Vec<f64>>,
}

impl Monitor for AskAt {
    fn enter(&mut self, stage: Stage) {
        match stage {
            Stage::OwnCones => self.searched = self.steps,
            Stage::Certificate => self.relaxed = self.steps,
            _ => {}
        }
    }

    fn relaxation_begins(&mut self) {
        self.energies.push(Vec::new());
    }

    fn map_energy(&mut self, energy: f64) {
        self.energies.last_mut().expect("a relaxation has begun").push(energy);
    }

    fn wants_result(&self) -> bool {
        self.steps >= self.limit
    }

    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        self.steps += 1;
        Ok(())
    }
}

/// The map that is asked for at the n-th step; checks that it is certified and reported as finished early.
fn asked_at(input: MapInput<'_>, limit: usize) -> (MapResult, AskAt) {
    let mut monitor = AskAt { limit, ..AskAt::default() };
    let result = run(input, &PipelineOptions::default(), &mut monitor)
        .unwrap_or_else(|e| panic!("asked after {limit} steps: {e}"));
    let certificate = result.report.certificate.as_ref().unwrap();
    assert!(certificate.bijective && certificate.flipped_triangles == 0, "{limit}: {certificate:?}");
    assert!(result.target_from_source.iter().all(Option::is_some), "{limit}");
    let early = limit <= monitor.relaxed;
    assert_eq!(result.report.stopped_early, early, "{limit} of {}", monitor.relaxed);
    assert_eq!(result.report.warnings.iter().any(|w| matches!(w, Warning::FinishedEarly { .. })), early);
    (result, monitor)
}

/// The energies of maps that are asked for at many times. Checks that none is much lower than that of the full map, and that earlier maps
/// are not better than later ones.
fn check(input: MapInput<'_>, limits: impl Fn(usize) -> Vec<usize>) -> Vec<f64> {
    let (full, all) = asked_at(input, usize::MAX);
    let least = full.report.distortion.energy;
    // The energy falls in each relaxation, but for the share of the barrier.
    assert!(all.energies.len() > 1);
    for energies in &all.energies {
        assert!(energies.windows(2).all(|w| w[1] < w[0] * 1.001), "{energies:?}");
    }
    let energies: Vec<f64> = limits(all.relaxed)
        .into_iter()
        .map(|limit| {
            let (result, monitor) = asked_at(input, limit);
            assert!(monitor.relaxed <= all.relaxed, "{limit}");
            let energy = result.report.distortion.energy;
            assert!(energy > least * 0.995, "asked after {limit} steps: {energy} instead of {least}");
            energy
        })
        .collect();
    let third = energies.len() / 3;
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (early, late) = (mean(&energies[..third]), mean(&energies[energies.len() - third..]));
    assert!(early > late * 0.995 && late >= least * 0.995, "{energies:?}, full {least}");
    assert!(energies[0] < 2.0 * least, "{energies:?}, full {least}");
    energies
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn two_round_bodies_at_all_times() {
    let (source, ball) = (icosphere(3), icosphere(4));
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let nearest = |mesh: &SurfaceMesh, p: DVec3| {
        let distance = |v: &VertexId| mesh.positions()[*v].distance(p);
        mesh.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap().0
    };
    let pairs: Vec<_> = axes.iter().map(|&p| [nearest(&source, p), nearest(&ball, p)]).collect();
    let bend = |p: &DVec3| DVec3::new(1.6 * p.x, p.y + 0.4 * p.x * p.x, p.z * (1.0 + 0.3 * p.y));
    let target = ball.with_positions(ball.positions().iter().map(bend).collect());
    let landmarks = Landmarks::from_vertices(&source, &target, &pairs).unwrap();
    let last = |steps: usize| (steps - 7..=steps).collect::<Vec<_>>();
    check(MapInput::new(&source, &target, &landmarks), |steps| {
        let mut limits: Vec<usize> =
            [0, 1, 2].into_iter().chain((3..steps - 7).step_by(steps / 12)).collect();
        limits.extend(last(steps));
        limits
    });
}

#[test]
fn two_animals_at_a_few_times() {
    let demo = demo::build("horse-cat").unwrap();
    let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &demo.landmarks).unwrap();
    let input = MapInput::new(&demo.source, &demo.target, &landmarks);
    let energies = check(input, |steps| vec![0, steps / 2, steps - 12, steps - 3]);
    assert!(energies[0] > 1.002 * energies[3], "{energies:?}");
}

/// The number of the landmark with this label.
fn place(demo: &Demo, name: &str) -> usize {
    demo.labels.iter().position(|label| label == name).unwrap()
}

/// The landmarks are on the trunk and the head, so that the ends of legs are matched first, and become cones of the program's own.
#[test]
fn two_animals_while_ends_of_legs_are_matched() {
    let demo = demo::build("horse-cat").unwrap();
    let kept = ["nose", "withers", "croup", "chest", "belly", "left flank"];
    let pairs = kept.map(|name| demo.landmarks[place(&demo, name)]);
    let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &pairs).unwrap();
    let input = MapInput::new(&demo.source, &demo.target, &landmarks);
    let (full, all) = asked_at(input, usize::MAX);
    assert!(full.report.own_landmarks > 0);
    let foot = place(&demo, "right hind foot");
    let [from, onto] = demo.landmarks[foot].map(VertexId);
    let image = full.target_from_source[from].unwrap().position(&demo.target);
    let off = image.distance(demo.target.positions()[onto]) / demo.target.area().sqrt();
    assert!(off < 0.1, "the foot is {off} of the root of the area away");
    let least = full.report.distortion.energy;
    for share in [0.01, 0.1, 0.3] {
        let limit = all.searched + (share * (all.relaxed - all.searched) as f64) as usize;
        let (early, _) = asked_at(input, limit);
        let energy = early.report.distortion.energy;
        assert!(energy > least * 0.995, "asked after {limit} steps: {energy} instead of {least}");
    }
}

/// The landmarks leave the legs unmarked. The result is asked for at three times while own points are placed by maps of finer levels.
#[test]
fn two_poses_while_own_points_are_placed_by_finer_levels() {
    let demo = demo::build("horse-turning").unwrap();
    let pairs = ["nose", "withers", "croup", "chest", "belly"].map(|name| demo.landmarks[place(&demo, name)]);
    let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &pairs).unwrap();
    let true_map = demo::true_map("horse-turning").unwrap();
    let images: TiVec<VertexId, _> = demo.source.positions().iter().map(|&p| Some(true_map(p))).collect();
    let ground_truth = GroundTruth::Images(&images);
    let input = MapInput { ground_truth, ..MapInput::new(&demo.source, &demo.target, &landmarks) };
    let (full, all) = asked_at(input, usize::MAX);
    assert!(full.report.own_landmarks > 0);
    let mean = full.report.ground_truth.unwrap().mean;
    assert!(mean < 0.006, "the map is {mean} of the root of the area from the true one");
    for share in [0.1, 0.3, 0.5] {
        asked_at(input, all.searched + (share * (all.relaxed - all.searched) as f64) as usize);
    }
}

/// A monitor that has no time for what is made beside a map from a stage on.
struct Hurry {
    from: Stage,
    stage: Stage,
}

impl Monitor for Hurry {
    fn enter(&mut self, stage: Stage) {
        self.stage = stage;
    }

    fn has_time(&self) -> bool {
        self.stage < self.from
    }

    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        Ok(())
    }
}

#[test]
fn where_there_is_no_time_parts_beside_the_map_are_left_out() {
    let demo = demo::build("sphere-tetrahedron").unwrap();
    let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &demo.landmarks).unwrap();
    let input = MapInput::new(&demo.source, &demo.target, &landmarks);
    let kinds = |from| {
        let mut monitor = Hurry { from, stage: Stage::Landmarks };
        let result = run(input, &PipelineOptions::default(), &mut monitor).unwrap();
        assert!(result.report.certificate.as_ref().unwrap().bijective);
        assert!(result.target_from_source.iter().all(Option::is_some));
        assert_eq!(result.correspondence.is_some(), from > Stage::Transfer);
        assert_eq!(result.texture.is_some(), from > Stage::TargetConeMetric);
        result.report.warnings.iter().map(Warning::kind).collect::<Vec<_>>()
    };
    assert_eq!(kinds(Stage::Remeshing), [""; 0]);
    assert_eq!(kinds(Stage::Transfer), ["no_overlay"]);
    assert_eq!(kinds(Stage::TargetConeMetric), ["no_cone_metric", "no_overlay"]);
    for from in [Stage::SourceConeMetric, Stage::Composition] {
        assert_eq!(kinds(from), ["no_cone_metric", "no_cone_metric", "no_overlay"]);
    }
}

//! Tests of a job from files to a map: the stages that it passes, and the results that remain where something beside the map fails. They
//! run on the program's own demos, and so everywhere.

use conemap::cone_metric::FlowOptions;
use conemap::demo;
use conemap::export;
use conemap::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use conemap::job::{
    FewLandmarks, Job, JobError, JobFile, JobFiles, MapLook, ReadOptions, TargetImage, TruthError,
    planned_stages,
};
use conemap::landmark_exchange::GivenFile;
use conemap::landmarks::MeshSide;
use conemap::mesh::mirror::mirrored;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::{Cancelled, Monitor, PlannedStage, Progress, Silent, Stage, Step};
use conemap::pipeline::{
    Base, Borders, Choices, MapResult, Method, OwnConeOptions, PipelineOptions, Warning,
};

/// The files of a job.
pub struct Files {
    pub source: Vec<u8>,
    pub target: Vec<u8>,
    pub landmarks: Vec<u8>,
}

impl Files {
    /// The files of a demo, with its first landmarks.
    pub fn of_demo(id: &str, landmarks: usize) -> Self {
        let demo = demo::build(id).unwrap();
        let pairs = demo.landmarks.iter().take(landmarks);
        let file = LandmarkFile {
            pairs: pairs.map(|pair| pair.map(LandmarkPoint::Vertex)).collect(),
            ..LandmarkFile::default()
        };
        let obj = |mesh: &SurfaceMesh| export::obj::mesh(mesh);
        let (source, target) = (obj(&demo.source), obj(&demo.target));
        Self { source, target, landmarks: landmark_file::write(&file) }
    }

    /// Replaces the landmarks by other pairs of vertices.
    pub fn set_landmarks(&mut self, pairs: &[[u32; 2]]) {
        let pairs = pairs.iter().map(|pair| pair.map(LandmarkPoint::Vertex)).collect();
        self.landmarks = landmark_file::write(&LandmarkFile { pairs, ..LandmarkFile::default() });
    }

    fn read(&self, monitor: &mut dyn Monitor) -> Result<Job, JobError> {
        let Self { source, target, landmarks } = self;
        let landmarks = [GivenFile { name: "landmarks.json", bytes: landmarks }];
        Job::read(JobFiles { source, target, landmarks: &landmarks }, TargetImage::AsGiven, monitor)
    }
}

/// A monitor that lists the stages in their order, each with the fractions reported in it; a stage that is begun several times in a row is
/// listed once.
#[derive(Default)]
struct Recorder {
    stages: Vec<(Stage, Vec<f64>)>,
}

impl Monitor for Recorder {
    fn enter(&mut self, stage: Stage) {
        if self.stages.last().is_none_or(|last| last.0 != stage) {
            self.stages.push((stage, vec![0.0]));
        }
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        let (_, fractions) = self.stages.last_mut().expect("a step belongs to a stage");
        fractions.push(step.fraction);
        Ok(())
    }
}

/// Runs a job as the command line and the page do.
pub fn run(files: &Files, options: &PipelineOptions, monitor: &mut dyn Monitor) -> (Job, MapResult) {
    let job = files.read(monitor).unwrap();
    job.findings(monitor).unwrap();
    let result = job.run(options, monitor).unwrap();
    (job, result)
}

#[test]
fn a_map_that_is_given_as_the_truth_is_met() {
    let options = PipelineOptions::default();
    let (mut job, result) = run(&Files::of_demo("sphere-tetrahedron", 14), &options, &mut Silent);
    assert!(result.report.ground_truth.is_none());
    job.know_truth(&job.vertex_images(&result)).unwrap();
    let truth = job.run(&options, &mut Silent).unwrap().report.ground_truth.unwrap();
    assert!(truth.max < 1e-9, "{truth:?}");
    assert_eq!(job.know_truth(b"vertex,x,z\n0,1,2\n"), Err(TruthError::Column("y")));
    assert_eq!(job.know_truth(b"vertex,x,y,z\n0,,,\n"), Err(TruthError::Empty));
    assert!(matches!(job.know_truth(b"vertex,x,y,z\n0,1\n"), Err(TruthError::Table(_))));
}

#[test]
fn a_run_passes_the_stages_that_are_told_in_their_order() {
    let thesis = Choices { method: Method::Thesis, ..Choices::default() };
    // With so few landmarks the program adds cones of its own.
    check_stages(
        "sphere-tetrahedron",
        [("relaxed", 4, PipelineOptions::default()), ("thesis", 6, thesis.into())],
    );
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn a_run_of_any_kind_passes_the_stages_that_are_told_in_their_order() {
    let runs = [
        ("relaxed", 8, PipelineOptions::default()),
        ("relaxed, no own cones", 8, Choices { own_cones: Some(0), ..Choices::default() }.into()),
        ("relaxed, many landmarks", usize::MAX, PipelineOptions::default()),
        ("on a simplified base", usize::MAX, Choices { base: Base::Qem, ..Choices::default() }.into()),
        ("tutte", usize::MAX, Choices { method: Method::Tutte, ..Choices::default() }.into()),
    ];
    check_stages("horse-cat", runs);
}

/// Each of `runs` has a name, the number of the demo's landmarks that are taken, and the options.
fn check_stages<const N: usize>(demo: &str, runs: [(&str, usize, PipelineOptions); N]) {
    for (name, landmarks, options) in runs {
        let files = Files::of_demo(demo, landmarks);
        let mut recorder = Recorder::default();
        let (job, _) = run(&files, &options, &mut recorder);
        let plan = options.stages(job.landmark_count());
        check_passed(&recorder, &plan, job.landmark_count(), name);
        assert!(plan.is_sorted_by_key(|planned| planned.stage), "{name}: {plan:?}");
        assert!(plan.iter().all(|planned| planned.time > 0.0), "{name}: {plan:?}");

        // No step of any stage moves the bar back, or far ahead, so that it never rests for long.
        let mut progress = Progress::new(plan);
        let mut before = 0.0;
        for (stage, fractions) in &recorder.stages {
            assert!(fractions.is_sorted(), "{name}: {stage} goes back: {fractions:?}");
            for &fraction in fractions {
                let share = progress.at(*stage, fraction);
                assert!((before..=1.0).contains(&share), "{name}: {stage} at {fraction}");
                before = share;
            }
        }
    }
}

/// All stages of a plan are passed, in their order, but for cones of the program's own with many landmarks: only poses of one body get them.
fn check_passed(recorder: &Recorder, plan: &[PlannedStage], landmarks: usize, name: &str) {
    let passed: Vec<Stage> = recorder.stages.iter().map(|stage| stage.0).collect();
    let may_be_left_out =
        |stage: Stage| stage == Stage::OwnCones && landmarks > OwnConeOptions::default().most_landmarks;
    let mut planned: Vec<Stage> = plan.iter().map(|planned| planned.stage).collect();
    planned.retain(|stage| passed.contains(stage) || !may_be_left_out(*stage));
    assert_eq!(passed, planned, "{name}");
}

#[test]
fn a_soft_landmark_settles_within_its_radius_and_the_map_takes_it_there() {
    const SOFT: usize = 2;
    const RADIUS: f64 = 0.03;
    let mut files = Files::of_demo("horse-cat", usize::MAX);
    let held = landmark_file::read(&files.landmarks).unwrap();
    let radii: Vec<f64> = (0..held.pairs.len()).map(|k| if k == SOFT { RADIUS } else { 0.0 }).collect();
    files.landmarks = landmark_file::write(&LandmarkFile { radii: Some(radii), ..held.clone() });

    let options = PipelineOptions::default();
    let mut recorder = Recorder::default();
    let (job, result) = run(&files, &options, &mut recorder);
    let plan = planned_stages(&landmark_file::read(&files.landmarks).unwrap(), &options);
    check_passed(&recorder, &plan, job.landmark_count(), "soft");
    let first = recorder.stages[..3].iter().map(|stage| stage.0);
    assert!(first.eq([Stage::Landmarks, Stage::Settling, Stage::Findings]));
    assert!(recorder.stages.iter().all(|(_, fractions)| fractions.is_sorted()));
    assert!(result.report.certificate.as_ref().unwrap().bijective);

    let [settled] = job.settled() else { panic!("{:?}", job.settled()) };
    assert_eq!(settled.pair, SOFT);
    assert!(settled.moved > 0.0 && settled.moved <= RADIUS, "{settled:?}");
    let LandmarkPoint::OnFace { face, barycentric } = settled.point else { panic!("{settled:?}") };
    let (target, vertex) = (&job.mapped_meshes()[1], job.landmark_vertices()[1][SOFT]);
    let demo = demo::build("horse-cat").unwrap();
    let at = SurfacePoint::clamped(FaceId(face), barycentric).position(&demo.target);
    assert!(at.distance(target.positions()[vertex]) < 1e-9, "{at} {}", target.positions()[vertex]);
    let image = result.target_from_source[job.landmark_vertices()[0][SOFT]].unwrap().position(target);
    assert!(image.distance(target.positions()[vertex]) < 1e-9);
    let report = serde_json::to_value(job.report(&result)).unwrap();
    assert_eq!(report["settled"].as_array().map(Vec::len), Some(1));

    // The point where it settled can be given as an ordinary landmark.
    let mut pairs = held.pairs.clone();
    pairs[SOFT][1] = settled.point;
    files.landmarks = landmark_file::write(&LandmarkFile { pairs, ..held });
    let (again, same) = run(&files, &options, &mut Silent);
    assert!(again.settled().is_empty());
    let [first, second] = [&result, &same].map(|result| result.report.distortion.energy);
    assert!((first / second - 1.0).abs() < 1e-6, "{first} {second}");
}

/// The search works on the mirror image of the target; the given points are reported in the numbers of the target's file all the same.
#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn given_points_are_told_of_the_file_where_the_target_is_mirrored() {
    let demo = demo::build("horse-cat").unwrap();
    let target = mirrored(&demo.target).unwrap();
    let [on_source, vertex] = demo.landmarks[0];
    let vertex = VertexId(vertex);
    let face = target.faces().find(|&f| target.triangles()[f].contains(&vertex)).unwrap();
    let weights = target.triangles()[face].map(|v| if v == vertex { 0.7 } else { 0.15 });
    let given =
        [LandmarkPoint::Vertex(on_source), LandmarkPoint::OnFace { face: face.0, barycentric: weights }];
    let landmarks = landmark_file::write(&LandmarkFile { pairs: vec![given], ..LandmarkFile::default() });
    let [source, target] = [&demo.source, &target].map(export::obj::mesh);
    let files = [GivenFile { name: "landmarks.json", bytes: &landmarks }];
    let options = ReadOptions { few_landmarks: FewLandmarks::Matched, ..TargetImage::Mirrored.into() };
    let files = JobFiles { source: &source, target: &target, landmarks: &files };
    let job = Job::read(files, options, &mut Silent).unwrap();

    for candidate in &job.matching().unwrap().candidates {
        let LandmarkPoint::OnFace { face: told, barycentric } = candidate.pairs[0][1] else {
            panic!("{:?}", candidate.pairs[0])
        };
        assert_eq!(told, face.0);
        assert!(barycentric.iter().zip(weights).all(|(a, b)| (a - b).abs() < 1e-12), "{barycentric:?}");
    }
}

/// Options with a flow that may take no step, and so does not converge.
fn without_flow() -> PipelineOptions {
    let options = PipelineOptions::default();
    PipelineOptions { flow: FlowOptions { max_steps: 0, ..options.flow }, ..options }
}

#[test]
fn a_map_stands_where_no_texture_can_be_made() {
    let files = Files::of_demo("sphere-tetrahedron", usize::MAX);
    let (_, whole) = run(&files, &PipelineOptions::default(), &mut Silent);
    let (job, bare) = run(&files, &without_flow(), &mut Silent);

    let missing = |side: MeshSide| {
        bare.report
            .warnings
            .iter()
            .any(|w| matches!(w, Warning::NoConeMetric { side: of, .. } if *of == side))
    };
    assert!(missing(MeshSide::Source) && missing(MeshSide::Target), "{:?}", bare.report.warnings);
    assert!(whole.report.warnings.iter().all(|w| !matches!(w, Warning::NoConeMetric { .. })));
    // Everything but the numbers of the flows and the texture is the same.
    assert!(bare.report.certificate.as_ref().unwrap().bijective);
    assert_eq!(bare.target_from_source, whole.target_from_source);
    assert_eq!(bare.report.distortion.energy, whole.report.distortion.energy);
    assert_eq!(bare.report.distortion.l2_stretch, None);
    let flow = bare.report.cone_metric.target.as_ref().unwrap();
    assert!(
        flow.max_curvature_error > FlowOptions::default().tolerance && flow.newton_steps == 0,
        "{flow:?}"
    );
    let json = serde_json::to_value(&bare.report).unwrap();
    let warning = json["warnings"].as_array().unwrap().iter().find(|w| w["side"] == "target").unwrap();
    assert!(warning["sentence"].as_str().unwrap().contains("did not converge"), "{warning}");

    let names: Vec<_> =
        job.outputs(&bare, &Choices::default(), &MapLook::default()).map(|file| file.unwrap().name).collect();
    assert!(
        names.contains(&"source-with-target-texture.glb") && names.contains(&"vertex-images.csv"),
        "{names:?}"
    );
}

/// The thesis' method has no result without its flows.
#[test]
fn the_patchwise_map_needs_its_flows() {
    let files = Files::of_demo("sphere-tetrahedron", usize::MAX);
    let options = PipelineOptions { method: Method::Thesis, ..without_flow() };
    let job = files.read(&mut Silent).unwrap();
    let error = job.run(&options, &mut Silent).unwrap_err();
    assert_eq!(error.code(), "cone-metric", "{error}");
}

#[test]
fn faults_name_their_file() {
    let good = Files::of_demo("sphere-tetrahedron", usize::MAX);
    let fault = |files: Files| files.read(&mut Silent).unwrap_err();
    let of = |source: &[u8], target: &[u8], landmarks: &[u8]| Files {
        source: source.to_vec(),
        target: target.to_vec(),
        landmarks: landmarks.to_vec(),
    };
    // This mesh is an open sheet.
    let open = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (files, file, code) in [
        (of(b"nothing", &good.target, &good.landmarks), JobFile::Source, "file"),
        (of(&good.source, b"", &good.landmarks), JobFile::Target, "file"),
        (of(open, &good.target, &good.landmarks), JobFile::Source, "mesh"),
        (of(&good.source, open, &good.landmarks), JobFile::Target, "mesh"),
        (of(&good.source, &good.target, b"{"), JobFile::Landmarks(0), "landmarks"),
        (of(&good.source, &good.target, br#"{"pairs": [[0, 0]]}"#), JobFile::Landmarks(0), "landmarks"),
    ] {
        let error = fault(files);
        assert_eq!((error.file(), error.code()), (Some(file), code), "{error}");
    }
}

/// A name that is not known in the choices of the page is an error, and does not become the default.
#[test]
fn unknown_choices_are_errors() {
    let read = |json: &str| serde_json::from_str::<Choices>(json);
    assert_eq!(read("{}").unwrap(), Choices::default());
    let chosen = read(r#"{"method": "thesis", "ownCones": 7, "borders": "missing"}"#).unwrap();
    assert_eq!(
        (chosen.method, chosen.own_cones, chosen.borders),
        (Method::Thesis, Some(7), Borders::Missing)
    );
    for json in
        [r#"{"method": "best"}"#, r#"{"metod": "thesis"}"#, r#"{"ownCones": -1}"#, r#"{"base": 1}"#, "[]x"]
    {
        assert!(read(json).is_err(), "{json}");
    }
}

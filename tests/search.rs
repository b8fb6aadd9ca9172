//! The search for the isotopy class, judged by real maps of coarse meshes.

mod common;

use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::layout::{self, BaseLayout, Candidate, Candidates, PatchedMesh, SearchOptions, same_class};
use conemap::mesh::coarsening::Level;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::{Cancelled, Monitor, Silent, Step};
use conemap::surface_map::energy::map_energy::MapEnergy;
use conemap::surface_map::parametrisation::initial::{InitialOptions, embed, relax};
use conemap::surface_map::parametrisation::problem::FlatRelaxOptions;
use conemap::surface_map::relaxation::map_relaxation::{self, MapRelaxationOptions};
use conemap::surface_map::{ConeSurface, MapError};
use std::sync::Arc;

/// The mean log density of a layout's map after a few rounds of relaxation.
fn mean_log(layout: &BaseLayout, monitor: &mut dyn Monitor) -> Result<Option<f64>, Cancelled> {
    let map = |monitor: &mut dyn Monitor| -> Result<f64, MapError> {
        let surface = Arc::new(ConeSurface::of_layout(layout)?);
        let mut side = |patched: &PatchedMesh| -> Result<_, MapError> {
            let (start, _) = embed(patched, &surface, &InitialOptions::default(), monitor)?;
            Ok(relax(patched.parametrised(&start), &surface, &FlatRelaxOptions::default(), monitor)?.0)
        };
        let embeddings = [side(&layout.source)?, side(&layout.target)?];
        let sides = [layout.source.parametrised(&embeddings[0]), layout.target.parametrised(&embeddings[1])];
        let options = MapRelaxationOptions {
            max_rounds: 3,
            energy: MapEnergy::JUDGE,
            ..MapRelaxationOptions::default()
        };
        let relaxed = map_relaxation::relax(sides, &surface, &options, monitor)?;
        Ok(relaxed.mean_log())
    };
    match map(monitor) {
        Ok(mean_log) => Ok(Some(mean_log)),
        Err(MapError::Cancelled(stop)) => Err(stop),
        Err(_) => Ok(None),
    }
}

/// The mean log density of a candidate's map.
fn judge(candidate: &Candidate, monitor: &mut dyn Monitor) -> Result<Option<f64>, Cancelled> {
    mean_log(&candidate.layout, monitor)
}

/// A mesh coarsened with its landmarks, and their numbers there.
fn coarse(mesh: &SurfaceMesh, landmarks: &[VertexId], goal: usize) -> (Level, Vec<VertexId>) {
    let level = Level::coarse(mesh, landmarks, goal);
    let number =
        |v: &VertexId| level.vertices.iter().position(|w| w == v).expect("landmarks are kept").into();
    let numbers = landmarks.iter().map(number).collect();
    (level, numbers)
}

fn demo_pair(id: &str, goal: usize) -> ([SurfaceMesh; 2], Landmarks) {
    let demo = demo::build(id).expect("a demo");
    let side = |s: usize, mesh: &SurfaceMesh| {
        let held: Vec<VertexId> = demo.landmarks.iter().map(|pair| VertexId(pair[s])).collect();
        let (level, numbers) = coarse(mesh, &held, goal);
        (level.mesh, numbers)
    };
    let ((s, source), (t, target)) = (side(0, &demo.source), side(1, &demo.target));
    ([s, t], Landmarks { source, target })
}

#[test]
fn limbs_turned_by_a_whole_turn_are_turned_back() {
    let ([source, target], landmarks) = demo_pair("poses", 300);
    let meshes = [&source, &target];
    let mut candidates = Candidates::new(meshes, &landmarks);
    let straight = candidates.next(&mut Silent).expect("not stopped").expect("a layout");
    let least = mean_log(&straight.layout, &mut Silent).expect("not stopped").expect("a map");
    for twisted in candidates.twists(&straight, (2, 3.0), &mut Silent).expect("not stopped") {
        assert!(!same_class(&straight.layout, &twisted.layout));
        let mut fresh = Candidates::new(meshes, &landmarks);
        let options = SearchOptions::default();
        let (found, report) =
            layout::untwist((&mut fresh, twisted), &mut judge, &options, &mut Silent).expect("a layout");
        let before = report.judged[0].mean_log.unwrap_or(f64::INFINITY);
        let after = report.mean_log().expect("a map");
        assert!(before > 1.2 * least, "a whole turn distorts: {before} against {least}");
        assert!(
            same_class(&straight.layout, &found.layout) || after <= least,
            "{before} -> {after}, untwisted {least}"
        );
    }
}

/// A pose pair of the data on one coarse connectivity: vertex i corresponds to vertex i.
fn poses_of_one_mesh(pair: &common::Pair, goal: usize) -> ([SurfaceMesh; 2], Landmarks) {
    let landmarks = common::landmarks(pair);
    assert_eq!(landmarks.source, landmarks.target, "{} has a known map", pair.name);
    let (level, numbers) = coarse(&pair.source, &landmarks.source, goal);
    let positions = level.vertices.iter().map(|&v| pair.target.positions()[v]).collect();
    let target = level.mesh.with_positions(positions);
    ([level.mesh, target], Landmarks { source: numbers.clone(), target: numbers })
}

/// The layout of the identity: the source's own drawing on both sides.
fn identity(layout: &BaseLayout) -> BaseLayout {
    BaseLayout { target: layout.source.clone(), ..layout.clone() }
}

#[test]
fn poses_find_the_class_of_the_known_map() {
    let Some(data) = common::data_folder("poses_find_the_class_of_the_known_map") else { return };
    for name in ["horse-horse05", "cat-cat1"] {
        let ([source, target], landmarks) = poses_of_one_mesh(&common::read_pair(&data, name), 400);
        let mut candidates = Candidates::new([&source, &target], &landmarks);
        let options = SearchOptions::default();
        let (found, report) =
            layout::search(&mut candidates, &mut judge, &options, &mut Silent).expect("a layout");
        assert!(same_class(&found.layout, &identity(&found.layout)), "{name}: {report:?}");
    }
}

#[test]
fn the_search_is_deterministic_and_stops_on_request() {
    let ([source, target], landmarks) = demo_pair("horse-cat", 300);
    let options = SearchOptions { candidates: 3, twists: 2, ..SearchOptions::default() };
    let run = |monitor: &mut dyn Monitor| {
        let mut candidates = Candidates::new([&source, &target], &landmarks);
        layout::search(&mut candidates, &mut judge, &options, monitor)
    };
    let (first, second) = (run(&mut Silent).expect("a layout"), run(&mut Silent).expect("a layout"));
    assert_eq!(first.1, second.1);
    assert!(same_class(&first.0.layout, &second.0.layout));
    assert!(first.1.runner_up().is_none_or(|next| Some(next) >= first.1.mean_log()));

    struct StopAfter(usize);
    impl Monitor for StopAfter {
        fn step(&mut self, _: Step) -> Result<(), Cancelled> {
            self.0 = self.0.checked_sub(1).ok_or(Cancelled)?;
            Ok(())
        }
    }
    for steps in [0, 5, 60] {
        let stopped = run(&mut StopAfter(steps));
        assert!(matches!(stopped, Err(layout::LayoutError::Cancelled(_))), "after {steps} steps");
    }
}

#[test]
fn a_judge_without_maps_is_an_error() {
    let ([source, target], landmarks) = demo_pair("horse-cat", 200);
    let mut candidates = Candidates::new([&source, &target], &landmarks);
    let options = SearchOptions { candidates: 2, ..SearchOptions::default() };
    let result = layout::search(&mut candidates, &mut |_, _| Ok(None), &options, &mut Silent);
    assert!(matches!(result, Err(layout::LayoutError::NoMap { layouts: 1..=2, .. })), "{:?}", result.err());
}

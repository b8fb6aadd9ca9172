//! The search for the isotopy class, judged by real maps of coarse meshes.

use crate::classes::{coarse, judge, known_class_is_found, mean_log};
use crate::fixtures;
use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::layout::{self, Candidates, SearchOptions, same_class};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::{Cancelled, Monitor, Silent, Step};

fn demo_pair(id: &str, goal: usize) -> ([SurfaceMesh; 2], Landmarks) {
    let demo = demo::build(id).expect("a demo");
    let side = |s: usize, mesh: &SurfaceMesh| {
        let held: Vec<VertexId> = demo.landmarks.iter().map(|pair| VertexId(pair[s])).collect();
        let (level, numbers) = coarse(mesh, &held, goal);
        (level.mesh, numbers)
    };
    let ((s, source), (t, target)) = (side(0, &demo.source), side(1, &demo.target));
    ([s, t], Landmarks { source: source.into(), target: target.into() })
}

#[test]
fn limbs_turned_by_a_whole_turn_are_turned_back() {
    let ([source, target], landmarks) = demo_pair("poses", 300);
    let meshes = [&source, &target];
    let mut candidates = Candidates::new(meshes, &landmarks, &mut Silent).unwrap();
    let straight = candidates.next(&mut Silent).expect("not stopped").expect("a layout");
    let least = mean_log(&straight.layout, &mut Silent).expect("not stopped").expect("a map");
    let twists = candidates.twists(&straight, 2, 3.0, &mut Silent).expect("not stopped");
    assert!(!twists.is_empty(), "no limb can be turned");
    for twisted in twists {
        assert!(!same_class(&straight.layout, &twisted.layout));
        let mut fresh = Candidates::new(meshes, &landmarks, &mut Silent).unwrap();
        let options = SearchOptions::default();
        let (found, report) =
            layout::untwist(&mut fresh, twisted, &mut judge, &options, &mut Silent).expect("a layout");
        let before = report.judged[0].mean_log.unwrap_or(f64::INFINITY);
        let after = report.mean_log().expect("a map");
        assert!(before > 1.2 * least, "a whole turn distorts: {before} against {least}");
        assert!(
            same_class(&straight.layout, &found.layout) || after <= least,
            "{before} -> {after}, untwisted {least}"
        );
    }
}

#[test]
fn the_class_of_a_known_map_is_found() {
    known_class_is_found(&fixtures::bent_horse());
}

#[test]
fn the_search_is_deterministic_and_stops_on_request() {
    let ([source, target], landmarks) = demo_pair("horse-cat", 300);
    let options = SearchOptions { candidates: 3, twists: 2, ..SearchOptions::default() };
    let run = |monitor: &mut dyn Monitor| {
        let mut candidates = Candidates::new([&source, &target], &landmarks, &mut Silent).unwrap();
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
    let mut candidates = Candidates::new([&source, &target], &landmarks, &mut Silent).unwrap();
    let options = SearchOptions { candidates: 2, ..SearchOptions::default() };
    let result = layout::search(&mut candidates, &mut |_, _| Ok(None), &options, &mut Silent);
    assert!(matches!(result, Err(layout::LayoutError::NoMap { layouts: 1..=2, .. })), "{:?}", result.err());
}

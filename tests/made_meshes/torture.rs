//! Tests of a fixed sample of the hostile geometry that `cargo xtask torture` makes by the thousand: each case ends in a certified map that
//! the second certificate proves, or in a typed error with a sentence, after bounded work.

use crate::bounds::{Counter, MOST_QUESTIONS};
use crate::hostile_geometry::{HostileCase, Kind, Size, case};
use crate::judged_job::{Files, Outcome, mapped};
use crate::rough_meshes::Random;
use conemap::io::landmark_file::LandmarkPoint;
use conemap::math::scalar::{cos, sin};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use glam::DVec3;

/// The outcome of a small case; fails where it is one that must never happen.
fn outcome(kind: Kind, seed: u64) -> Outcome {
    let files = Files::from(case(kind, seed, Size::Small));
    let outcome = match mapped(&files, &mut Counter::up_to(MOST_QUESTIONS)) {
        Ok(mapped) => mapped.judged(&files),
        Err(outcome) => outcome,
    };
    let name = kind.name();
    match &outcome {
        Outcome::Stopped => panic!("{name}-{seed}: more than {MOST_QUESTIONS} questions"),
        Outcome::Wrong(why) => panic!("{name}-{seed}: {why}"),
        Outcome::Refused { sentence, .. } => assert!(sentence.len() > 20, "{name}-{seed}: {sentence}"),
        _ => {}
    }
    outcome
}

fn is_map(outcome: &Outcome) -> bool {
    !matches!(outcome, Outcome::Refused { .. })
}

#[test]
fn hostile_shapes_end_in_a_proved_map_or_a_sentence() {
    let kinds = [Kind::Slivers, Kind::Pancakes, Kind::Noise, Kind::Rough];
    let outcomes: Vec<Outcome> = kinds.into_iter().map(|kind| outcome(kind, 1)).collect();
    // At least one case of the kind must have a map.
    assert!(outcomes.iter().any(is_map), "{outcomes:?}");
}

#[test]
fn meshes_of_very_different_sizes_have_a_map() {
    for kind in [Kind::Hubs, Kind::Unequal] {
        assert!(is_map(&outcome(kind, 1)));
    }
}

#[test]
fn hostile_landmarks_end_in_a_proved_map_or_a_sentence() {
    for kind in [Kind::Adjacent, Kind::Dense, Kind::OneLimb, Kind::BesideEdges] {
        let outcome = outcome(kind, 1);
        assert!(is_map(&outcome), "{}: {outcome:?}", kind.name());
    }
}

/// Two fans of triangles on a common wavy rim of `rim` vertices; the first two vertices are their apexes.
fn hats(rim: usize, height: f64) -> SurfaceMesh {
    let turn = |k: usize| std::f64::consts::TAU * k as f64 / rim as f64;
    let around = (0..rim).map(|k| DVec3::new(cos(turn(k)), sin(turn(k)), 0.1 * sin(3.0 * turn(k))));
    let positions = [DVec3::Z * height, DVec3::NEG_Z].into_iter().chain(around).collect();
    let at = |k: usize| VertexId::from(2 + k % rim);
    let faces = (0..rim).flat_map(|k| [[VertexId(0), at(k), at(k + 1)], [VertexId(1), at(k + 1), at(k)]]);
    SurfaceMesh::from_triangles(positions, faces.collect()).unwrap()
}

#[test]
fn landmarks_may_have_more_than_a_thousand_neighbours() {
    let meshes = [hats(1400, 1.0), hats(1200, 1.5)];
    let at = LandmarkPoint::Vertex;
    let rim = (0..4).map(|k| [at(2 + 350 * k), at(2 + 300 * k)]);
    let pairs = [[at(0); 2], [at(1); 2]].into_iter().chain(rim).collect();
    let files = Files::from(HostileCase { meshes, pairs });
    let mapped = mapped(&files, &mut Silent).unwrap_or_else(|outcome| panic!("{outcome:?}"));
    assert_eq!(mapped.judged(&files), Outcome::Proved);
}

#[test]
fn generators_make_the_same_files_again() {
    for kind in Kind::ALL {
        let [first, again] = [0; 2].map(|_| Files::from(case(kind, 3, Size::Small)));
        assert!(first.source == again.source && first.target == again.target, "{}", kind.name());
        assert!(first.landmarks == again.landmarks, "{}", kind.name());
    }
    assert!((0..100).all(|_| (0.0..0.5).contains(&Random::new(1).small())));
}

#[test]
fn landmarks_beside_edges_are_told_where_they_are_held() {
    // The points lie 1e-7 from a corner, 1e-9 from an edge, inside faces, and at a vertex; only the first two are moved where they are
    // held.
    let mut files = Files::from(case(Kind::Dense, 1, Size::Small));
    let on_face =
        |face: u32, [a, b, c]: [f64; 3]| format!("{{\"face\":{face},\"barycentric\":[{a},{b},{c}]}}");
    let points = [
        on_face(3, [1.0 - 2e-7, 1e-7, 1e-7]),
        on_face(20, [0.5, 0.5 - 1e-9, 1e-9]),
        on_face(40, [0.25, 0.25, 0.5]),
        on_face(60, [0.5, 0.25, 0.25]),
        "5".to_owned(),
    ];
    let pairs: Vec<String> = points.iter().map(|point| format!("[{point},{point}]")).collect();
    files.landmarks = format!("{{\"pairs\":[{}]}}", pairs.join(",")).into_bytes();
    let outcome = mapped(&files, &mut Silent).map(|mapped| mapped.judged(&files));
    assert_eq!(outcome.map_err(|error| format!("{error:?}")), Ok(Outcome::Proved));
}

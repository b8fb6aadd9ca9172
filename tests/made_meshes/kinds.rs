//! Tests on bodies of many kinds: their skins, and the partners that their limbs find without a landmark.

use crate::bodies::{MadeBody, body, names};
use conemap::geodesic::distances;
use conemap::landmark_matching::{LandmarkMatch, MatchInput, MatchOptions, Verdict, match_landmarks};
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use glam::DVec3;
use std::collections::BTreeSet;

/// The length of edges, as in a table.
const EDGE: f64 = 0.026;

#[test]
fn patterns_of_all_kinds_are_symmetric_and_each_end_has_its_place() {
    let kinds = names();
    assert_eq!(kinds.len(), 30);
    for kind in kinds {
        let MadeBody { mesh, ends } = body(&kind, 0, EDGE);
        assert_eq!(mesh.euler_characteristic(), 2, "{kind}");
        let places: BTreeSet<VertexId> = ends.iter().map(|(_, v)| *v).collect();
        assert_eq!(places.len(), ends.len(), "{kind}: {ends:?}");
        for (name, v) in ends.iter().filter(|(name, _)| name.starts_with("left ")) {
            let partner = name.replace("left ", "right ");
            let (_, w) = ends.iter().find(|(name, _)| *name == partner).unwrap();
            let [left, right] = [*v, *w].map(|v| mesh.positions()[v]);
            assert!(
                left.x > 0.0 && left.distance(right * DVec3::new(-1.0, 1.0, 1.0)) < 2.0 * EDGE,
                "{kind} {name}"
            );
        }
    }
}

/// The distance along the surface between the ends of these names.
fn between(MadeBody { mesh, ends }: &MadeBody, names: [&str; 2]) -> f64 {
    let [a, b] = names.map(|name| ends.iter().find(|end| end.0 == name).unwrap().1);
    distances(mesh, &[a])[b]
}

#[test]
fn ears_and_horns_of_a_giraffe_are_never_one_limb() {
    let pattern = body("giraffe", 0, EDGE);
    for build in 1..=8 {
        let body = body("giraffe", build, EDGE);
        for side in ["left", "right"] {
            let names = [format!("{side} ear"), format!("{side} horn")];
            let names = names.each_ref().map(String::as_str);
            assert!(between(&body, names) > 0.4 * between(&pattern, names), "{build} {side}");
        }
    }
}

/// Two other bodies of a kind, matched, and the names of the ends that the best candidate pairs.
fn matched(kind: &str, builds: [u64; 2]) -> (LandmarkMatch, Vec<[String; 2]>) {
    matched_bodies(builds.map(|build| body(kind, build, EDGE)))
}

fn matched_bodies(bodies: [MadeBody; 2]) -> (LandmarkMatch, Vec<[String; 2]>) {
    let [source, target] = [&bodies[0].mesh, &bodies[1].mesh];
    let found =
        match_landmarks(MatchInput::new(source, target), &MatchOptions::default(), &mut Silent).unwrap();
    let name = |side: usize, v: VertexId| {
        let MadeBody { mesh, ends } = &bodies[side];
        let off = |end: &(String, VertexId)| mesh.positions()[end.1].distance(mesh.positions()[v]);
        let nearest = ends.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
        (off(nearest) < 0.1 * mesh.area().sqrt()).then(|| nearest.0.clone())
    };
    let pairs = found.candidates[0].pairs.iter();
    let ends = pairs.filter_map(|pair| Some([name(0, pair.source)?, name(1, pair.target)?])).collect();
    (found, ends)
}

fn all_go_to_their_own(ends: &[[String; 2]], least: usize) {
    assert!(ends.len() >= least && ends.iter().all(|[a, b]| a == b), "{ends:?}");
}

#[test]
fn limbs_of_a_bird_find_those_of_another_one() {
    let (found, ends) = matched("bird", [3, 4]);
    assert_eq!(found.verdict, Verdict::Sure);
    all_go_to_their_own(&ends, 6);
}

/// With the arms' distances alone all arms go to the next one's partner.
#[test]
fn arms_of_an_octopus_find_their_own_among_eight_that_are_alike() {
    let (_, ends) = matched("octopus", [3, 4]);
    all_go_to_their_own(&ends, 9);
}

fn are_paired(ends: &[[String; 2]], names: [&str; 2]) {
    assert!(names.iter().all(|name| ends.contains(&[(*name).to_owned(), (*name).to_owned()])), "{ends:?}");
}

/// On coarse maps each ear goes to the other one.
#[test]
fn ears_of_a_kangaroo_find_their_own() {
    let (_, ends) = matched_bodies([body("kangaroo", 7, 0.023), body("kangaroo", 8, 0.02)]);
    all_go_to_their_own(&ends, 7);
    are_paired(&ends, ["left ear", "right ear"]);
}

/// On coarse maps horns without a partner score better.
#[test]
fn horns_of_a_dragon_find_their_own() {
    let (_, ends) = matched("dragon", [0, 8]);
    all_go_to_their_own(&ends, 10);
    are_paired(&ends, ["left horn", "right horn"]);
}

#[test]
fn which_ray_of_a_starfish_goes_to_which_is_asked() {
    let (found, _) = matched("starfish", [3, 4]);
    assert!(matches!(found.verdict, Verdict::Doubtful(_)), "{:?}", found.verdict);
}

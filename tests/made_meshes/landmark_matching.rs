//! Tests of matching without landmarks, or with few: on the program's own animals limbs find the same partners however the meshes are
//! turned, scaled or numbered.

use conemap::demo::{self, Demo};
use conemap::landmark_matching::{
    LandmarkMatch, MatchError, MatchInput, MatchOptions, PairOrigin, Verdict, match_landmarks,
};
use conemap::landmarks::MeshSide;
use conemap::math::scalar::exp;
use conemap::mesh::generators::icosphere;
use conemap::mesh::mirror::mirrored;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use conemap::monitor::{Cancelled, MapPreview, Monitor, Silent, Step};
use glam::{DQuat, DVec3};
use typed_index_collections::TiVec;

/// Options with fewer candidates than usual, to be quick.
fn few() -> MatchOptions {
    MatchOptions { candidates: 3, symmetric: 1, changes: 2, ..MatchOptions::default() }
}

fn matched(source: &SurfaceMesh, target: &SurfaceMesh) -> LandmarkMatch {
    match_landmarks(MatchInput::new(source, target), &few(), &mut Silent).unwrap()
}

/// The name of the known landmark nearest to a place on one side of a demo.
fn name(demo: &Demo, side: usize, place: DVec3) -> &str {
    let mesh = [&demo.source, &demo.target][side];
    let distance = |k: &usize| mesh.positions()[VertexId(demo.landmarks[*k][side])].distance(place);
    let nearest = (0..demo.labels.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
    &demo.labels[nearest]
}

/// The limb that a landmark's name says: its first two words, or "head" for nose, throat and ears, any of which may be the end of a head.
fn limb(name: &str) -> String {
    if ["nose", "throat", "left ear", "right ear"].contains(&name) {
        return "head".to_owned();
    }
    let words: Vec<&str> = name.split(' ').collect();
    if name.starts_with("left") || name.starts_with("right") {
        words[..2].join(" ")
    } else {
        words[0].to_owned()
    }
}

/// The limbs of source and target that the best candidate pairs; `back` undoes the change that was made to the target.
fn limbs(
    demo: &Demo,
    found: &LandmarkMatch,
    target: &SurfaceMesh,
    back: impl Fn(DVec3) -> DVec3,
) -> Vec<[String; 2]> {
    let best = &found.candidates[0];
    let pair = |source: VertexId, onto: VertexId| {
        [
            limb(name(demo, 0, demo.source.positions()[source])),
            limb(name(demo, 1, back(target.positions()[onto]))),
        ]
    };
    let mut limbs: Vec<[String; 2]> = best.pairs.iter().map(|p| pair(p.source, p.target)).collect();
    limbs.sort();
    limbs
}

fn all_feet_and_both_ends(limbs: &[[String; 2]]) {
    for foot in ["left fore", "right fore", "left hind", "right hind", "tail", "head"] {
        assert!(limbs.iter().any(|pair| pair[0] == foot && pair[1] == foot), "{foot}: {limbs:?}");
    }
    assert!(limbs.iter().all(|[a, b]| a == b), "{limbs:?}");
}

fn turned(p: DVec3) -> DVec3 {
    3.0 * (DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 2.0) * p)
        + DVec3::new(5.0, -7.0, 1.0)
}

fn turned_back(p: DVec3) -> DVec3 {
    DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), -2.0)
        * ((p - DVec3::new(5.0, -7.0, 1.0)) / 3.0)
}

/// The mesh with other numbers of its vertices, and its faces in another order.
fn renumbered(mesh: &SurfaceMesh) -> SurfaceMesh {
    let n = mesh.vertex_count();
    // A step that shares no factor with n visits every number once.
    let step = (n / 2..n).find(|k| (2..=*k).all(|d| !k.is_multiple_of(d) || !n.is_multiple_of(d))).unwrap();
    let new = |v: VertexId| VertexId::from((v.index() * step) % n);
    let mut positions: TiVec<VertexId, DVec3> = vec![DVec3::ZERO; n].into();
    mesh.vertices().for_each(|v| positions[new(v)] = mesh.positions()[v]);
    let faces: TiVec<FaceId, [VertexId; 3]> = mesh.triangles().iter().rev().map(|t| t.map(new)).collect();
    SurfaceMesh::from_triangles(positions, faces).unwrap()
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn with_one_landmark_every_limb_of_the_horse_finds_its_partner_on_the_cat() {
    let demo = demo::build("horse-cat").unwrap();
    let given = [demo.landmarks[0].map(VertexId)];
    let input = MatchInput { given: &given, ..MatchInput::new(&demo.source, &demo.target) };
    let found = match_landmarks(input, &MatchOptions::default(), &mut Silent).unwrap();
    all_feet_and_both_ends(&limbs(&demo, &found, &demo.target, |p| p));
    assert!(found.candidates.is_sorted_by_key(|candidate| candidate.score));
    assert_eq!(found.verdict, Verdict::Sure);
    assert!(found.candidates[0].difference.is_none());
    assert!(found.candidates[1..].iter().all(|candidate| candidate.difference.is_some()));
}

/// Keeps the images and the pairs of the last preview, and counts previews.
#[derive(Default)]
struct Watcher {
    previews: usize,
    images: Vec<DVec3>,
    pairs: Vec<[usize; 2]>,
}

impl Monitor for Watcher {
    fn preview(&mut self, preview: &dyn MapPreview) {
        self.previews += 1;
        self.images = preview.images(MeshSide::Source).unwrap();
        self.pairs = preview.found_pairs();
        assert!(preview.images(MeshSide::Target).is_none());
    }

    fn step(&mut self, _: Step) -> Result<(), Cancelled> {
        Ok(())
    }
}

/// The cat's long tail resembles the horse's neck, so that distances alone would exchange head and tail.
#[test]
fn without_a_landmark_every_limb_of_the_horse_finds_its_partner_on_the_cat() {
    let demo = demo::build("horse-cat").unwrap();
    let input = MatchInput::new(&demo.source, &demo.target);
    let mut watcher = Watcher::default();
    let found = match_landmarks(input, &MatchOptions::default(), &mut watcher).unwrap();
    all_feet_and_both_ends(&limbs(&demo, &found, &demo.target, |p| p));
    // The best map was seen before the end, but for tips that were moved a little.
    let Watcher { previews, images, pairs } = watcher;
    assert!((1..found.candidates.len()).contains(&previews), "{previews}");
    assert_eq!(images.len(), demo.source.vertex_count());
    let root = demo.target.area().sqrt();
    for pair in &found.candidates[0].pairs {
        let off = images[pair.source.index()].distance(demo.target.positions()[pair.target]);
        assert!(off < 0.1 * root, "{} {}: {off}", pair.source.0, pair.target.0);
    }
    // So were its pairs, as vertices of the full meshes.
    assert_eq!(pairs.len(), found.candidates[0].pairs.len());
    for [source, target] in pairs {
        let off = images[source].distance(demo.target.positions()[VertexId::from(target)]);
        assert!(off < 0.1 * root, "{source} {target}: {off}");
    }
}

/// The ends of a flat man: head, left and right hand, left and right foot.
const FLAT_ENDS: [DVec3; 5] = [
    DVec3::new(0.0, 1.0, 0.0),
    DVec3::new(0.9, 0.45, 0.0),
    DVec3::new(-0.9, 0.45, 0.0),
    DVec3::new(0.55, -0.85, 0.0),
    DVec3::new(-0.55, -0.85, 0.0),
];

/// A flat man whose limbs spread in the plane z = 0, with a chest that stands out towards `front`; `limbs` are their lengths.
fn flat_man(front: f64, limbs: [f64; 5]) -> SurfaceMesh {
    let ball = icosphere(4);
    let bump = |p: DVec3, at: DVec3, sharpness: f64| exp(-sharpness * p.distance_squared(at.normalize()));
    let at = |&p: &DVec3| {
        let ends: f64 = FLAT_ENDS.iter().zip(limbs).map(|(end, length)| length * bump(p, *end, 40.0)).sum();
        let chest = 0.5 * front * bump(p, DVec3::new(0.0, 0.3, front), 6.0);
        (1.0 + ends) * p * DVec3::new(1.0, 1.0, 0.4) + DVec3::new(0.0, 0.0, chest)
    };
    ball.with_positions(ball.positions().iter().map(at).collect())
}

/// Chest and back are alike but for what stands out, and no order of limbs tells left from right.
#[test]
fn left_and_right_of_a_flat_man_are_where_his_chest_says() {
    let source = flat_man(1.0, [2.0, 2.0, 2.1, 2.4, 2.3]);
    for (front, images) in [(1.0, [0, 1, 2, 3, 4]), (-1.0, [0, 2, 1, 4, 3])] {
        let target = flat_man(front, [1.8, 2.2, 2.2, 2.4, 2.5]);
        let found = matched(&source, &target);
        let end = |mesh: &SurfaceMesh, v: VertexId| {
            let along = |k: &usize| mesh.positions()[v].normalize().dot(FLAT_ENDS[*k].normalize());
            (0..5).max_by(|a, b| along(a).total_cmp(&along(b))).unwrap()
        };
        let best = &found.candidates[0];
        let mut met = [false; 5];
        for pair in &best.pairs {
            if pair.origin == PairOrigin::Between {
                // A point far from all ends goes to its image under the half turn that takes chest to chest.
                let turned = source.positions()[pair.source] * DVec3::new(front, 1.0, front);
                let off = turned.distance(target.positions()[pair.target]);
                assert!(off < 0.15, "{front}: {off}");
                continue;
            }
            let ends = [end(&source, pair.source), end(&target, pair.target)];
            assert_eq!(images[ends[0]], ends[1], "{front}: {:?}", best.pairs);
            met[ends[0]] = true;
        }
        assert_eq!(met, [true; 5], "{front}: {:?}", best.pairs);
    }
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn a_turned_larger_target_in_another_order_is_matched_alike() {
    let demo = demo::build("horse-cat").unwrap();
    let plain = limbs(&demo, &matched(&demo.source, &demo.target), &demo.target, |p| p);
    let moved = demo.target.with_positions(demo.target.positions().iter().map(|&p| turned(p)).collect());
    let target = renumbered(&moved);
    let found = matched(&demo.source, &target);
    assert_eq!(limbs(&demo, &found, &target, turned_back), plain);
}

#[test]
fn on_the_mirror_image_left_and_right_are_those_of_the_image() {
    let demo = demo::build("horse-cat").unwrap();
    let plain = limbs(&demo, &matched(&demo.source, &demo.target), &demo.target, |p| p);
    let image = mirrored(&demo.target).unwrap();
    let found = matched(&demo.source, &image);
    let back = |p: DVec3| DVec3::new(-p.x, p.y, p.z);
    let exchanged = |limb: &str| match limb.split_once(' ') {
        Some(("left", rest)) => format!("right {rest}"),
        Some(("right", rest)) => format!("left {rest}"),
        _ => limb.to_owned(),
    };
    let mut expected: Vec<[String; 2]> = plain.iter().map(|[a, b]| [a.clone(), exchanged(b)]).collect();
    expected.sort();
    assert_eq!(limbs(&demo, &found, &image, back), expected);
}

#[test]
fn given_pairs_are_held_and_steer_the_rest() {
    let demo = demo::build("horse-cat").unwrap();
    let place = |label: &str| demo.labels.iter().position(|l| l.starts_with(label)).unwrap();
    // This pair is wrong on purpose: it puts the left fore foot on the right one.
    let [left, right] = ["left fore", "right fore"].map(|label| demo.landmarks[place(label)]);
    let given = [[VertexId(left[0]), VertexId(right[1])]];
    let input = MatchInput { given: &given, ..MatchInput::new(&demo.source, &demo.target) };
    let found = match_landmarks(input, &few(), &mut Silent).unwrap();
    for candidate in &found.candidates {
        assert_eq!([candidate.pairs[0].source, candidate.pairs[0].target], given[0]);
    }
    let twice = [given[0], given[0]];
    let error = match_landmarks(MatchInput { given: &twice, ..input }, &few(), &mut Silent).unwrap_err();
    assert_eq!(error, MatchError::Coincident { pairs: [0, 1] });
    let missing = [[VertexId(0), VertexId(u32::MAX)]];
    let error = match_landmarks(MatchInput { given: &missing, ..input }, &few(), &mut Silent).unwrap_err();
    assert!(matches!(error, MatchError::MissingVertex { pair: 0, .. }), "{error}");
}

#[test]
fn a_ball_is_never_sure_and_three_pairs_on_it_lead_to_a_map() {
    let ball = icosphere(3);
    let found = matched(&ball, &ball);
    let Verdict::Unknown { places } = &found.verdict else { panic!("{:?}", found.verdict) };
    assert_eq!(places.len(), 3);
    let given = [[VertexId(0); 2], [VertexId(3); 2], [VertexId(7); 2]];
    let found =
        match_landmarks(MatchInput { given: &given, ..MatchInput::new(&ball, &ball) }, &few(), &mut Silent)
            .unwrap();
    assert_ne!(found.verdict, Verdict::Sure);
    let best = &found.candidates[0];
    assert_eq!(best.pairs.len(), 4);
    // The fourth point is found on the right side of the plane of the others.
    let last = best.pairs[3];
    assert!(ball.positions()[last.source].distance(ball.positions()[last.target]) < 0.3, "{last:?}");
}

struct Stop;

impl Monitor for Stop {
    fn step(&mut self, _: Step) -> Result<(), Cancelled> {
        Err(Cancelled)
    }
}

#[test]
fn it_stops_on_request() {
    let ball = icosphere(2);
    let error = match_landmarks(MatchInput::new(&ball, &ball), &few(), &mut Stop).unwrap_err();
    assert_eq!(error, MatchError::Cancelled(Cancelled));
}

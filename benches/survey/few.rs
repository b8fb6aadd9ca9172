//! Few landmarks, wherever they are.

use crate::arguments::Arguments;
use crate::case::{Case, Make, map_all};
use crate::clicked::Random;
use crate::table::{compare, header};
use glam::DVec3;

/// Numbers of landmarks that are drawn.
const COUNTS: [usize; 2] = [5, 8];

/// Maps each pair with some of its landmarks, drawn at random, and compares with the map of all. Where no truth is known its columns tell of the
/// other landmarks how far their images are from their partners: one on a wrong limb is 30 % off and more. `--landmarks N` draws that number only,
/// `--seeds N` draws N times, from the drawing `--seed N` on.
pub fn drawn(arguments: &Arguments) {
    header();
    let counts = if arguments.landmarks > 0 { vec![arguments.landmarks] } else { COUNTS.to_vec() };
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        let all = name.clone();
        cases.push(Box::new(move || Case { variant: "all".into(), ..Case::of_pair(arguments, &all) }));
        for &count in &counts {
            for seed in arguments.seed..arguments.seed + arguments.seeds {
                let name = name.clone();
                cases.push(Box::new(move || {
                    let case = Case::of_pair(arguments, &name);
                    Case { variant: format!("{count} drawn, {seed}"), ..with_drawn(case, count, seed) }
                }));
            }
        }
    }
    compare(&map_all(cases, arguments), "all");
}

/// The same with `count` of the landmarks.
fn with_drawn(case: Case, count: usize, seed: u64) -> Case {
    let mut random = Random::new(seed);
    let mut left: Vec<usize> = (0..case.points[0].len()).collect();
    let mut kept = Vec::new();
    while kept.len() < count && !left.is_empty() {
        kept.push(left.swap_remove((random.share() * left.len() as f64) as usize));
    }
    let truth = case.truth.clone().unwrap_or_else(|| places_of(&case, &left));
    let points = case.points.each_ref().map(|points| kept.iter().map(|&k| points[k]).collect());
    Case { points, truth: Some(truth), ..case }
}

/// The places of the partners of these landmarks, by the source's vertices; not a number elsewhere.
fn places_of(case: &Case, landmarks: &[usize]) -> Vec<DVec3> {
    let [source, target] = &case.meshes;
    let mut places = vec![DVec3::NAN; source.vertex_count()];
    for &k in landmarks {
        let [from, onto] = [&case.points[0][k], &case.points[1][k]];
        places[from.heaviest_corner(source).index()] = onto.position(target);
    }
    places
}

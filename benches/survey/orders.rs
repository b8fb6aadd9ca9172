//! The class of maps that the search chooses when the landmarks come in another order, or are clicked beside their vertices.

use crate::arguments::Arguments;
use crate::case::{Case, mean_and_quantiles};
use crate::clicked::{Random, moved};
use conemap::coarse_map::class_search::{Chosen, ClassChoice, ClassSearchOptions, choose_class};
use conemap::coarse_map::multilevel::CoarseMap;
use conemap::coarse_map::{LEAST_PER_LANDMARK, LandmarkedMesh, MeshWithCoarse, coarse_levels};
use conemap::math::random::SplitMix;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;
use cpu_time::ThreadTime;

/// Searches for the class of each pair as it is, with `--seeds` other orders of its landmarks and with as many clicked sets. A line has the
/// mean log density of the coarse map that the search chooses, the same after the map is relaxed and on the next finer level, the number of
/// layouts that were judged, and the processor seconds of the search.
pub fn table(arguments: &Arguments) {
    println!(
        "{:20} {:12} {:>8} {:>8} {:>8} {:>4} {:>7} {:>7} {:>6}",
        "pair", "variant", "chosen", "relaxed", "finer", "cls", "cpu s", "truth %", "95 %"
    );
    for name in arguments.names() {
        let case = Case::of_pair(arguments, &name);
        one(arguments, &case, "given");
        for seed in arguments.seed..arguments.seed + arguments.seeds {
            if arguments.variants.is_empty() || arguments.variants.iter().any(|v| v == "order") {
                let mut case = Case::of_pair(arguments, &name);
                permute(&mut case, seed);
                one(arguments, &case, &format!("order {seed}"));
            }
            if arguments.variants.is_empty() || arguments.variants.iter().any(|v| v == "clicks") {
                let mut case = Case::of_pair(arguments, &name);
                let mut random = Random::new(seed - 1);
                for k in 0..2 {
                    case.points[k] = moved(&case.meshes[k], &case.points[k], &mut random);
                }
                one(arguments, &case, &format!("clicks {}", seed - 1));
            }
        }
    }
}

/// Puts the landmarks in another order.
pub fn permute(case: &mut Case, seed: u64) {
    let mut random = SplitMix::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    for k in (1..case.points[0].len()).rev() {
        let other = (random.unit() * (k + 1) as f64) as usize;
        case.points.iter_mut().for_each(|points| points.swap(k, other));
    }
}

fn one(arguments: &Arguments, case: &Case, variant: &str) {
    let multilevel = &arguments.options.multilevel;
    let placed = case.placed().expect("points can be inserted");
    let input = Case::input(&placed);
    let landmarked = [
        LandmarkedMesh::new(input.source, &input.landmarks.source.raw),
        LandmarkedMesh::new(input.target, &input.landmarks.target.raw),
    ]
    .map(|mesh| mesh.expect("room around landmarks"));
    let vertices = multilevel.coarse_vertices.max(LEAST_PER_LANDMARK * input.landmarks.len());
    let sides: [MeshWithCoarse<'_>; 2] =
        coarse_levels(&landmarked, vertices, multilevel.rims, &mut Silent).expect("nobody stops");
    let search =
        ClassSearchOptions { multilevel, search: &arguments.options.search, choice: ClassChoice::Best };
    let begun = ThreadTime::now();
    let chosen = choose_class(&sides, search, &mut Silent);
    let seconds = begun.elapsed().as_secs_f64();
    let Ok(Chosen { search, mut map, .. }) = chosen else {
        println!("{:20} {variant:12} FAILED", case.name);
        return;
    };
    let coarse = map.mean_log;
    map.finish(multilevel, &mut Silent).expect("nobody stops");
    let relaxed = map.mean_log;
    let truth = truth(case, &map);
    let finer = map.judge_finer(multilevel, &mut Silent).map_or(f64::NAN, |_| map.mean_log);
    println!(
        "{:20} {variant:12} {coarse:8.5} {relaxed:8.5} {finer:8.5} {:4} {seconds:7.2} {truth}",
        case.name,
        search.judged.len()
    );
    if arguments.depth >= 2 {
        for (k, judged) in search.judged.iter().enumerate() {
            println!(
                "    {k:3} {:?} {:?} {:?}{}",
                judged.origin,
                judged.detour,
                judged.mean_log,
                if k == search.best { "  BEST" } else { "" }
            );
        }
    }
}

/// The distances between the images of the source's vertices under the coarse map and under the known one, in percent of the root of the
/// target's area: mean and 95 % quantile.
fn truth(case: &Case, map: &CoarseMap<'_>) -> String {
    let (Some(truth), Some(images)) = (&case.truth, map.images()) else { return String::new() };
    let [source, target] = &images.levels;
    // The levels are scaled to area 1.
    let scale = 1.0 / case.meshes[1].area().sqrt();
    let distance = |v: VertexId| {
        let place = *truth.get(source.vertices[v].index())?;
        Some(images.target_from_source[v].position(&target.mesh).distance(place * scale))
    };
    let [mean, _, most] = mean_and_quantiles(source.mesh.vertices().filter_map(distance).collect());
    format!("{:7.3} {:6.2}", 100.0 * mean, 100.0 * most)
}

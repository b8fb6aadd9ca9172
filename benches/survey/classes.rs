//! Tests whether the search finds the best class of maps: every class that a twist of the chosen one gives (one path exchanged) is judged, and
//! with `--depth 2` every class that two twists give.

use crate::arguments::Arguments;
use crate::common;
use conemap::coarse_map::class_search::{ClassChoice, ClassSearchOptions, choose_class};
use conemap::coarse_map::multilevel::solve_coarse;
use conemap::coarse_map::{LandmarkedMesh, MeshWithCoarse, coarse_landmarks};
use conemap::layout::{Candidate, Candidates};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use cpu_time::ThreadTime;

/// Prints for each pair and each number of coarse vertices the mean log density of the class that the search chose, and the least ones among
/// the classes one twist and two twists away from it.
pub fn exhaustive(arguments: &Arguments) {
    println!(
        "{:20} {:>6} {:>8} {:>4} {:>7}  {:>8} {:>4}  {:>8} {:>4} {:>7}",
        "pair", "coarse", "chosen", "cls", "cpu s", "1 twist", "", "2 twists", "", "cpu s"
    );
    let queue =
        std::sync::Mutex::new(arguments.names().into_iter().collect::<std::collections::VecDeque<_>>());
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some(name) = next else { break };
                    for &vertices in &arguments.levels {
                        println!("{}", one(arguments, &name, vertices));
                    }
                }
            });
        }
    });
}

fn one(arguments: &Arguments, name: &str, vertices: usize) -> String {
    let pair = common::read_pair(&arguments.data, name);
    let landmarks = common::landmarks(&pair);
    let landmarked = |mesh: &SurfaceMesh, held: &[VertexId]| {
        LandmarkedMesh::new(mesh, held).expect("room around landmarks")
    };
    let full =
        [landmarked(&pair.source, &landmarks.source.raw), landmarked(&pair.target, &landmarks.target.raw)];
    let sides = [0, 1].map(|k| {
        MeshWithCoarse::new(&full[k], vertices, arguments.options.multilevel.rims, &mut Silent)
            .expect("nobody stops")
    });
    let coarse = coarse_landmarks(&sides);
    let options = ClassSearchOptions {
        multilevel: &arguments.options.multilevel,
        search: &arguments.options.search,
        choice: ClassChoice::Best,
    };
    let begun = ThreadTime::now();
    let chosen = match choose_class(&sides, options, &mut Silent) {
        Ok(chosen) => chosen,
        Err(error) => return format!("{name:20} {vertices:6} FAILED: {error}"),
    };
    let searched = begun.elapsed().as_secs_f64();
    // The pipeline judges its finalists in this way.
    let judge = |candidate: &Candidate| {
        let map = solve_coarse(&sides, &candidate.layout, options.multilevel, &mut Silent);
        map.ok().map_or(f64::INFINITY, |mut map| {
            map.relax(&options.multilevel.decide, &mut Silent).expect("nobody stops");
            map.mean_log
        })
    };
    let known = judge(&chosen.candidate);
    let mut fresh = Candidates::new([&sides[0].coarse.mesh, &sides[1].coarse.mesh], &coarse, &mut Silent)
        .expect("few landmarks");
    let mut best = [f64::INFINITY; 2];
    let mut count = [0; 2];
    let mut twists =
        |of: &Candidate| fresh.twists(of, usize::MAX / 4, f64::INFINITY, &mut Silent).expect("not stopped");
    let singles: Vec<Candidate> = twists(&chosen.candidate);
    for single in &singles {
        let value = judge(single);
        if value < 1.1 * known {
            let [a, b] = [&chosen.candidate, single].map(|c| &c.layout.report);
            println!(
                "    {known:.5} -> {value:.5}, detour {:.3} -> {:.3}, stretch {:.3} -> {:.3}, place {} by detour",
                a.detour, b.detour, a.worst_stretch, b.worst_stretch, count[0]
            );
        }
        best[0] = f64::min(best[0], value);
        count[0] += 1;
        if arguments.depth < 2 {
            continue;
        }
        for double in twists(single) {
            let value = judge(&double);
            best[1] = f64::min(best[1], value);
            count[1] += 1;
        }
    }
    let missed = if best[0].min(best[1]) < 0.99 * known { "  MISSED" } else { "" };
    format!(
        "{name:20} {vertices:6} {known:8.5} {:4} {searched:7.2}  {:8.5} {:4}  {:8.5} {:4} {:7.2}{missed}",
        chosen.search.judged.len(),
        best[0],
        count[0],
        best[1],
        count[1],
        begun.elapsed().as_secs_f64() - searched
    )
}

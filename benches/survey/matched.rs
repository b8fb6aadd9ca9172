//! Pairs matched without a click: how far the known landmarks are from where the coarse map takes them, and what the verdict says.

use crate::arguments::Arguments;
use crate::common;
use conemap::geodesic::distances;
use conemap::landmark_matching::{Candidate, CoarsePicture, MatchInput, MatchOptions, match_landmarks};
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use cpu_time::ThreadTime;
use glam::DVec3;
use typed_index_collections::TiVec;

/// Left and right partners among the landmarks of SHREC07.
const PARTNERS: [[usize; 2]; 8] = [[2, 3], [4, 10], [5, 11], [6, 8], [7, 9], [15, 16], [17, 18], [19, 20]];

/// Landmarks nearer to each other than this share of the root of the area are not told apart.
const APART: f64 = 0.15;

/// A pair with the places of its known landmarks.
struct Known {
    name: String,
    meshes: [SurfaceMesh; 2],
    places: [Vec<DVec3>; 2],
}

/// How well a map fits the known landmarks.
#[derive(Clone, Debug)]
struct Fit {
    /// Mean distance in units of the root of the area.
    error: f64,
    /// Landmarks whose image is nearer to another one's partner.
    wrong: usize,
    /// Which, and the nearer other one.
    which: Vec<[usize; 2]>,
}

/// Both directions of each pair.
pub fn table(arguments: &Arguments) {
    let mut cases: Vec<(String, bool)> = Vec::new();
    for name in arguments.names() {
        cases.push((name.clone(), false));
        if arguments.depth < 2 || name.starts_with("shrec07") {
            cases.push((name, true));
        }
    }
    let queue = std::sync::Mutex::new(cases.into_iter().collect::<std::collections::VecDeque<_>>());
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some((name, reversed)) = next else { break };
                    println!("{}", one(arguments, &name, reversed));
                }
            });
        }
    });
}

fn known(arguments: &Arguments, name: &str, reversed: bool) -> Known {
    let pair = common::read_pair(&arguments.data, name);
    let pairs = common::vertex_pairs(&pair.file);
    let place = |mesh: &SurfaceMesh, side: usize| {
        pairs.iter().map(|ends| mesh.positions()[VertexId(ends[side])]).collect::<Vec<_>>()
    };
    let places = [place(&pair.source, 0), place(&pair.target, 1)];
    let mut known = Known { name: name.to_owned(), meshes: [pair.source, pair.target], places };
    if reversed {
        known.meshes.reverse();
        known.places.reverse();
        known.name.push_str(" back");
    }
    known
}

fn one(arguments: &Arguments, name: &str, reversed: bool) -> String {
    let known = known(arguments, name, reversed);
    let begun = ThreadTime::now();
    let input = MatchInput::new(&known.meshes[0], &known.meshes[1]);
    let mut options = MatchOptions::default();
    let env = |name: &str| std::env::var(name).ok().and_then(|v| v.parse::<usize>().ok());
    if let Some(v) = env("JV") { options.judge_vertices = v; }
    if let Some(v) = env("JC") { options.search.candidates = v; }
    if let Some(v) = env("JT") { options.search.twists = v; }
    if let Some(v) = env("JF") { options.multilevel.finalists = v; }
    if let Some(v) = env("RR") { options.relaxation.max_rounds = v; }
    if let Some(v) = env("SY") { options.symmetric = v; }
    if let Some(v) = env("CH") { options.changes = v; }
    if let Some(v) = env("LV") { options.level_vertices = v; }
    if let Some(v) = env("DR") { options.multilevel.decide.max_rounds = v; }
    let found = match_landmarks(input, &options, &mut Silent).expect("nobody stops");
    let seconds = begun.elapsed().as_secs_f64();
    let mut text = format!("{:24} {seconds:6.2} s {}", known.name, found.verdict.word());
    for c in found.candidates.iter().take(std::env::var("TOP").ok().and_then(|v| v.parse().ok()).unwrap_or(99)) {
        text += &line(&known, c);
    }
    if std::env::var("FULL").is_ok() {
        text += &full(&known, &found.candidates[0], arguments);
    }
    text
}

/// The number of the nearest known landmark.
fn nearest(known: &Known, side: usize, v: VertexId) -> usize {
    let place = known.meshes[side].positions()[v];
    let distance = |k: &usize| known.places[side][*k].distance(place);
    (0..known.places[side].len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

fn line(known: &Known, c: &Candidate) -> String {
    let [straight, exchanged] = fits(known, c);
    let pairs: Vec<String> = c.pairs.iter().map(|pair| format!("{}-{}", nearest(known, 0, pair.source), nearest(known, 1, pair.target))).collect();
    format!(
        "\n    score {:.3} log {:.3} agd {:.4} agree {:.2} cost {:.3} un {:?} | error {:5.2} % wrong {:2} | exchanged {:5.2} % {:2} | {} {}",
        c.score, c.mean_log, c.remoteness, c.agreement, c.cost, c.unmatched,
        100.0 * straight.error, straight.wrong, 100.0 * exchanged.error, exchanged.wrong, pairs.join(" "), c.difference.as_ref().map_or(String::new(), |d| format!("{:?} {:.2}", d.kind, d.share))
    )
}

/// The fit of a candidate's map, and with left and right of the target exchanged where partners are known.
fn fits(known: &Known, c: &Candidate) -> [Fit; 2] {
    let CoarsePicture { source, target, target_from_source } = &c.picture;
    let index = SurfaceIndex::new(source);
    let image = |&p: &DVec3| {
        let point = index.nearest(p).point;
        let corners = source.triangles()[point.face];
        (0..3).map(|k| point.barycentric[k] * target_from_source[corners[k]].position(target)).sum()
    };
    let images: Vec<DVec3> = known.places[0].iter().map(image).collect();
    measured(known, target, &images)
}

/// The fit of images on a mesh that is the target or a level of it.
fn measured(known: &Known, target: &SurfaceMesh, images: &[DVec3]) -> [Fit; 2] {
    let n = images.len();
    let onto = SurfaceIndex::new(target);
    let at = |field: &TiVec<VertexId, f64>, point: &SurfacePoint| -> f64 {
        let corners = target.triangles()[point.face];
        (0..3).map(|k| point.barycentric[k] * field[corners[k]]).sum()
    };
    let images: Vec<SurfacePoint> = images.iter().map(|&p| onto.nearest(p).point).collect();
    let goals: Vec<SurfacePoint> = known.places[1].iter().map(|&p| onto.nearest(p).point).collect();
    // By landmark: distances from the nearest vertex.
    let fields: Vec<_> = goals
        .iter()
        .map(|goal| {
            let corners = target.triangles()[goal.face];
            let k = (0..3).max_by(|&a, &b| goal.barycentric[a].total_cmp(&goal.barycentric[b])).unwrap_or(0);
            distances(target, &[corners[k]])
        })
        .collect();
    let root = target.area().sqrt();
    let mut partner: Vec<usize> = (0..n).collect();
    if n == 21 {
        for [a, b] in PARTNERS {
            partner[a] = b;
            partner[b] = a;
        }
    }
    let fit = |partner_of: &dyn Fn(usize) -> usize| {
        let mut fit = Fit { error: 0.0, wrong: 0, which: Vec::new() };
        for (k, image) in images.iter().enumerate() {
            let own = partner_of(k);
            let place = image.position(target);
            fit.error += place.distance(goals[own].position(target)) / root / n as f64;
            let to = at(&fields[own], image);
            let far = |j: usize| at(&fields[j], &goals[own]) > APART * root;
            if let Some(j) = (0..n).find(|&j| j != own && far(j) && at(&fields[j], image) < to) {
                fit.wrong += 1;
                fit.which.push([own, j]);
            }
        }
        fit
    };
    [fit(&|k| k), fit(&|k| partner[k])]
}

fn full(known: &Known, c: &Candidate, arguments: &Arguments) -> String {
    use conemap::landmarks::Landmarks;
    let pairs: Vec<[u32; 2]> = c.pairs.iter().map(|p| [p.source.0, p.target.0]).collect();
    let [source, target] = &known.meshes;
    let landmarks = Landmarks::from_vertices(source, target, &pairs).expect("landmarks");
    let begun = ThreadTime::now();
    let result = match conemap::pipeline::run(conemap::pipeline::MapInput::new(source, target, &landmarks), &arguments.options, &mut Silent) {
        Ok(result) => result,
        Err(error) => return format!("\n    full FAILED {error}"),
    };
    let seconds = begun.elapsed().as_secs_f64();
    let index = SurfaceIndex::new(source);
    let images: Vec<DVec3> = known.places[0].iter().map(|&p| {
        let point = index.nearest(p).point;
        let k = (0..3).max_by(|&a, &b| point.barycentric[a].total_cmp(&point.barycentric[b])).unwrap_or(0);
        let v = source.triangles()[point.face][k];
        result.target_from_source[v].expect("image").position(target)
    }).collect();
    let fits = measured(known, target, &images);
    format!("\n    full {seconds:.1} s E {:.3} log {:.3} | error {:5.2} % wrong {:2} {:?} | exchanged {:5.2} % {:2}", result.report.distortion.energy, result.report.distortion.mean_log, 100.0 * fits[0].error, fits[0].wrong, fits[0].which, 100.0 * fits[1].error, fits[1].wrong)
}

//! Landmark pairs found by the program, judged by known landmarks: how far the map takes these from their partners, and whether the verdict
//! (sure, doubtful, unknown) is justified.
//!
//! With `--landmarks N` so many of the known landmarks are given; with `--variants answered` the questions of doubtful matches are answered.
//!
//! A match is right when the image of each known landmark is nearer to its partner than to any other landmark, leaving out those within
//! 0.15 of the root of the area from the partner. Left and right of the whole body may be as given or exchanged.

use crate::arguments::Arguments;
use crate::common;
use crate::fit_faults::partners;
use crate::shrec07;
use conemap::geodesic::distances;
use conemap::landmark_matching::{
    Candidate, CoarsePicture, LandmarkMatch, MatchInput, MatchOptions, Question, Verdict, match_landmarks,
};
use conemap::landmarks::Landmarks;
use conemap::math::random::SplitMix as Random;
use conemap::mesh::mirror::mirrored;
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{GroundTruth, MapInput, run};
use conemap::remesh::{Options, remesh};
use cpu_time::ThreadTime;
use glam::{DQuat, DVec3};
use std::collections::VecDeque;
use std::sync::Mutex;
use typed_index_collections::TiVec;

/// The distance between two landmarks, in units of the root of the area, up to which one may be taken for the other.
const APART: f64 = 0.15;

/// Questions that are answered, at most.
const QUESTIONS: usize = 3;

/// Two meshes with the places of their known landmarks in space.
struct Known {
    name: String,
    meshes: [SurfaceMesh; 2],
    places: [Vec<DVec3>; 2],
    /// The landmarks that are left and right partners; none where these are not known.
    partners: Vec<[usize; 2]>,
    truth: GroundTruth<'static>,
}

impl Known {
    /// So many known landmarks as given pairs, the first one and then each time the one that is farthest from those before: the vertices
    /// nearest to their places.
    fn given(&self, count: usize) -> Vec<[VertexId; 2]> {
        let places = &self.places[0];
        let mut chosen: Vec<usize> = (0..count.min(1)).collect();
        while chosen.len() < count.min(places.len()) {
            let off = |k: &usize| {
                chosen.iter().map(|&c| places[c].distance(places[*k])).fold(f64::INFINITY, f64::min)
            };
            chosen.extend((0..places.len()).max_by(|a, b| off(a).total_cmp(&off(b))));
        }
        let index = self.meshes.each_ref().map(SurfaceIndex::new);
        let nearest = |side: usize, k: usize| {
            index[side].nearest(self.places[side][k]).point.heaviest_corner(&self.meshes[side])
        };
        chosen.into_iter().map(|k| [nearest(0, k), nearest(1, k)]).collect()
    }
}

/// How well a map fits the known landmarks.
#[derive(Clone, Debug)]
struct Fit {
    /// The mean straight distance of a landmark's image from its partner, in units of the root of the target's area.
    error: f64,
    /// The landmarks whose image is nearer to another landmark than to their partner, each with the nearest such landmark.
    wrong: Vec<[usize; 2]>,
}

/// The line of a pair, and how it counts in the sums.
struct Reached {
    line: String,
    right: bool,
    /// Whether the match is right but for the landmarks at the neck of SHREC07.
    nearly: bool,
    sure: bool,
    error: f64,
}

/// Matches each pair in both directions, or, with `--seeds N`, onto N variations of its target.
pub fn table(arguments: &Arguments) {
    let mut cases: VecDeque<(String, Change)> = VecDeque::new();
    for name in arguments.names() {
        if arguments.seeds > 1 {
            cases.extend((0..arguments.seeds).map(|seed| (name.clone(), Change::of_seed(seed))));
        } else {
            cases.extend([(name.clone(), Change::None), (name, Change::Exchanged)]);
        }
    }
    let (queue, reached) = (Mutex::new(cases), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some((name, change)) = next else { break };
                    let one = one(arguments, change.known(arguments, &name));
                    println!("{}", one.line);
                    reached.lock().expect("a list").push(one);
                }
            });
        }
    });
    sum_up(&reached.into_inner().expect("a list"));
}

fn sum_up(reached: &[Reached]) {
    let table = |is_right: fn(&Reached) -> bool| {
        let count = |right: bool, sure: bool| {
            reached.iter().filter(|r| is_right(r) == right && r.sure == sure).count()
        };
        println!("sure: {} right, {} wrong", count(true, true), count(false, true));
        println!("not sure: {} right, {} wrong", count(true, false), count(false, false));
    };
    let mut errors: Vec<f64> = reached.iter().map(|r| r.error).collect();
    errors.sort_by(f64::total_cmp);
    let (median, worst) = (errors.get(errors.len() / 2), errors.last());
    println!("median error {:.2} %, worst {:.2} %", percent(median), percent(worst));
    table(|r| r.right);
    println!("without the landmarks at the neck of SHREC07:");
    table(|r| r.nearly);
}

fn percent(share: Option<&f64>) -> f64 {
    100.0 * share.copied().unwrap_or(f64::NAN)
}

/// The change that is made to a pair before it is matched.
#[derive(Clone, Copy)]
enum Change {
    None,
    /// Source and target are exchanged.
    Exchanged,
    /// The target is turned and scaled at random; the number is the seed.
    Turned(u64),
    /// The target is replaced by its mirror image.
    Mirrored,
    /// The target is remeshed to as many triangles.
    Remeshed,
    /// Each coordinate of the target's vertices is moved by up to a tenth of the mean edge; the number is the seed.
    Noise(u64),
}

impl Change {
    fn of_seed(seed: u64) -> Self {
        match seed % 4 {
            0 => Self::Turned(seed),
            1 => Self::Noise(seed),
            2 => Self::Mirrored,
            _ => Self::Remeshed,
        }
    }

    fn known(self, arguments: &Arguments, name: &str) -> Known {
        let pair = common::read_pair(&arguments.data, name);
        let pairs = common::vertex_pairs(&pair.file);
        let place = |mesh: &SurfaceMesh, side: usize| {
            pairs.iter().map(|ends| mesh.positions()[VertexId(ends[side])]).collect::<Vec<_>>()
        };
        let truth = match pair.file.ground_truth {
            Some(_) => GroundTruth::SameConnectivity,
            None => GroundTruth::Unknown,
        };
        let places = [place(&pair.source, 0), place(&pair.target, 1)];
        let partners = partners(&pair);
        let meshes = [pair.source, pair.target];
        let mut known = Known { name: name.to_owned(), meshes, places, partners, truth };
        let moved = |mesh: &SurfaceMesh, to: &mut dyn FnMut(DVec3) -> DVec3| {
            mesh.with_positions(mesh.positions().iter().map(|&p| to(p)).collect())
        };
        match self {
            Self::None => {}
            Self::Exchanged => {
                known.meshes.reverse();
                known.places.reverse();
                known.name.push_str(" back");
            }
            Self::Turned(seed) => {
                let mut random = Random::new(seed);
                let axis = DVec3::new(random.unit(), random.unit(), random.unit()) - 0.5;
                let turn = DQuat::from_axis_angle(axis.normalize_or(DVec3::X), 6.0 * random.unit());
                let scale = 0.1 + 10.0 * random.unit();
                let mut to = |p: DVec3| scale * (turn * p);
                known.meshes[1] = moved(&known.meshes[1], &mut to);
                known.places[1].iter_mut().for_each(|p| *p = to(*p));
                known.name.push_str(" turned");
            }
            Self::Mirrored => {
                known.meshes[1] = mirrored(&known.meshes[1]).expect("a mirror image");
                known.places[1].iter_mut().for_each(|p| p.x = -p.x);
                known.truth = GroundTruth::Unknown;
                known.name.push_str(" mirrored");
            }
            Self::Remeshed => {
                let options = Options::to_faces(known.meshes[1].face_count());
                let remeshed =
                    remesh(&known.meshes[1], &options, &mut Silent).expect("a mesh in other triangles");
                known.meshes[1] = remeshed.mesh;
                known.truth = GroundTruth::Unknown;
                known.name.push_str(" remeshed");
            }
            Self::Noise(seed) => {
                let mut random = Random::new(seed);
                let mesh = &known.meshes[1];
                let mean = mesh.edges().map(|h| mesh.length(h)).sum::<f64>() / mesh.edge_count() as f64;
                let mut to = |p: DVec3| {
                    p + 0.2 * mean * (DVec3::new(random.unit(), random.unit(), random.unit()) - 0.5)
                };
                known.meshes[1] = moved(mesh, &mut to);
                known.name.push_str(" noise");
            }
        }
        known
    }
}

fn one(arguments: &Arguments, known: Known) -> Reached {
    let begun = ThreadTime::now();
    let mut given = known.given(arguments.landmarks);
    let mut found = matched(&known, &given);
    let seconds = begun.elapsed().as_secs_f64();
    let mut line = format!("{:28} {seconds:6.2} s {:9}", known.name, found.verdict.word());
    if arguments.variants.iter().any(|variant| variant == "answered") {
        let answers = settle(&known, &mut given, &mut found);
        line += &format!("{answers} answers: {:9}", found.verdict.word());
    }
    let Some(best) = found.candidates.first() else {
        let line = line + " no candidate";
        return Reached { line, right: false, nearly: false, sure: false, error: f64::NAN };
    };
    let mut fits = of_candidate(&known, best);
    line += &described(best, &fits);
    line += &faults(&fits);
    if arguments.variants.iter().any(|variant| variant == "full") {
        match full(&known, best, arguments) {
            Ok((text, measured)) => {
                line += &text;
                fits = measured;
            }
            Err(error) => line += &format!("\n    full FAILED: {error}"),
        }
    }
    if arguments.depth > 1 {
        line += &alternatives(&known, &found);
    }
    let Fit { error, wrong } = better(&fits);
    let is_neck = |[own, _]: &[usize; 2]| shrec07::is_of(&known.name) && shrec07::NECK.contains(own);
    Reached {
        line,
        right: wrong.is_empty(),
        nearly: wrong.iter().all(is_neck),
        sure: found.verdict == Verdict::Sure,
        error: *error,
    }
}

fn matched(known: &Known, given: &[[VertexId; 2]]) -> LandmarkMatch {
    let input = MatchInput { given, ..MatchInput::new(&known.meshes[0], &known.meshes[1]) };
    match_landmarks(input, &MatchOptions::default(), &mut Silent).expect("nobody stops")
}

/// Answers the questions of doubtful matches, at most [`QUESTIONS`], as somebody would who knows the landmarks, and matches again with the
/// answers as given pairs; returns the number of answers. A question to which neither place is the answer ends it.
fn settle(known: &Known, given: &mut Vec<[VertexId; 2]>, found: &mut LandmarkMatch) -> usize {
    let mut answers = 0;
    while let Verdict::Doubtful(question) = &found.verdict {
        let Some(answer) = answer(known, question).filter(|_| answers < QUESTIONS) else { break };
        given.push([question.source, answer]);
        answers += 1;
        *found = matched(known, given);
    }
    answers
}

/// The place that is the answer to a question: the one nearest to the known landmark that belongs there; `None` where both are farther than
/// [`APART`] from it, or where no known landmark is that near to the vertex in question.
fn answer(known: &Known, question: &Question) -> Option<VertexId> {
    let at = |side: usize, v: VertexId| known.meshes[side].positions()[v];
    let [source_root, target_root] = [0, 1].map(|side| known.meshes[side].area().sqrt());
    let from = at(0, question.source);
    let places = known.places[0].iter().zip(&known.places[1]);
    let near = places.filter(|(own, _)| own.distance(from) < APART * source_root);
    let (_, &goal) = near.min_by(|a, b| a.0.distance(from).total_cmp(&b.0.distance(from)))?;
    let off = |v: &VertexId| at(1, *v).distance(goal);
    let nearest = question.targets.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.filter(|v| off(v) < APART * target_root)
}

/// The fit with fewer wrong landmarks: with left and right as given (preferred where both are equal), or exchanged.
fn better([straight, exchanged]: &[Fit; 2]) -> &Fit {
    if exchanged.wrong.len() < straight.wrong.len() { exchanged } else { straight }
}

/// The wrong landmarks, each with the landmark whose place its image takes.
fn faults(fits: &[Fit; 2]) -> String {
    let faults: Vec<String> =
        better(fits).wrong.iter().map(|[own, other]| format!("{own}>{other}")).collect();
    if faults.is_empty() { String::new() } else { format!(" [{}]", faults.join(" ")) }
}

/// A line for each candidate, with the known landmarks that are nearest to its pairs.
fn alternatives(known: &Known, found: &LandmarkMatch) -> String {
    let mut text = String::new();
    for candidate in &found.candidates {
        let nearest = |side: usize, v: VertexId| {
            let place = known.meshes[side].positions()[v];
            let distance = |k: &usize| known.places[side][*k].distance(place);
            let n = known.places[side].len();
            (0..n).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let pairs =
            candidate.pairs.iter().map(|p| format!("{}-{}", nearest(0, p.source), nearest(1, p.target)));
        let pairs: Vec<String> = pairs.collect();
        let fits = of_candidate(known, candidate);
        text += &format!("\n   {} | {}{}", described(candidate, &fits), pairs.join(" "), faults(&fits));
        if let Some(difference) = &candidate.difference {
            text += &format!(" | {:?} {:.3}", difference.kind, difference.share);
        }
    }
    text
}

fn described(candidate: &Candidate, [straight, exchanged]: &[Fit; 2]) -> String {
    format!(
        " score {:.3} log {:.3} remoteness {:.4} relief {:.4} patches {:.3} orders {:.2} unmatched {:?} | error {:5.2} % wrong {:2} | exchanged {:5.2} % {:2}",
        candidate.score,
        candidate.mean_log,
        candidate.remoteness,
        candidate.relief,
        candidate.patch_fit,
        candidate.agreement,
        candidate.unmatched,
        100.0 * straight.error,
        straight.wrong.len(),
        100.0 * exchanged.error,
        exchanged.wrong.len()
    )
}

/// The fit of a candidate's coarse map: with left and right of the target as given, and exchanged where partners are known.
fn of_candidate(known: &Known, candidate: &Candidate) -> [Fit; 2] {
    let CoarsePicture { source, target, target_from_source } = &candidate.picture;
    let index = SurfaceIndex::new(source);
    let image = |&p: &DVec3| {
        let point = index.nearest(p).point;
        let corners = source.triangles()[point.face];
        (0..3).map(|k| point.barycentric[k] * target_from_source[corners[k]].position(target)).sum()
    };
    let images: Vec<DVec3> = known.places[0].iter().map(image).collect();
    measured(known, target, &images)
}

/// Maps the full meshes with the pairs of a candidate, and returns the figures of the map as text and its fits.
fn full(known: &Known, candidate: &Candidate, arguments: &Arguments) -> Result<(String, [Fit; 2]), String> {
    let pairs: Vec<[u32; 2]> = candidate.pairs.iter().map(|p| [p.source.0, p.target.0]).collect();
    let [source, target] = &known.meshes;
    let landmarks = Landmarks::from_vertices(source, target, &pairs).map_err(|e| e.to_string())?;
    let input = MapInput { ground_truth: known.truth, ..MapInput::new(source, target, &landmarks) };
    let begun = ThreadTime::now();
    let result = run(input, &arguments.options, &mut Silent).map_err(|e| e.to_string())?;
    let seconds = begun.elapsed().as_secs_f64();
    let index = SurfaceIndex::new(source);
    let image = |&p: &DVec3| {
        let point = index.nearest(p).point;
        let corners = source.triangles()[point.face];
        let image = |k: usize| result.target_from_source[corners[k]].map(|image| image.position(target));
        (0..3).map(|k| point.barycentric[k] * image(k).unwrap_or_default()).sum()
    };
    let images: Vec<DVec3> = known.places[0].iter().map(image).collect();
    let fits = measured(known, target, &images);
    let d = &result.report.distortion;
    let truth = result.report.ground_truth.as_ref();
    let truth = truth.map_or(String::new(), |truth| format!(" truth {:.2} %", 100.0 * truth.mean));
    let text = format!(
        "\n    full {seconds:.1} s E {:.3} log {:.3}{truth} | error {:5.2} % wrong {:2} | exchanged {:5.2} % {:2}{}",
        d.energy,
        d.mean_log,
        100.0 * fits[0].error,
        fits[0].wrong.len(),
        100.0 * fits[1].error,
        fits[1].wrong.len(),
        faults(&fits)
    );
    Ok((text, fits))
}

/// The fit of the landmarks' images on a mesh that is the target or a level of it: with left and right of the target as given, and exchanged.
fn measured(known: &Known, target: &SurfaceMesh, images: &[DVec3]) -> [Fit; 2] {
    let n = images.len();
    let onto = SurfaceIndex::new(target);
    let at = |field: &TiVec<VertexId, f64>, point: &SurfacePoint| -> f64 {
        let corners = target.triangles()[point.face];
        (0..3).map(|k| point.barycentric[k] * field[corners[k]]).sum()
    };
    let images: Vec<SurfacePoint> = images.iter().map(|&p| onto.nearest(p).point).collect();
    let goals: Vec<SurfacePoint> = known.places[1].iter().map(|&p| onto.nearest(p).point).collect();
    // The distances along the surface from the vertex that is nearest to a landmark.
    let field = |goal: &SurfacePoint| {
        let weight = |k: &usize| goal.barycentric[*k];
        let nearest = (0..3).max_by(|a, b| weight(a).total_cmp(&weight(b))).unwrap_or(0);
        distances(target, &[target.triangles()[goal.face][nearest]])
    };
    let fields: Vec<_> = goals.iter().map(field).collect();
    let root = target.area().sqrt();
    let mut partner: Vec<usize> = (0..n).collect();
    known.partners.iter().for_each(|&[a, b]| partner.swap(a, b));
    let fit = |partner: &dyn Fn(usize) -> usize| {
        let mut fit = Fit { error: 0.0, wrong: Vec::new() };
        for (k, image) in images.iter().enumerate() {
            let own = partner(k);
            fit.error += image.position(target).distance(goals[own].position(target)) / root / n as f64;
            let to = at(&fields[own], image);
            let far = |j: usize| at(&fields[j], &goals[own]) > APART * root;
            let nearer = (0..n).filter(|&j| j != own && far(j) && at(&fields[j], image) < to);
            let nearest = nearer.min_by(|&a, &b| at(&fields[a], image).total_cmp(&at(&fields[b], image)));
            fit.wrong.extend(nearest.map(|j| [own, j]));
        }
        fit
    };
    [fit(&|k| k), fit(&|k| partner[k])]
}

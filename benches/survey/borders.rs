//! Maps between bodies that are both cut at the neck and capped, compared with the map of the closed pair.
//!
//! Each cut pair is mapped with its holes taken for missing data and with its holes taken to correspond (rim to rim, where skin that lies
//! over a cap costs extra energy); the table has the distance between the rims.

use crate::arguments::Arguments;
use crate::case::Limit;
use crate::common::{self, Pair};
use crate::cutting::{Cuts, Kept, Open, Plane, rim_distances};
use conemap::geodesic::distances;
use conemap::landmarks::Landmarks;
use conemap::mesh::{FaceId, VertexId};
use conemap::pipeline::{
    BorderCase, Borders, CapFaces, GroundTruth, MapInput, MapResult, PipelineOptions, run,
};
use conemap::surface_map::correspondence;
use cpu_time::ThreadTime;
use typed_index_collections::TiVec;

/// A plane cut across a source: the vertices that the plane passes through, and a vertex at the tip of the part that it cuts off.
struct CutPlace {
    through: &'static [u32],
    end: u32,
}

/// Where the source of a pair is cut.
struct Places {
    pair: &'static str,
    neck: CutPlace,
    limb: CutPlace,
}

const PLACES: [Places; 5] = [
    Places {
        pair: "cat-lion",
        neck: CutPlace { through: &[3236, 3272], end: 4263 },
        limb: CutPlace { through: &[173, 82], end: 7179 },
    },
    Places {
        pair: "horse-camel",
        neck: CutPlace { through: &[2890, 2882], end: 4239 },
        limb: CutPlace { through: &[1573], end: 2043 },
    },
    Places {
        pair: "horse-horse05",
        neck: CutPlace { through: &[2890, 2882], end: 4239 },
        limb: CutPlace { through: &[1573], end: 2043 },
    },
    Places {
        pair: "horse-horse01",
        neck: CutPlace { through: &[2890, 2882], end: 4239 },
        limb: CutPlace { through: &[1573], end: 2043 },
    },
    Places {
        pair: "cat-cat1",
        neck: CutPlace { through: &[3423, 5027, 5623], end: 8607 },
        limb: CutPlace { through: &[27262], end: 27774 },
    },
];

/// How a pair is cut.
struct Variant {
    name: &'static str,
    kept: Kept,
    /// Whether the limb is cut too.
    limb: bool,
    /// By how much the target's cut at the neck is moved towards the end, in units of the root of its area.
    moved: f64,
    /// The number of parts into which each edge of the target's rims is cut.
    parts: u32,
}

const USUAL: Variant = Variant { name: "neck", kept: Kept::Body, limb: false, moved: 0.0, parts: 1 };

const VARIANTS: [Variant; 6] = [
    USUAL,
    Variant { name: "head", kept: Kept::Ends, ..USUAL },
    Variant { name: "higher", moved: 0.04, ..USUAL },
    Variant { name: "lower", moved: -0.04, ..USUAL },
    Variant { name: "denser", parts: 4, ..USUAL },
    Variant { name: "neck and limb", limb: true, ..USUAL },
];

/// The figures of one map. Distances are in units of the root of the area of the mesh on which they are measured.
struct Reached {
    certified: bool,
    /// The energy of the map of the cut pair, skin on skin, and that of the closed pair's map on the same skin.
    energy: [f64; 2],
    /// The distance of the images of rim vertices from the other mesh's rims: the mean along the rims and the largest, each of the
    /// direction in which it is larger.
    rims: [f64; 2],
    /// The mean error of the source's vertices within 0.1 of its rims: of the cut pair's map, and of the closed pair's. Where the truth is not
    /// known, the closed pair's images count as true, and its error is 0.
    errors: [f64; 2],
    /// The share of the skin of both meshes whose partner lies in a cap.
    hidden: f64,
    case: BorderCase,
    /// The misfit of each pair of rims that the map takes to correspond.
    misfits: Vec<f64>,
}

/// Maps each pair with each cut, first with holes that are missing data, then as the program guesses; where it does not guess that the rims
/// correspond, a third map is made in which the user says so.
pub fn cut(arguments: &Arguments) {
    println!(
        "{:14} {:11} {:13} {:13} {:>8} {:>8} {:>15} {:>15} {:>8} {:>7}  misfit",
        "pair",
        "cut",
        "borders",
        "case",
        "E",
        "closed",
        "rim %: mean max",
        "near % closed",
        "hidden %",
        "cpu s"
    );
    let wanted = |list: &[String], name: &str| list.is_empty() || list.iter().any(|n| n == name);
    let places: std::collections::VecDeque<&Places> =
        PLACES.iter().filter(|places| wanted(&arguments.pairs, places.pair)).collect();
    let queue = std::sync::Mutex::new(places);
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some(places) = next else { break };
                    let pair = common::read_pair(&arguments.data, places.pair);
                    let closed = closed_map(arguments, &pair);
                    for variant in VARIANTS.iter().filter(|variant| wanted(&arguments.variants, variant.name))
                    {
                        of_variant(arguments, (&pair, places), &closed, variant);
                    }
                }
            });
        }
    });
}

fn closed_map(arguments: &Arguments, pair: &Pair) -> MapResult {
    let landmarks = common::landmarks(pair);
    let input = MapInput::new(&pair.source, &pair.target, &landmarks);
    run(input, &arguments.options, &mut Limit::new(arguments.time_limit)).expect("the closed pair has a map")
}

fn of_variant(
    arguments: &Arguments,
    (pair, places): (&Pair, &Places),
    closed: &MapResult,
    variant: &Variant,
) {
    let cuts = cuts(pair, places, closed, variant);
    let sides = [0, 1].map(|k| {
        let mesh = [&pair.source, &pair.target][k];
        Open::new(cuts[k].cut(mesh, variant.kept, if k == 0 { 1 } else { variant.parts }))
    });
    let is_left = |k: usize, v: u32| cuts[k].is_beyond(VertexId(v)) == (variant.kept == Kept::Ends);
    let mut pairs = common::vertex_pairs(&pair.file);
    pairs.retain(|[s, t]| is_left(0, *s) && is_left(1, *t));
    if pairs.len() < 4 {
        println!("{:14} {:11} left out: {} landmarks", pair.name, variant.name, pairs.len());
        return;
    }
    let mut asked = vec![Borders::Missing, Borders::Guess, Borders::Corresponding];
    while let Some(borders) = (!asked.is_empty()).then(|| asked.remove(0)) {
        let begun = ThreadTime::now();
        let options = PipelineOptions { borders, ..arguments.options.clone() };
        let result = map(&sides, &pairs, &options, arguments.time_limit);
        let seconds = begun.elapsed().as_secs_f64();
        let reached = result.map(|result| measured(pair, &cuts, &sides, [&result, closed], variant));
        println!(
            "{:14} {:11} {:13} {}",
            pair.name,
            variant.name,
            format!("{borders:?}"),
            line(&reached, seconds)
        );
        if borders == Borders::Guess && reached.is_ok_and(|r| r.case == BorderCase::Corresponding) {
            break;
        }
    }
}

/// The cuts of source and target. A target with the source's connectivity is cut at the same vertices; any other target is cut by the planes
/// nearest to the images of the source's rims under the closed pair's map.
fn cuts(pair: &Pair, places: &Places, closed: &MapResult, variant: &Variant) -> [Cuts; 2] {
    let ends = if variant.limb { vec![&places.neck, &places.limb] } else { vec![&places.neck] };
    let planes = |moved: f64| -> Vec<(Plane, VertexId)> {
        let unit = pair.source.area().sqrt();
        let plane = |place: &&CutPlace| Plane::across(&pair.source, place.through, place.end);
        let mut planes: Vec<_> = ends.iter().map(|p| (plane(p), VertexId(p.end))).collect();
        planes[0].0 = planes[0].0.moved(moved * unit);
        planes
    };
    let on_source = Cuts::new(&pair.source, &planes(0.0));
    if pair.file.ground_truth.is_some() {
        return [on_source, Cuts::new(&pair.source, &planes(variant.moved))];
    }
    let vertex_pairs = common::vertex_pairs(&pair.file);
    let unit = pair.target.area().sqrt();
    let image =
        |v: VertexId| closed.target_from_source[v].expect("every vertex has an image").position(&pair.target);
    let mut on_target = Vec::new();
    for (number, plane) in planes(0.0).into_iter().enumerate() {
        let cut = Cuts::new(&pair.source, &[plane]);
        let rim = cut.rim_under(image);
        let end = vertex_pairs.iter().find(|[s, _]| VertexId(*s) == plane.1).expect("ends are landmarks")[1];
        let moved = if number == 0 { variant.moved * unit } else { 0.0 };
        let end = VertexId(end);
        on_target.push((Plane::nearest(&rim, pair.target.positions()[end]).moved(moved), end));
    }
    [on_source, Cuts::new(&pair.target, &on_target)]
}

fn map(
    sides: &[Open; 2],
    pairs: &[[u32; 2]],
    options: &PipelineOptions,
    time_limit: f64,
) -> Result<MapResult, String> {
    let on = |k: usize| -> Vec<VertexId> {
        let vertex = |pair: &[u32; 2]| sides[k].checked.vertex_from_file[pair[k] as usize];
        pairs.iter().map(|pair| vertex(pair).expect("landmarks are on skin")).collect()
    };
    let landmarks = Landmarks { source: on(0).into(), target: on(1).into() };
    let [source, target] = [0, 1].map(|k| &sides[k].checked.mesh);
    let caps = CapFaces { source: sides[0].checked.caps(), target: sides[1].checked.caps() };
    let input = MapInput { source, target, landmarks: &landmarks, ground_truth: GroundTruth::Unknown, caps };
    run(input, options, &mut Limit::new(time_limit)).map_err(|e| e.to_string())
}

fn measured(
    pair: &Pair,
    cuts: &[Cuts; 2],
    sides: &[Open; 2],
    [result, closed]: [&MapResult; 2],
    variant: &Variant,
) -> Reached {
    let report = &result.report;
    let borders = report.borders.as_ref().expect("both meshes have caps");
    let lost = [0, 1].map(|k| {
        let mesh = [&pair.source, &pair.target][k];
        let is_lost = |f: FaceId| match variant.kept {
            Kept::Body => cuts[k].touches(mesh, f),
            Kept::Ends => mesh.triangles()[f].iter().any(|&v| !cuts[k].is_beyond(v)),
        };
        mesh.faces().map(is_lost).collect::<TiVec<FaceId, bool>>()
    });
    let same_skin = CapFaces { source: Some(&lost[0]), target: Some(&lost[1]) };
    let whole = closed.correspondence.as_ref().expect("the closed pair has pieces");
    let on_skin = correspondence::distortion([&pair.source, &pair.target], whole, same_skin);
    Reached {
        certified: report.certificate.as_ref().is_some_and(|c| c.bijective),
        energy: [report.distortion.energy, on_skin.energy],
        rims: rim_distances(sides, result),
        errors: errors(pair, sides, [result, closed]),
        hidden: report.coverage.as_ref().map_or(f64::NAN, |coverage| coverage.hidden),
        case: borders.case,
        misfits: borders.rims.iter().map(|pair| pair.misfit).collect(),
    }
}

/// The mean error of the source's vertices near its rims, under the cut pair's map and under the closed pair's.
fn errors(pair: &Pair, sides: &[Open; 2], [result, closed]: [&MapResult; 2]) -> [f64; 2] {
    let (own, other) = (&sides[0], &sides[1].checked.mesh);
    let mesh = &own.checked.mesh;
    let in_mesh = |v: u32| own.checked.vertex_from_file[v as usize].expect("rims are there");
    let rim: Vec<VertexId> = own.cut.rim_vertices().into_iter().map(in_mesh).collect();
    let from_rim = distances(mesh, &rim);
    let reach = 0.1 * mesh.area().sqrt();
    let unit = 1.0 / pair.target.area().sqrt();
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for v in pair.source.vertices() {
        let Some(own) = own.checked.vertex_from_file[v.index()].filter(|own| from_rim[*own] < reach) else {
            continue;
        };
        let by_closed = closed.target_from_source[v].expect("an image").position(&pair.target);
        let truth = if pair.file.ground_truth.is_some() { pair.target.positions()[v] } else { by_closed };
        let image = result.target_from_source[own].expect("an image").position(other);
        sums[0] += unit * image.distance(truth);
        sums[1] += unit * by_closed.distance(truth);
        count += 1.0;
    }
    sums.map(|sum| sum / count)
}

fn line(outcome: &Result<Reached, String>, seconds: f64) -> String {
    match outcome {
        Ok(r) => {
            let [mean, max] = r.rims.map(|share| 100.0 * share);
            let [near, closed] = r.errors.map(|share| 100.0 * share);
            let misfits: Vec<String> = r.misfits.iter().map(|misfit| format!("{misfit:.3}")).collect();
            format!(
                "{:13} {:8.4} {:8.4} {mean:8.3} {max:6.2} {near:8.3} {closed:6.3} {:8.3} {seconds:7.1}  {}{}",
                format!("{:?}", r.case),
                r.energy[0],
                r.energy[1],
                100.0 * r.hidden,
                misfits.join(" "),
                if r.certified { "" } else { "  NOT CERTIFIED" }
            )
        }
        Err(error) => format!("FAILED: {error}"),
    }
}

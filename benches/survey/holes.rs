//! Maps between two poses of one body after holes were punched into them and capped again: the errors outside the holes, compared with
//! those of the closed pairs. The true map is known.

use crate::arguments::Arguments;
use crate::case::Limit;
use crate::common::{self, Pair};
use crate::punching::remove_around;
use conemap::geodesic::distances;
use conemap::landmarks::{Landmarks, MeshSide};
use conemap::math::random::SplitMix;
use conemap::math::scalar::pow;
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::repair::{RepairOptions, repaired};
use conemap::mesh::soup::PolygonSoup;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{CapFaces, GroundTruth, MapInput, MapResult, run};
use cpu_time::ThreadTime;
use typed_index_collections::TiVec;

/// A vertex at a foot and one at the neck of a mesh of the data folder, around which holes are punched.
struct Places {
    mesh: &'static str,
    foot: u32,
    neck: u32,
}

const PLACES: [Places; 2] = [
    Places { mesh: "sumner/horse", foot: 7553, neck: 2890 },
    Places { mesh: "tosca/cat", foot: 23269, neck: 3423 },
];

/// A set of holes.
struct Holes {
    name: &'static str,
    /// The shares of the area that are removed around the foot and around the neck.
    shares: [f64; 2],
}

const HOLES: [Holes; 5] = [
    Holes { name: "foot 0.5", shares: [0.005, 0.0] },
    Holes { name: "limb 2", shares: [0.02, 0.0] },
    Holes { name: "limb 10", shares: [0.1, 0.0] },
    Holes { name: "neck 2", shares: [0.0, 0.02] },
    Holes { name: "limb and neck 2", shares: [0.02, 0.02] },
];

/// Which meshes of a pair have the holes, the source first.
const SIDES: [(&str, [bool; 2]); 3] =
    [("target", [false, true]), ("source", [true, false]), ("both", [true, true])];

/// A mesh as it is mapped (its vertices know their numbers in the closed mesh), and which of its faces are caps.
struct Punched {
    checked: CheckedMesh,
    is_cap: TiVec<FaceId, bool>,
}

/// The figures of a map of meshes with holes, and those of the closed pair's map at the same vertices. Lengths are in units of the root of the
/// target's area.
struct Reached {
    certified: bool,
    energy: f64,
    /// The mean error of the source's vertices that are skin on both meshes: of the map with holes, and of the closed pair's.
    errors: [f64; 2],
    /// The same mean over the vertices within 0.1 of a rim.
    near: [f64; 2],
    /// How much nearer to the holes the images of the vertices near a rim lie than their true images, on average: positive where skin
    /// slides into the holes, negative where it slides out of them. Of the map with holes, and of the closed pair's.
    slid: [f64; 2],
    /// The shares of the source's and of the target's skin that the map carries into a cap although its true partner is skin.
    hidden: [f64; 2],
    /// The shares of the source's and of the target's skin that the closed pair's map carries into the place of a hole although its true
    /// partner is skin. A map of the punched meshes cannot be expected to do better.
    hidden_closed: [f64; 2],
}

/// A pair of poses with the faces that are removed, which are the same faces of both meshes.
struct Case<'a> {
    pair: &'a Pair,
    name: String,
    removed: TiVec<FaceId, bool>,
}

/// Maps each pair of poses with each set of holes: in the target, in the source, and in both.
pub fn punched(arguments: &Arguments) {
    let pairs = pairs(arguments);
    let wanted =
        |holes: &&Holes| arguments.variants.is_empty() || arguments.variants.iter().any(|v| v == holes.name);
    let of_table = |pair, holes: &Holes| Case { pair, name: holes.name.to_owned(), removed: holes.of(pair) };
    let cases = pairs.iter().flat_map(|pair| HOLES.iter().filter(wanted).map(move |h| of_table(pair, h)));
    table(arguments, cases.collect());
}

/// Maps each pair of poses with holes at random places, one set of holes for each seed.
pub fn anywhere(arguments: &Arguments) {
    let pairs = pairs(arguments);
    let seeds = arguments.seed..arguments.seed + arguments.seeds;
    let cases = pairs.iter().flat_map(|pair| seeds.clone().map(move |seed| at_random(pair, seed)));
    table(arguments, cases.collect());
}

/// A pair with one to three holes around random vertices, each of 0.5 to 5 percent of the area.
fn at_random(pair: &Pair, seed: u64) -> Case<'_> {
    let mut random = SplitMix::new(seed);
    let mut removed: TiVec<FaceId, bool> = pair.source.faces().map(|_| false).collect();
    let shares: Vec<f64> =
        (0..1 + (3.0 * random.unit()) as usize).map(|_| 0.005 * pow(10.0, random.unit())).collect();
    for share in &shares {
        let centre = (random.unit() * pair.source.vertex_count() as f64) as u32;
        remove_around(&pair.source, VertexId(centre), *share, &mut removed);
    }
    remove_cut_off(&pair.source, &mut removed);
    let told: Vec<String> = shares.iter().map(|share| format!("{:.1}", 100.0 * share)).collect();
    Case { pair, name: format!("{seed}: {}", told.join(" ")), removed }
}

/// Removes the parts that holes have cut off, as a hole that goes round a leg does: all but the part with the most faces.
fn remove_cut_off(mesh: &SurfaceMesh, removed: &mut TiVec<FaceId, bool>) {
    let mut part: TiVec<FaceId, Option<usize>> = mesh.faces().map(|_| None).collect();
    let mut sizes = Vec::new();
    for first in mesh.faces() {
        if removed[first] || part[first].is_some() {
            continue;
        }
        let (mut reached, mut size) = (vec![first], 0);
        part[first] = Some(sizes.len());
        while let Some(face) = reached.pop() {
            size += 1;
            for next in face.halfedges().map(|h| mesh.twin(h).face()) {
                if !removed[next] && part[next].is_none() {
                    part[next] = Some(sizes.len());
                    reached.push(next);
                }
            }
        }
        sizes.push(size);
    }
    let largest = (0..sizes.len()).max_by_key(|&k| sizes[k]);
    mesh.faces().for_each(|f| removed[f] |= part[f] != largest);
}

/// Maps the cases, prints a line for each map, and sums up.
fn table(arguments: &Arguments, cases: Vec<Case<'_>>) {
    println!(
        "{:16} {:15} {:7} {:>8} {:>17} {:>17} {:>17} {:>17} {:>17} {:>7}",
        "pair",
        "holes",
        "in",
        "E",
        "error % closed %",
        "at rims   closed",
        "slid in   closed",
        "hidden % of s, t",
        "closed",
        "cpu s"
    );
    let queue = std::sync::Mutex::new(std::collections::VecDeque::from(cases));
    let reached = std::sync::Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some(case) = next else { break };
                    let own = of_case(arguments, &case);
                    reached.lock().expect("a list").extend(own);
                }
            });
        }
    });
    sum_up(&reached.into_inner().expect("a list"));
}

/// The pairs of poses with the same connectivity, and a pair of the two horses that are targets there.
fn pairs(arguments: &Arguments) -> Vec<Pair> {
    let names = ["cat-cat1", "horse-horse01", "horse-horse05"];
    let mut pairs: Vec<Pair> = names.iter().map(|name| common::read_pair(&arguments.data, name)).collect();
    let mut poses = common::read_pair(&arguments.data, "horse-horse05");
    poses.source = common::read_mesh(&arguments.data.join("sumner/horse-pose01.off"));
    poses.file.source = Some("sumner/horse-pose01.off".into());
    poses.name = "horse01-horse05".into();
    pairs.push(poses);
    pairs.retain(|pair| {
        arguments.pairs.is_empty() || arguments.pairs.iter().any(|p| pair.name.starts_with(p.as_str()))
    });
    pairs
}

impl Holes {
    /// The faces of both meshes that are removed. They are chosen by their distances on the source.
    fn of(&self, pair: &Pair) -> TiVec<FaceId, bool> {
        let source = pair.file.source.as_deref().unwrap_or_default();
        let places =
            PLACES.iter().find(|places| source.starts_with(places.mesh)).expect("places of the mesh");
        let mut removed = pair.source.faces().map(|_| false).collect();
        for (centre, share) in [places.foot, places.neck].into_iter().zip(self.shares) {
            remove_around(&pair.source, VertexId(centre), share, &mut removed);
        }
        removed
    }
}

/// Maps the closed pair with the landmarks that the holes leave, then the pair with holes in the target, in the source and in both.
fn of_case(arguments: &Arguments, case: &Case<'_>) -> Vec<Reached> {
    let Case { pair, name: holes, removed } = case;
    let left: Vec<[u32; 2]> = common::vertex_pairs(&pair.file)
        .into_iter()
        .filter(|[v, _]| pair.source.star(VertexId(*v)).any(|h| !removed[h.face()]))
        .collect();
    let meshes = [&pair.source, &pair.target];
    let nothing: TiVec<FaceId, bool> = removed.iter().map(|_| false).collect();
    let punched = meshes.map(|mesh| punch(mesh, removed));
    let whole = meshes.map(|mesh| punch(mesh, &nothing));
    let closed = map(arguments, [&whole[0], &whole[1]], &left);
    let mut reached = Vec::new();
    for (name, is_punched) in SIDES {
        let begun = ThreadTime::now();
        let sides = [0, 1].map(|k| if is_punched[k] { &punched[k] } else { &whole[k] });
        let outcome = match (&closed, &map(arguments, sides, &left)) {
            (Ok(closed), Ok(result)) => Ok(measured(meshes, sides, removed, [result, closed])),
            (Err(error), _) | (_, Err(error)) => Err(error.clone()),
        };
        let seconds = begun.elapsed().as_secs_f64();
        println!("{:16} {:15} {name:7} {}", pair.name, holes, line(&outcome, seconds));
        reached.extend(outcome);
    }
    reached
}

/// Removes faces from a mesh, and repairs what is left as if it came from a user's file.
fn punch(mesh: &SurfaceMesh, removed: &TiVec<FaceId, bool>) -> Punched {
    let kept = mesh.triangles().iter_enumerated().filter(|(f, _)| !removed[*f]);
    let soup = PolygonSoup {
        positions: mesh.positions().iter().copied().collect(),
        polygons: kept.map(|(_, corners)| corners.map(|v| v.0).to_vec()).collect(),
        joined_with: Vec::new(),
    };
    let checked = repaired(&soup, &RepairOptions::default(), &mut Silent)
        .expect("a punched mesh can be capped")
        .checked;
    let is_cap = checked.mesh.faces().map(|f| checked.is_cap(f)).collect();
    Punched { checked, is_cap }
}

fn map(arguments: &Arguments, sides: [&Punched; 2], pairs: &[[u32; 2]]) -> Result<MapResult, String> {
    let on = |k: usize| -> Vec<VertexId> {
        let vertex = |pair: &[u32; 2]| sides[k].checked.vertex_from_file[pair[k] as usize];
        pairs.iter().map(|pair| vertex(pair).expect("landmarks are on skin")).collect()
    };
    let landmarks = Landmarks { source: on(0).into(), target: on(1).into() };
    let [source, target] = sides.map(|side| &side.checked.mesh);
    let caps = CapFaces { source: Some(&sides[0].is_cap), target: Some(&sides[1].is_cap) };
    let input = MapInput { source, target, landmarks: &landmarks, ground_truth: GroundTruth::Unknown, caps };
    let mut limit = Limit::new(arguments.time_limit);
    let result = run(input, &arguments.options, &mut limit).map_err(|e| e.to_string())?;
    if result.correspondence.is_none() {
        let warnings: Vec<String> = result.report.warnings.iter().map(ToString::to_string).collect();
        return Err(format!("the map has no overlay: {}", warnings.join(" ")));
    }
    Ok(result)
}

/// Compares a map of meshes with holes, and the closed pair's map, with the true map, which takes vertex i of the closed source to vertex i of
/// the closed target.
fn measured(
    closed: [&SurfaceMesh; 2],
    sides: [&Punched; 2],
    removed: &TiVec<FaceId, bool>,
    [result, whole]: [&MapResult; 2],
) -> Reached {
    let scale = 1.0 / closed[1].area().sqrt();
    let is_skin = |v: VertexId| closed[0].star(v).any(|h| !removed[h.face()]);
    let is_rim = |v: VertexId| is_skin(v) && closed[0].star(v).any(|h| removed[h.face()]);
    let rims: Vec<VertexId> = closed[0].vertices().filter(|&v| is_rim(v)).collect();
    let from_rim = distances(closed[0], &rims);
    let reach = 0.1 * closed[0].area().sqrt();
    let depths = depths(closed[1], removed);
    let on_target: [Depths; 2] = [Depths::new(&sides[1].checked, &depths), Depths(depths.clone())];
    let (mut sums, mut near, mut slid) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let (mut all, mut close) = (0.0, 0.0);
    for v in closed[0].vertices().filter(|&v| is_skin(v)) {
        let truth = closed[1].positions()[v];
        let own = sides[0].checked.vertex_from_file[v.index()].expect("skin is there");
        let mapped = [(result, own, &sides[1].checked.mesh), (whole, v, closed[1])];
        let errors = mapped.map(|(map, v, target)| {
            let image = map.target_from_source[v].expect("the relaxed map has all images");
            image.position(target).distance(truth) * scale
        });
        all += 1.0;
        (0..2).for_each(|k| sums[k] += errors[k]);
        if from_rim[v] < reach {
            close += 1.0;
            (0..2).for_each(|k| near[k] += errors[k]);
            for (k, (map, own, target)) in mapped.into_iter().enumerate() {
                let image = map.target_from_source[own].expect("the relaxed map has all images");
                slid[k] += scale * (on_target[k].at(target, image) - depths[v]);
            }
        }
    }
    let of_caps = |side: MeshSide, face: FaceId| sides[side].is_cap[face];
    let of_holes = |side: MeshSide, face: FaceId| removed[face] && sides[side].is_cap.raw.contains(&true);
    let own =
        |side: MeshSide, v: VertexId| sides[side].checked.vertex_from_file[v.index()].expect("skin is there");
    Reached {
        certified: result.report.certificate.as_ref().is_some_and(|c| c.bijective),
        energy: result.report.distortion.energy,
        errors: sums.map(|sum| sum / all),
        near: near.map(|sum| sum / close),
        slid: slid.map(|sum| sum / close),
        hidden: MeshSide::BOTH.map(|side| {
            let images = vertex_images(result, sides.map(|side| &side.checked.mesh), side);
            hidden(closed[side], removed, |v| images[own(side, v)].is_some_and(|f| of_caps(side.other(), f)))
        }),
        hidden_closed: MeshSide::BOTH.map(|side| {
            let images = vertex_images(whole, closed, side);
            hidden(closed[side], removed, |v| images[v].is_some_and(|f| of_holes(side.other(), f)))
        }),
    }
}

/// The distance of each vertex of a closed mesh from the rims of the holes along the surface, positive inside the holes.
fn depths(mesh: &SurfaceMesh, removed: &TiVec<FaceId, bool>) -> TiVec<VertexId, f64> {
    let is_skin = |v: VertexId| mesh.star(v).any(|h| !removed[h.face()]);
    let is_rim = |v: &VertexId| is_skin(*v) && mesh.star(*v).any(|h| removed[h.face()]);
    let rims: Vec<VertexId> = mesh.vertices().filter(is_rim).collect();
    let away = distances(mesh, &rims);
    mesh.vertices().map(|v| if is_skin(v) { -away[v] } else { away[v] }).collect()
}

/// How deep inside holes the vertices of a mesh lie. Vertices that a cap has added, which the closed mesh does not have, count as lying at the
/// rim (0).
struct Depths(TiVec<VertexId, f64>);

impl Depths {
    fn new(checked: &CheckedMesh, of_file: &TiVec<VertexId, f64>) -> Self {
        let mut depths: TiVec<VertexId, f64> = checked.mesh.vertices().map(|_| 0.0).collect();
        for (depth, own) in of_file.iter().zip(&checked.vertex_from_file) {
            if let Some(v) = own {
                depths[*v] = *depth;
            }
        }
        Self(depths)
    }

    fn at(&self, mesh: &SurfaceMesh, point: SurfacePoint) -> f64 {
        let corners = mesh.triangles()[point.face];
        corners.iter().zip(point.barycentric).map(|(v, share)| share * self.0[*v]).sum()
    }
}

/// The face of the other mesh that holds the image of each vertex of one mesh.
fn vertex_images(
    map: &MapResult,
    meshes: [&SurfaceMesh; 2],
    side: MeshSide,
) -> TiVec<VertexId, Option<FaceId>> {
    let correspondence = map.correspondence.as_ref().expect("the relaxed map has its pieces");
    let images = correspondence.vertex_images(meshes, side);
    images.iter().map(|image| image.map(|image| image.face)).collect()
}

/// The share of a closed mesh's skin that is hidden, measured by the areas of vertices; `removed` tells the faces in holes.
fn hidden(closed: &SurfaceMesh, removed: &TiVec<FaceId, bool>, is_hidden: impl Fn(VertexId) -> bool) -> f64 {
    let areas = closed.vertex_areas();
    let (mut skin, mut inside) = (0.0, 0.0);
    for v in closed.vertices().filter(|&v| closed.star(v).all(|h| !removed[h.face()])) {
        skin += areas[v];
        if is_hidden(v) {
            inside += areas[v];
        }
    }
    inside / skin
}

fn line(outcome: &Result<Reached, String>, seconds: f64) -> String {
    match outcome {
        Ok(r) => {
            let [own, closed] = r.errors.map(|e| 100.0 * e);
            let [near, near_closed] = r.near.map(|e| 100.0 * e);
            let [slid, slid_closed] = r.slid.map(|e| 100.0 * e);
            let [source, target] = r.hidden.map(|e| 100.0 * e);
            let [source_closed, target_closed] = r.hidden_closed.map(|e| 100.0 * e);
            format!(
                "{:8.4} {own:8.3} {closed:8.3} {near:8.3} {near_closed:8.3} {slid:8.3} {slid_closed:8.3} {source:8.3} {target:8.3} {source_closed:8.3} \
                 {target_closed:8.3} {seconds:7.1}{}",
                r.energy,
                if r.certified { "" } else { "  NOT CERTIFIED" }
            )
        }
        Err(error) => format!("FAILED: {error}"),
    }
}

/// Prints how many maps are certified, and how many keep each of the limits that are wanted.
fn sum_up(reached: &[Reached]) {
    let count = |is: &dyn Fn(&Reached) -> bool| reached.iter().filter(|r| is(r)).count();
    let mean =
        |value: &dyn Fn(&Reached) -> f64| reached.iter().map(value).sum::<f64>() / reached.len() as f64;
    println!(
        "{} maps: {} certified; mean error at most 1.2 times the closed pair's in {}; near rims at most 0.3 % more in {}; hidden \
         at most 0.2 % in {}, and 0.2 % more than what the closed pair's map carries into holes in {}; mean ratio {:.3}, near rims {:.3} % with holes and {:.3} % closed",
        reached.len(),
        count(&|r| r.certified),
        count(&|r| r.errors[0] <= 1.2 * r.errors[1]),
        count(&|r| r.near[0] <= r.near[1] + 0.003),
        count(&|r| r.hidden.iter().all(|share| *share <= 0.002)),
        count(&|r| r.hidden.iter().zip(r.hidden_closed).all(|(share, closed)| *share <= closed + 0.002)),
        mean(&|r| r.errors[0] / r.errors[1]),
        100.0 * mean(&|r| r.near[0]),
        100.0 * mean(&|r| r.near[1]),
    );
}

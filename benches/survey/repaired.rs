//! Maps of meshes with faults, after all repairs that the page offers: onto a partner where there is one, and otherwise onto an independently
//! remeshed, bent copy of the repaired surface, whose true map is known. A mesh that cannot be repaired is listed with the reason.

use crate::arguments::Arguments;
use crate::case::Limit;
use crate::common;
use conemap::export::obj;
use conemap::export::vertex_image::Direction;
use conemap::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use conemap::io::read_mesh as read_soup;
use conemap::job::{Job, JobFiles, MeshFaults, ReadMesh, ReadOptions, read_mesh};
use conemap::landmark_exchange::GivenFile;
use conemap::math::matrix2::squares;
use conemap::math::scalar::{cos, sin};
use conemap::math::triangle;
use conemap::mesh::repair::{Handles, Parts, RepairOptions};
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::{Monitor, Silent};
use conemap::pipeline::{Choices, MapResult};
use conemap::remesh::{Options, carried, remesh};
use cpu_time::ThreadTime;
use glam::{DMat2, DVec3};

/// The mesh that a file is mapped onto or from.
enum Partner {
    /// The other mesh of a pair: the file takes the place of one of them, and its vertices have the same numbers.
    ByNumber { pair: &'static str, side: usize },
    /// The other mesh of a pair: the file takes the place of one of them, and each landmark goes to the file's vertex nearest to its place.
    ByPlace { pair: &'static str, side: usize },
    /// A bent copy of the file's own repaired surface.
    Copy,
}

/// The files of the folders `bad` and `open` that are mapped.
const FILES: [(&str, Partner); 13] = [
    ("open/dog0-open", Partner::ByNumber { pair: "cat-dog", side: 1 }),
    ("bad/horse-slit", Partner::ByNumber { pair: "horse-horse05", side: 0 }),
    ("bad/camel-nonmanifold", Partner::ByPlace { pair: "horse-camel", side: 1 }),
    ("bad/cow-pinched-vertex", Partner::Copy),
    ("bad/genus1-rocker-arm", Partner::Copy),
    ("bad/open-teapot", Partner::Copy),
    ("bad/suzanne-parts", Partner::Copy),
    ("open/alligator-open", Partner::Copy),
    ("open/bunny-open", Partner::Copy),
    ("open/demosthenes-open", Partner::Copy),
    ("open/falcon-open", Partner::Copy),
    ("open/human-parts", Partner::Copy),
    ("open/skull-genus2", Partner::Copy),
];

/// All repairs that the page offers.
const REPAIRS: RepairOptions =
    RepairOptions { join_within: 0.0, parts: Parts::LargestAlone, handles: Handles::Cut };

/// The number of landmarks on a copy, where the command line says nothing else.
const LANDMARKS: usize = 12;

/// A map's files.
struct Files {
    meshes: [Vec<u8>; 2],
    landmarks: Vec<u8>,
    truth: Option<Truth>,
}

/// The true map, where it is known.
struct Truth {
    /// The image of each vertex of the source's file.
    images: Vec<DVec3>,
    /// What the true map does to skin; known for copies.
    skin: Option<Skin>,
}

/// What the true map does to skin.
#[derive(Clone, Copy)]
pub struct Skin {
    /// The energy of the true map over skin; 4 for an isometry.
    pub energy: f64,
    /// The share of the target's area that is the image of skin.
    covered: f64,
}

/// Repairs and maps each file.
pub fn files(arguments: &Arguments) {
    println!(
        "{:24} {:>9} {:>8} {:>8} {:>13} {:>13} {:>7} {:>7}  repairs",
        "file", "certified", "E", "true", "error %, 95 %", "covered s, t", "true", "cpu s"
    );
    let wanted =
        |name: &str| arguments.pairs.is_empty() || arguments.pairs.iter().any(|p| name.contains(p.as_str()));
    let files = FILES.iter().filter(|(name, _)| wanted(name));
    let queue = std::sync::Mutex::new(files.collect::<std::collections::VecDeque<_>>());
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some((name, partner)) = next else { break };
                    let begun = ThreadTime::now();
                    let told = line(arguments, name, partner);
                    let seconds = begun.elapsed().as_secs_f64();
                    match told {
                        Ok([figures, repairs]) => println!("{name:24} {figures} {seconds:7.1}  {repairs}"),
                        Err(error) => println!("{name:24} REFUSED after {seconds:.1} s: {error}"),
                    }
                }
            });
        }
    });
}

/// Repairs and maps a file: the figures of the map, and the sentences that tell the repairs.
fn line(arguments: &Arguments, name: &str, partner: &Partner) -> Result<[String; 2], String> {
    let bytes = std::fs::read(arguments.data.join(format!("{name}.off"))).expect("a file");
    let files = match partner {
        Partner::ByNumber { pair, side } => of_pair(arguments, pair, *side, bytes, |v, _| v),
        Partner::ByPlace { pair, side } => {
            let soup = read_soup(&bytes).map_err(|e| e.to_string())?;
            of_pair(arguments, pair, *side, bytes, |_, place| {
                let far = |v: &usize| soup.positions[*v].distance_squared(place);
                let nearest = (0..soup.positions.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
                nearest.expect("vertices") as u32
            })
        }
        Partner::Copy => copy(bytes, if arguments.landmarks == 0 { LANDMARKS } else { arguments.landmarks })?,
    };
    let mut limit = Limit::new(arguments.time_limit);
    let job = read(&files, &mut limit)?;
    let result = job.run(&arguments.options, &mut limit).map_err(|e| e.to_string())?;
    let repairs = job.repairs().iter().map(|repair| repair.sentence()).filter(|told| !told.is_empty());
    Ok([figures(&job, &result, files.truth.as_ref()), repairs.collect::<Vec<_>>().join("; ")])
}

fn read(files: &Files, monitor: &mut dyn Monitor) -> Result<Job, String> {
    let landmarks = [GivenFile { name: "pairs.json", bytes: &files.landmarks }];
    let [source, target] = &files.meshes;
    let given = JobFiles { source, target, landmarks: &landmarks };
    let options = ReadOptions { mesh_faults: MeshFaults::Repaired(REPAIRS), ..ReadOptions::default() };
    Job::read(given, options, monitor).map_err(|e| e.to_string())
}

/// The files of a pair, with one of its meshes replaced. Where the replaced source and the target are two poses of one body, the true
/// images of the source's vertices are known.
fn of_pair(
    arguments: &Arguments,
    pair: &str,
    side: usize,
    bytes: Vec<u8>,
    vertex: impl Fn(u32, DVec3) -> u32,
) -> Files {
    let pair = common::read_pair(&arguments.data, pair);
    let replaced = [&pair.source, &pair.target][side];
    let pairs = common::vertex_pairs(&pair.file).into_iter().map(|mut ends| {
        ends[side] = vertex(ends[side], replaced.positions()[VertexId(ends[side])]);
        ends.map(LandmarkPoint::Vertex)
    });
    let file = LandmarkFile { pairs: pairs.collect(), ..LandmarkFile::default() };
    let is_poses = pair.file.ground_truth.is_some() && side == 0;
    let images = || pair.target.positions().iter().copied().collect();
    let truth = is_poses.then(|| Truth { images: images(), skin: None });
    let mut meshes = [obj::mesh(&pair.source), obj::mesh(&pair.target)];
    meshes[side] = bytes;
    Files { meshes, landmarks: landmark_file::write(&file), truth }
}

/// A file and the bent copy of its repaired surface, in triangles of its own.
fn copy(bytes: Vec<u8>, landmarks: usize) -> Result<Files, String> {
    let read = read_mesh(&bytes, MeshFaults::Repaired(REPAIRS), &mut Silent);
    let ReadMesh { mesh, .. } = read.map_err(|e| e.to_string())?;
    let checked = mesh.checked();
    let bend = bend_of(&checked.mesh);
    let bent = checked.mesh.with_positions(checked.mesh.positions().iter().map(|p| bend(*p)).collect());
    let faces = Options::to_faces(bent.face_count().max(2000));
    let remeshed = remesh(&bent, &faces, &mut Silent).map_err(|e| e.to_string())?.mesh;
    // Only vertices of the file can be landmarks, not those that a repair has added.
    let numbers = checked.file_from_vertex();
    let in_file = |v: &VertexId| numbers[v.index()] < checked.vertex_from_file.len();
    let chosen: Vec<VertexId> = common::farthest_points(&checked.mesh, 3 * landmarks)
        .into_iter()
        .filter(in_file)
        .take(landmarks)
        .collect();
    let points: Vec<SurfacePoint> = chosen.iter().map(|&v| SurfacePoint::at_vertex(&bent, v)).collect();
    let places = carried(&bent, &remeshed, &points);
    let pair = |(v, place): (&VertexId, &SurfacePoint)| {
        let on_copy = LandmarkPoint::OnFace { face: place.face.0, barycentric: place.barycentric };
        [LandmarkPoint::Vertex(numbers[v.index()] as u32), on_copy]
    };
    let file =
        LandmarkFile { pairs: chosen.iter().zip(&places).map(pair).collect(), ..LandmarkFile::default() };
    let soup = read_soup(&bytes).map_err(|e| e.to_string())?;
    let images = soup.positions.iter().map(|p| bend(*p)).collect();
    let skin = energy_of_places([&checked.mesh, &bent], |f| !checked.is_cap(f));
    let meshes = [bytes, obj::mesh(&remeshed)];
    let truth = Some(Truth { images, skin: Some(skin) });
    Ok(Files { meshes, landmarks: landmark_file::write(&file), truth })
}

/// What moving a mesh's vertices does to its faces that are skin; the skin is scaled to area 1 before and after.
pub fn energy_of_places([from, to]: [&SurfaceMesh; 2], is_skin: impl Fn(FaceId) -> bool) -> Skin {
    let faces = || from.faces().filter(|&f| is_skin(f));
    let [areas, images] = [from, to].map(|mesh| faces().map(|f| mesh.face_area(f)).sum::<f64>());
    let edges = |mesh: &SurfaceMesh, f: FaceId| {
        let [a, b, c] = mesh.corners(f);
        let [p, q, r] = triangle::lay_out([a.distance(b), b.distance(c), c.distance(a)]);
        DMat2::from_cols(q - p, r - p)
    };
    let energy = |f: FaceId| {
        let [before, after] = [edges(from, f), edges(to, f)];
        let [there, back] = [after * before.inverse(), before * after.inverse()];
        squares(&there) * from.face_area(f) / images + squares(&back) * to.face_area(f) / areas
    };
    Skin { energy: faces().map(energy).sum(), covered: images / to.area() }
}

/// A bend along the longest side of the box around a mesh, by half a radian from end to end.
fn bend_of(mesh: &SurfaceMesh) -> impl Fn(DVec3) -> DVec3 + use<> {
    let least = mesh.positions().iter().copied().reduce(DVec3::min).unwrap_or_default();
    let most = mesh.positions().iter().copied().reduce(DVec3::max).unwrap_or_default();
    let size = most - least;
    let axes = if size.x >= size.y && size.x >= size.z {
        [0, 1, 2]
    } else if size.y >= size.z {
        [1, 2, 0]
    } else {
        [2, 0, 1]
    };
    let length = size[axes[0]];
    let radius = 2.0 * length;
    move |p: DVec3| {
        let along = p[axes[0]] - 0.5 * (least + most)[axes[0]];
        let beside = radius - (p[axes[1]] - least[axes[1]]);
        let angle = along / radius;
        let mut q = p;
        q[axes[0]] = beside * sin(angle);
        q[axes[1]] = -beside * cos(angle);
        q
    }
}

fn figures(job: &Job, result: &MapResult, truth: Option<&Truth>) -> String {
    let report = &result.report;
    let is_certified = report.certificate.as_ref().is_some_and(|c| c.bijective);
    let certified = if is_certified { "yes" } else { "NO" };
    let errors = truth.and_then(|truth| errors(job, result, &truth.images));
    let errors = errors.map_or(String::new(), |errors| {
        let [mean, p95] = errors.map(|share| 100.0 * share);
        format!("{mean:.3} {p95:.3}")
    });
    let coverage = report.coverage.as_ref().map_or(String::new(), |coverage| {
        format!("{:.2} {:.2}", 100.0 * coverage.source, 100.0 * coverage.target)
    });
    let skin = truth.and_then(|truth| truth.skin);
    let [energy, covered] = skin.map_or([String::new(), String::new()], |skin| {
        [format!("{:.4}", skin.energy), format!("{:.2}", 100.0 * skin.covered)]
    });
    format!(
        "{certified:>9} {:8.4} {energy:>8} {errors:>13} {coverage:>13} {covered:>7}",
        report.distortion.energy
    )
}

/// The mean and the 95 % quantile of the straight distance between the images of the file's vertices and their true images, which are first
/// put on the nearest point of the target; in units of the root of the target's area.
fn errors(job: &Job, result: &MapResult, truth: &[DVec3]) -> Option<[f64; 2]> {
    let map = job.map_file(result, &Choices::default())?;
    let taken = job.taken(&map);
    let target = taken.surfaces()[1];
    let (index, unit) = (SurfaceIndex::new(target), 1.0 / target.area().sqrt());
    let images = taken.vertex_images(Direction::SourceToTarget);
    let error = |(image, truth): (&Option<conemap::export::vertex_image::PointImage>, &DVec3)| {
        let image = image.as_ref()?;
        Some(unit * image.position.distance(index.nearest(*truth).point.position(target)))
    };
    let mut all: Vec<f64> = images.iter().zip(truth).filter_map(error).collect();
    all.sort_by(f64::total_cmp);
    let p95 = all[(0.95 * (all.len() - 1) as f64) as usize];
    Some([all.iter().sum::<f64>() / all.len() as f64, p95])
}

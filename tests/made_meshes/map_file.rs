//! Tests of maps that are saved and opened again, on the program's own demos: nothing is lost, and nothing is computed.

use conemap::demo;
use conemap::export;
use conemap::export::vertex_image::Direction;
use conemap::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use conemap::io::read_mesh;
use conemap::job::{Job, JobFiles, MapFiles, OpenMap, OutputKind, TakenMap, TargetImage, prove};
use conemap::landmark_exchange::GivenFile;
use conemap::landmarks::MeshSide;
use conemap::map_file::MapFile;
use conemap::math::random::SplitMix;
use conemap::mesh::mirror::mirrored;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use conemap::monitor::Silent;
use conemap::pipeline::{Choices, MapResult, PipelineOptions};
use conemap::surface_map::flat_layout::FlatLayout;
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// A demo that was mapped.
struct Mapped {
    files: [Vec<u8>; 2],
    job: Job,
    result: MapResult,
    map: MapFile,
    bytes: Vec<u8>,
}

fn mapped(meshes: [&SurfaceMesh; 2], pairs: Vec<[LandmarkPoint; 2]>, image: TargetImage) -> Mapped {
    let landmarks = landmark_file::write(&LandmarkFile { pairs, ..LandmarkFile::default() });
    let files = meshes.map(export::obj::mesh);
    let landmarks = [GivenFile { name: "landmarks.json", bytes: &landmarks }];
    let given = JobFiles { source: &files[0], target: &files[1], landmarks: &landmarks };
    let job = Job::read(given, image, &mut Silent).unwrap();
    let result = job.run(&PipelineOptions::default(), &mut Silent).unwrap();
    let map = job.map_file(&result, &Choices::default()).unwrap();
    let bytes = job.taken(&map).output(OutputKind::Map).unwrap();
    Mapped { files, job, result, map, bytes }
}

/// The map of the horse onto the cat, with landmarks inside faces, so that both meshes are refined, and with own cones of the program.
fn horse_cat() -> &'static Mapped {
    static MAP: OnceLock<Mapped> = OnceLock::new();
    MAP.get_or_init(|| {
        let demo = demo::build("horse-cat").unwrap();
        let on_face = |mesh: &SurfaceMesh, v: u32| {
            let face = mesh.faces().find(|&f| mesh.triangles()[f].iter().any(|c| c.0 == v)).unwrap();
            let weights = mesh.triangles()[face].map(|c| if c.0 == v { 0.6 } else { 0.2 });
            LandmarkPoint::OnFace { face: face.0, barycentric: weights }
        };
        let pair = |&[s, t]: &[u32; 2]| [on_face(&demo.source, s), on_face(&demo.target, t)];
        let pairs = demo.landmarks.iter().map(pair).collect();
        mapped([&demo.source, &demo.target], pairs, TargetImage::AsGiven)
    })
}

/// The map of the demo of sphere and tetrahedron, whose target's file is a mirror image.
fn mirrored_demo() -> &'static Mapped {
    static MAP: OnceLock<Mapped> = OnceLock::new();
    MAP.get_or_init(|| {
        let demo = demo::build("sphere-tetrahedron").unwrap();
        let image = mirrored(&demo.target).unwrap();
        let pairs = demo.landmarks.iter().map(|pair| pair.map(LandmarkPoint::Vertex)).collect();
        mapped([&demo.source, &image], pairs, TargetImage::Mirrored)
    })
}

fn both() -> [&'static Mapped; 2] {
    [horse_cat(), mirrored_demo()]
}

fn open(mapped: &Mapped) -> OpenMap {
    let [source, target] = &mapped.files;
    OpenMap::read(MapFiles { map: &mapped.bytes, source, target }).unwrap()
}

/// The second certificate agrees with the first one, with own cones and landmarks inside faces, and for a mirror image.
#[test]
fn the_second_program_proves_the_map() {
    for (mapped, is_mirrored) in [(horse_cat(), false), (mirrored_demo(), true)] {
        assert!(mapped.result.report.certificate.as_ref().is_some_and(|c| c.bijective));
        let [source, target] = &mapped.files;
        let files = MapFiles { map: &mapped.bytes, source, target };
        let proof = prove(files, &mut |_| ControlFlow::Continue(())).unwrap();
        assert!(proof.is_exact() && proof.is_mirrored == is_mirrored, "{proof:?}");
        assert_eq!(proof.pieces, mapped.map.correspondence.pieces.len());
        assert_eq!(proof.landmarks.pairs, mapped.map.landmarks.pairs.len());
        assert!(proof.landmarks.largest_distance < 1e-12, "{proof:?}");
        // With the meshes exchanged the file is refused, and the error names the mesh.
        let files = MapFiles { map: &mapped.bytes, source: target, target: source };
        let error = prove(files, &mut |_| ControlFlow::Continue(())).unwrap_err();
        assert_eq!((error.kind(), error.side()), ("other-mesh", Some(MeshSide::Source)));
    }
}

/// Checks that two texts have the same words, and the same numbers up to rounding.
fn assert_same_text(a: &str, b: &str, kind: OutputKind) {
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| !(c.is_alphanumeric() || "+-.".contains(c))).map(str::to_owned).collect()
    };
    let [a, b] = [words(a), words(b)];
    assert_eq!(a.len(), b.len(), "{kind:?}");
    for (a, b) in a.iter().zip(&b).filter(|(a, b)| a != b) {
        let [x, y]: [f64; 2] = [a, b].map(|word| word.parse().unwrap_or(f64::NAN));
        assert!((x - y).abs() <= 1e-9 + 1e-6 * x.abs(), "{kind:?}: {a} {b}");
    }
}

#[test]
fn an_opened_map_gives_the_files_of_the_run() {
    for mapped in both() {
        let open = open(mapped);
        let [run, opened]: [TakenMap<'_>; 2] = [mapped.job.taken(&mapped.map), open.taken()];
        assert_eq!(opened.kinds(), OutputKind::ALL, "the flat layout is there");
        for kind in opened.kinds() {
            let [a, b] = [run, opened].map(|map| map.output(kind).unwrap());
            assert!(!a.is_empty(), "{kind:?}");
            match kind {
                // Weights that are exchanged twice may differ in the last digit.
                OutputKind::Map | OutputKind::Glb => assert!(a.len().abs_diff(b.len()) < 64, "{kind:?}"),
                OutputKind::SourceShapePly | OutputKind::TargetShapePly => {
                    let [a, b] = [a, b].map(|file| read_mesh(&file).unwrap());
                    assert_eq!(a.polygons, b.polygons, "{kind:?}");
                    assert_eq!(a.positions.len(), b.positions.len(), "{kind:?}");
                    assert!(
                        a.positions.iter().zip(&b.positions).all(|(p, q)| p.distance(*q) < 1e-9),
                        "{kind:?}"
                    );
                }
                _ => assert_same_text(&String::from_utf8(a).unwrap(), &String::from_utf8(b).unwrap(), kind),
            }
        }
        assert_eq!(mapped.map.landmarks, open.taken().map().landmarks);
        assert_eq!(serde_json::to_value(&mapped.result.report).unwrap(), open.taken().map().report);
    }
    // In this map nothing is exchanged, so the bytes are the same.
    let mapped = horse_cat();
    assert!(open(mapped).taken().output(OutputKind::Map).unwrap() == mapped.bytes);
}

#[test]
fn the_measures_of_the_pieces_are_those_of_the_run() {
    for mapped in both() {
        let open = open(mapped);
        let (found, told) = (open.taken().distortion(), &mapped.result.report.distortion);
        let numbers = |d: &conemap::pipeline::DistortionReport| {
            [d.energy, d.mean, d.mean_log, d.median, d.p95, d.max, d.dented + 1.0]
        };
        for (a, b) in numbers(&found).into_iter().zip(numbers(told)) {
            assert!((a / b - 1.0).abs() < 1e-9, "{:?} {:?}", numbers(&found), numbers(told));
        }
        assert_eq!(found.worst.len(), told.worst.len());
        for (a, b) in found.worst.iter().zip(&told.worst) {
            assert!((a.density / b.density - 1.0).abs() < 1e-9 && (a.area - b.area).abs() < 1e-12);
            assert_eq!((a.source.face, a.target.face), (b.source.face, b.target.face));
            assert!((0..3).all(|k| (a.source.barycentric[k] - b.source.barycentric[k]).abs() < 1e-9));
        }
    }
}

#[test]
fn vertices_go_where_the_run_sends_them_and_landmarks_to_their_partners() {
    for mapped in both() {
        let open = open(mapped);
        let images = open.taken().vertex_images(Direction::SourceToTarget);
        assert!(images.iter().all(Option::is_some));
        let back = open.taken().vertex_images(Direction::TargetToSource);
        assert!(back.iter().all(Option::is_some));
        let target = open.meshes()[1];
        // The meshes of the run have the landmarks as further vertices after their own.
        for (image, point) in images.iter().flatten().zip(&mapped.result.target_from_source) {
            let Some(point) = point else { panic!("every vertex has an image") };
            let face = point.face;
            if (face.index()) < target.mesh().face_count()
                && mapped.map.landmarks.pairs.iter().all(|p| matches!(p[1], LandmarkPoint::Vertex(_)))
            {
                let there = target.in_file(point.position(target.mesh()));
                assert!(there.distance(image.position) < 1e-9, "{there} {}", image.position);
            }
        }
        let on_file = |side: usize, point: LandmarkPoint| {
            let mesh = open.meshes()[side];
            let point = match point {
                LandmarkPoint::Vertex(v) => {
                    let v = mesh.checked().vertex_from_file[v as usize].unwrap();
                    mesh.on_file(SurfacePoint::at_vertex(mesh.mesh(), v))
                }
                LandmarkPoint::OnFace { face, barycentric } => {
                    SurfacePoint { face: FaceId(face), barycentric }
                }
            };
            (point, mesh.in_file(mesh.on_mesh(point).position(mesh.mesh())))
        };
        for &[source, target] in &mapped.map.landmarks.pairs {
            let [here, there] = [on_file(0, source), on_file(1, target)];
            let image = open.taken().images(Direction::SourceToTarget, &[here.0])[0];
            assert!(image.position.distance(there.1) < 1e-9, "{} {}", image.position, there.1);
            let back = open.taken().images(Direction::TargetToSource, &[there.0])[0];
            assert!(back.position.distance(here.1) < 1e-9, "{} {}", back.position, here.1);
        }
    }
}

#[test]
fn every_point_has_an_image_and_comes_back() {
    for mapped in both() {
        let open = open(mapped);
        let mut random = SplitMix::new(11);
        for direction in [Direction::SourceToTarget, Direction::TargetToSource] {
            let back = match direction {
                Direction::SourceToTarget => Direction::TargetToSource,
                Direction::TargetToSource => Direction::SourceToTarget,
            };
            let mesh = open.meshes()[direction.side()];
            let size = mesh.mesh().area().sqrt();
            let faces = mesh.mesh().face_count();
            let mut points = Vec::new();
            for k in 0..2000_usize {
                let face = FaceId::from((random.unit() * faces as f64) as usize);
                let (a, b) = (random.unit(), random.unit());
                // The points lie inside faces, on edges and at vertices.
                let weights = match k % 4 {
                    0 | 1 => [a, b, 1.0],
                    2 => [a, 0.0, 1.0],
                    _ => [0.0, 1.0, 0.0],
                };
                points.push(SurfacePoint::clamped(face, weights));
            }
            let images = open.taken().images(direction, &points);
            let there: Vec<SurfacePoint> = images.iter().map(|image| image.point).collect();
            for (point, again) in points.iter().zip(open.taken().images(back, &there)) {
                let here = mesh.in_file(mesh.on_mesh(*point).position(mesh.mesh()));
                let error = here.distance(again.position) / size;
                assert!(error < 1e-9, "{point:?} comes back {error:.1e} away");
            }
        }
    }
}

/// The two sides of a chart from its first corner, in its plane; the whole layout has area 1.
fn chart_vectors(layout: &FlatLayout, chart: FaceId) -> glam::DMat2 {
    let [a, b, c] = chart.halfedges().map(|h| layout.lengths[h]);
    let x = (a * a + c * c - b * b) / (2.0 * a);
    glam::DMat2::from_cols(glam::DVec2::new(a, 0.0), glam::DVec2::new(x, (c * c - x * x).max(0.0).sqrt()))
}

/// On the flat layout a point and its image have the same coordinates.
#[test]
fn both_meshes_lie_alike_on_the_flat_layout() {
    for mapped in both() {
        let open = open(mapped);
        let map = open.taken().map();
        let layout = map.layout.as_ref().unwrap();
        let surfaces = open.taken().surfaces();
        // The polygons of each mesh cover every chart once.
        for drawing in &layout.drawings {
            let mut covered = vec![0.0; layout.base.mesh.face_count()];
            for polygon in &drawing.polygons {
                let corner = |&v: &u32| {
                    let [_, x, y] = drawing.vertices[v as usize].weights;
                    glam::DVec2::new(x, y)
                };
                let ring: Vec<_> = drawing.corners[polygon.corners.clone()].iter().map(corner).collect();
                let area: f64 = ring.windows(2).map(|w| (w[0] - ring[0]).perp_dot(w[1] - ring[0])).sum();
                assert!(area > -1e-9, "{polygon:?} {area}");
                covered[polygon.chart.index()] += area;
            }
            for (chart, share) in covered.iter().enumerate() {
                assert!((share - 1.0).abs() < 1e-6, "chart {chart}: {share}");
            }
        }
        // For a source vertex, the polygon of the target that holds its image gives the same weights.
        let locator = conemap::surface_map::correspondence::PointLocator::new(surfaces, &map.correspondence);
        let target = &layout.drawings[1];
        let mut asked = 0;
        for polygon in &layout.drawings[0].polygons {
            let v = layout.drawings[0].corners[polygon.corners.start];
            let vertex = layout.drawings[0].vertices[v as usize];
            let image = locator.image(vertex.place.surface_point(surfaces[0]));
            let q = glam::DVec2::new(image.barycentric[1], image.barycentric[2]);
            let same = target.polygons.iter().filter(|p| p.face == image.face && p.chart == polygon.chart);
            let errors = same.filter_map(|p| {
                let corners: Vec<_> = target.corners[p.corners.clone()]
                    .iter()
                    .map(|&v| target.vertices[v as usize])
                    .filter_map(|v| Some((v.place.weights_in(surfaces[1], p.face)?, v.weights)))
                    .collect();
                let at = |k: usize| glam::DVec2::new(corners[k].0[1], corners[k].0[2]);
                let flat = |k: usize| glam::DVec2::new(corners[k].1[1], corners[k].1[2]);
                let last = (2..corners.len()).max_by(|&i, &j| {
                    let area = |k: usize| (at(1) - at(0)).perp_dot(at(k) - at(0));
                    area(i).total_cmp(&area(j))
                })?;
                let from = glam::DMat2::from_cols(at(1) - at(0), at(last) - at(0));
                let onto = glam::DMat2::from_cols(flat(1) - flat(0), flat(last) - flat(0));
                // Slivers are left out, and so are polygons beside the image, which belong to other parts of a face that was refined.
                let holds = (0..corners.len()).all(|k| {
                    let (a, b) = (at(k), at((k + 1) % corners.len()));
                    (b - a).perp_dot(q - a) >= -1e-9
                });
                if from.determinant() < 1e-3 || !holds {
                    return None;
                }
                let found = flat(0) + onto * from.inverse() * (q - at(0));
                // The difference is measured in the plane, since weights in a thin chart are less exact.
                let off = found - glam::DVec2::new(vertex.weights[1], vertex.weights[2]);
                Some((chart_vectors(layout, p.chart) * off).length())
            });
            if let Some(error) = errors.min_by(f64::total_cmp) {
                assert!(error < 1e-6, "{vertex:?} {error}");
                asked += 1;
            }
        }
        assert!(asked > layout.drawings[0].polygons.len() / 2, "{asked}");
    }
}

#[test]
fn shapes_are_meshes_of_the_other_one() {
    for mapped in both() {
        let open = open(mapped);
        let [source, target] = mapped.files.each_ref().map(|bytes| read_mesh(bytes).unwrap());
        let volume = |soup: &conemap::mesh::soup::PolygonSoup| -> f64 {
            let at = |v: u32| soup.positions[v as usize];
            let fans = soup.polygons.iter().flat_map(|p| (2..p.len()).map(move |k| [p[0], p[k - 1], p[k]]));
            fans.map(|t| at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6.0).sum()
        };
        for (kind, own, other) in [
            (OutputKind::SourceShapeObj, &source, &target),
            (OutputKind::SourceShapePly, &source, &target),
            (OutputKind::TargetShapeObj, &target, &source),
            (OutputKind::TargetShapePly, &target, &source),
        ] {
            let soup = read_mesh(&open.taken().output(kind).unwrap()).unwrap();
            assert_eq!(
                (soup.positions.len(), soup.polygons.len()),
                (own.positions.len(), own.polygons.len())
            );
            // Without mirroring the polygons are those of the file.
            if !open.meshes()[1].is_mirrored() {
                assert_eq!(soup.polygons, own.polygons);
            }
            let ratio = volume(&soup) / volume(other);
            assert!((ratio - 1.0).abs() < 0.1, "{kind:?}: {ratio}");
        }
    }
}

#[test]
fn the_flat_layout_is_cut_into_whole_meshes() {
    let open = open(horse_cat());
    for (kind, side) in [(OutputKind::LayoutSourceObj, 0), (OutputKind::LayoutTargetObj, 1)] {
        let bytes = open.taken().output(kind).unwrap();
        let soup = read_mesh(&bytes).unwrap();
        let area: f64 = soup
            .polygons
            .iter()
            .flat_map(|p| (2..p.len()).map(move |k| [p[0], p[k - 1], p[k]]))
            .map(|t| {
                let [a, b, c] = t.map(|v| soup.positions[v as usize]);
                0.5 * (b - a).cross(c - a).length()
            })
            .sum();
        let whole = open.taken().surfaces()[side].area();
        assert!((area / whole - 1.0).abs() < 1e-9, "{area} {whole}");
        let text = String::from_utf8(bytes).unwrap();
        let uvs = text.lines().filter_map(|line| line.strip_prefix("vt "));
        for number in uvs.flat_map(str::split_whitespace) {
            assert!((0.0..=1.0).contains(&number.parse::<f64>().unwrap()), "{number}");
        }
    }
    let svg = String::from_utf8(open.taken().output(OutputKind::LayoutSvg).unwrap()).unwrap();
    for group in ["base-faces", "source-edges", "target-edges", "landmarks"] {
        assert!(svg.contains(&format!("<g id=\"{group}\"")), "{group}");
    }
    assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"));
}

#[cfg(feature = "cli")]
#[test]
fn the_command_line_saves_asks_measures_and_exports() {
    use crate::command_line::{conemap, errors, folder, json};
    let folder = folder("the_command_line_saves_asks_measures_and_exports");
    let demo = demo::build("sphere-tetrahedron").unwrap();
    let [source, target, pairs, map, report] =
        ["source.obj", "target.obj", "pairs.json", "saved/map.conemap", "report.json"]
            .map(|n| folder.join(n));
    std::fs::write(&source, export::obj::mesh(&demo.source)).unwrap();
    std::fs::write(&target, export::obj::mesh(&demo.target)).unwrap();
    let file = LandmarkFile {
        pairs: demo.landmarks.iter().map(|pair| pair.map(LandmarkPoint::Vertex)).collect(),
        ..LandmarkFile::default()
    };
    std::fs::write(&pairs, landmark_file::write(&file)).unwrap();
    let run = |words: &[&dyn AsRef<std::ffi::OsStr>]| conemap(words.iter().map(|word| word.as_ref()));
    let output =
        run(&[&"map", &source, &target, &"--landmarks", &pairs, &"--map", &map, &"--report", &report]);
    assert!(output.status.success(), "{}", errors(&output));

    let measured = folder.join("measured.json");
    let output = run(&[&"report", &map, &source, &target, &"--out", &measured]);
    assert!(output.status.success(), "{}", errors(&output));
    let energy = |path| json(path)["distortion"]["energy"].as_f64().unwrap();
    assert!((energy(&measured) / energy(&report) - 1.0).abs() < 1e-9);

    let output = run(&[&"query", &map, &source, &target, &"--vertices", &"--inverse"]);
    assert!(output.status.success(), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("target_vertex,source_face,b0,b1,b2,x,y,z\n"), "{text}");
    assert_eq!(text.lines().count(), 1 + demo.target.vertex_count());

    let [points, images] = ["points.csv", "images.csv"].map(|n| folder.join(n));
    let [s, t] = demo.landmarks[0];
    std::fs::write(&points, format!("face,b0,b1,b2\n{s}  # a landmark\n0,0.2,0.3,0.5\n")).unwrap();
    let ask = || run(&[&"query", &map, &source, &target, &"--points", &points, &"--out", &images]);
    assert!(ask().status.success(), "{}", errors(&ask()));
    let text = std::fs::read_to_string(&images).unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 2);
    let there = demo.target.positions()[conemap::mesh::VertexId(t)];
    assert!(there.distance(glam::DVec3::new(rows[0][5], rows[0][6], rows[0][7])) < 1e-9);
    for (content, sentence) in [
        ("0,0.2,0.3\n", "line 1: expected `face,b0,b1,b2` or `vertex`"),
        (
            "f0,0.2,0.3,0.5\n5\n",
            "points.csv, line 1: expected `face,b0,b1,b2` or `vertex`, found \"f0,0.2,0.3,0.5\"",
        ),
        ("5\n999999,1,0,0\n", "line 2: there is no face 999999"),
        ("0,1,1,1\n", "negative or do not sum to 1"),
        ("99999999\n", "there is no vertex 99999999"),
    ] {
        std::fs::write(&points, content).unwrap();
        let output = ask();
        assert_eq!(output.status.code(), Some(1));
        assert!(errors(&output).contains(sentence), "{}", errors(&output));
    }

    let out = folder.join("out");
    let output = run(&[&"export", &map, &source, &target, &"--out", &out]);
    assert!(output.status.success(), "{}", errors(&output));
    for kind in OutputKind::ALL {
        assert!(out.join(kind.file_name()).exists(), "{kind:?}");
    }
    assert_eq!(std::fs::read(out.join("map.conemap")).unwrap(), std::fs::read(&map).unwrap());

    let output = run(&[&"report", &map, &target, &target]);
    assert_eq!(output.status.code(), Some(1));
    let sentence = errors(&output);
    assert!(
        sentence.contains("target.obj: this is not the source that the map file was made with"),
        "{sentence}"
    );
    let output = run(&[&"report", &source, &source, &target]);
    assert!(errors(&output).contains("source.obj: this is not a map file"), "{}", errors(&output));
}

//! Tests of the command line: exit codes, reports, output files, and sentences for bad input.

use crate::command_line::{a_failed_flow_reports, conemap, cones, errors, folder, json, map_and_check};
use crate::common;
use crate::fixtures;
use crate::quads::obj_with_quads;
use conemap::export;
use conemap::io::{self, landmark_file};
use conemap::mesh::check::closed_genus_zero;
use conemap::mesh::generators::{icosphere, midpoint_subdivision, octahedron, torus};
use conemap::mesh::mirror::mirrored;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use glam::DVec3;
use serde_json::Value;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A subdivided octahedron on the unit sphere.
fn octasphere() -> SurfaceMesh {
    let fine = midpoint_subdivision(&midpoint_subdivision(&midpoint_subdivision(&octahedron())));
    let on_sphere = fine.positions().iter().map(|p| p.normalize()).collect();
    fine.with_positions(on_sphere)
}

/// An icosphere stretched along an axis.
fn egg() -> SurfaceMesh {
    let sphere = icosphere(2);
    let stretched = sphere.positions().iter().map(|p| *p * DVec3::new(1.0, 1.3, 0.9)).collect();
    sphere.with_positions(stretched)
}

/// The vertex farthest along each half-axis.
fn extreme_vertices(mesh: &SurfaceMesh) -> Vec<VertexId> {
    let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let along = |axis: DVec3, v: VertexId| mesh.positions()[v].dot(axis);
    axes.iter()
        .map(|&axis| mesh.vertices().max_by(|&v, &w| along(axis, v).total_cmp(&along(axis, w))).unwrap())
        .collect()
}

/// Writes two round bodies and their landmarks.
fn write_bodies(folder: &Path) -> [PathBuf; 3] {
    let (a, b) = (octasphere(), egg());
    let ends = extreme_vertices(&a).into_iter().zip(extreme_vertices(&b));
    let landmarks: Vec<_> = ends.map(|(s, t)| [s.0, t.0]).collect();
    write_files(folder, [&a, &b], &landmarks)
}

fn write_files(folder: &Path, meshes: [&SurfaceMesh; 2], landmarks: &[[u32; 2]]) -> [PathBuf; 3] {
    let [source, target, pairs] = ["source.obj", "target.obj", "pairs.json"].map(|name| folder.join(name));
    std::fs::write(&source, export::obj::mesh(meshes[0])).unwrap();
    std::fs::write(&target, export::obj::mesh(meshes[1])).unwrap();
    let file = landmark_file::LandmarkFile {
        pairs: landmarks.iter().map(|pair| pair.map(landmark_file::LandmarkPoint::Vertex)).collect(),
        ..Default::default()
    };
    std::fs::write(&pairs, landmark_file::write(&file)).unwrap();
    [source, target, pairs]
}

#[test]
fn a_mirrored_target_is_named_and_maps_as_the_target_itself() {
    let folder = folder("a_mirrored_target_is_named_and_maps_as_the_target_itself");
    let demo = conemap::demo::build("horse-cat").unwrap();
    let image = mirrored(&demo.target).unwrap();
    std::fs::create_dir_all(folder.join("mirrored")).unwrap();
    let given = write_files(&folder, [&demo.source, &demo.target], &demo.landmarks);
    let turned = write_files(&folder.join("mirrored"), [&demo.source, &image], &demo.landmarks);
    let map = |[source, target, pairs]: &[PathBuf; 3], flags: &[&str]| {
        let files = [OsStr::new("--landmarks"), pairs.as_os_str(), source.as_os_str(), target.as_os_str()];
        let out = source.parent().unwrap().join("out");
        let flags: Vec<_> = flags.iter().map(OsStr::new).collect();
        let output = conemap(
            [&[OsStr::new("map"), OsStr::new("--out"), out.as_os_str()], &files[..], &flags].concat(),
        );
        (errors(&output), std::fs::read_to_string(out.join("vertex-images.csv")).unwrap_or_default())
    };
    // The test is only that the doubt is reported before the map is made, whatever the map is.
    let (doubt, _) = map(&turned, &["--method=thesis"]);
    assert!(doubt.contains("mirrored") && doubt.contains("--mirror-target"), "{doubt}");

    let (said, images) = map(&turned, &["--mirror-target"]);
    assert!(said.contains("certified bijective") && !said.contains("landmarks: "), "{said}");
    let (_, expected) = map(&given, &[]);
    let corners_exchanged = |line: &str| {
        let fields: Vec<_> = line.split(',').collect();
        [fields[0], fields[1], fields[2], fields[4], fields[3]].join(",")
    };
    let position =
        |line: &str| -> Vec<f64> { line.split(',').skip(5).map(|number| number.parse().unwrap()).collect() };
    assert_eq!(images.lines().count(), expected.lines().count());
    for (line, expected) in images.lines().zip(expected.lines()).skip(1) {
        assert_eq!(line.split(',').take(5).collect::<Vec<_>>().join(","), corners_exchanged(expected));
        let [found, [x, y, z]] = [position(line).try_into().unwrap(), position(expected).try_into().unwrap()];
        assert_eq!(found, [-x, y, z], "the image is where the given target is");
    }
}

#[test]
fn maps_two_round_bodies() {
    let folder = folder("maps_two_round_bodies");
    let files = write_bodies(&folder);
    map_and_check(files.each_ref().map(PathBuf::as_path), &folder);
}

/// The OBJ file with a vertex in front that no face uses, and on demand with its faces turned inside out.
fn with_an_unused_vertex(obj: &str, inside_out: bool) -> String {
    let face = |words: &str| {
        let mut corners: Vec<usize> = words.split(' ').map(|n| n.parse::<usize>().unwrap() + 1).collect();
        if inside_out {
            corners.swap(1, 2);
        }
        format!("f {} {} {}", corners[0], corners[1], corners[2])
    };
    let line = |line: &str| line.strip_prefix("f ").map_or_else(|| line.to_owned(), face);
    format!("v 9 9 9\n{}\n", obj.lines().map(line).collect::<Vec<_>>().join("\n"))
}

/// The fields of every line but the first.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn landmarks_and_tables_speak_of_the_files_vertices_and_corners() {
    let folder = folder("landmarks_and_tables_speak_of_the_files_vertices_and_corners");
    let [source, target, pairs] = write_bodies(&folder);
    let other = folder.join("other");
    std::fs::create_dir_all(&other).unwrap();
    let mut file = landmark_file::read(&std::fs::read(&pairs).unwrap()).unwrap();
    let on_face = |barycentric| landmark_file::LandmarkPoint::OnFace { face: 7, barycentric };
    file.pairs.push([on_face([0.5, 0.375, 0.125]); 2]);
    std::fs::write(&pairs, landmark_file::write(&file)).unwrap();
    for [a, b] in &mut file.pairs {
        for point in [a, b] {
            if let landmark_file::LandmarkPoint::Vertex(v) = point {
                *v += 1;
            }
        }
    }
    // The target's faces are turned when the file is read, so the weights belong to other corners.
    file.pairs.last_mut().unwrap()[1] = on_face([0.5, 0.125, 0.375]);
    let [other_source, other_target, other_pairs] =
        ["source.obj", "target.obj", "pairs.json"].map(|name| other.join(name));
    let text = |path: &Path| std::fs::read_to_string(path).unwrap();
    std::fs::write(&other_source, with_an_unused_vertex(&text(&source), false)).unwrap();
    std::fs::write(&other_target, with_an_unused_vertex(&text(&target), true)).unwrap();
    std::fs::write(&other_pairs, landmark_file::write(&file)).unwrap();
    for [source, target, pairs] in [[&source, &target, &pairs], [&other_source, &other_target, &other_pairs]]
    {
        let out = source.parent().unwrap().join("out");
        let files = [source, target, pairs, &out].map(|path| path.as_os_str());
        let [landmarks, out] = ["--landmarks", "--out"].map(OsStr::new);
        let output = conemap([OsStr::new("map"), files[0], files[1], landmarks, files[2], out, files[3]]);
        assert!(output.status.success(), "{}", errors(&output));
    }

    let (plain, moved) = (folder.join("out"), other.join("out"));
    let mut expected = rows(&plain.join("vertex-images.csv"));
    assert_eq!(expected.len(), octasphere().vertex_count());
    for (v, row) in expected.iter_mut().enumerate() {
        row[0] = (v + 1).to_string();
        row.swap(3, 4);
    }
    expected.insert(0, ["0", "", "", "", "", "", "", ""].map(str::to_owned).to_vec());
    assert_same_images(&rows(&moved.join("vertex-images.csv")), &expected);

    let mut expected = rows(&plain.join("vertex-distortion.csv"));
    expected.iter_mut().enumerate().for_each(|(v, row)| row[0] = (v + 1).to_string());
    expected.insert(0, vec!["0".to_owned(), String::new()]);
    assert_eq!(rows(&moved.join("vertex-distortion.csv")), expected);
}

/// Checks that images are the same to the digit, and positions up to the order in which the corners of a face are added.
fn assert_same_images(found: &[Vec<String>], expected: &[Vec<String>]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found[..5], expected[..5]);
        for (a, b) in found[5..].iter().zip(&expected[5..]) {
            let near = a == b || (a.parse::<f64>().unwrap() - b.parse::<f64>().unwrap()).abs() < 1e-14;
            assert!(near, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn every_corner_of_an_stl_file_has_its_row() {
    let folder = folder("every_corner_of_an_stl_file_has_its_row");
    let [source, target, pairs] = write_bodies(&folder);
    let mesh = octasphere();
    let stl = folder.join("source.stl");
    let facet = |f| {
        let corners = mesh.corners(f).map(|p| format!("vertex {} {} {}\n", p.x, p.y, p.z)).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    std::fs::write(&stl, format!("solid a\n{}endsolid a\n", mesh.faces().map(facet).collect::<String>()))
        .unwrap();
    // Every landmark is given by the last corner at its place.
    let corners: Vec<VertexId> = mesh.triangles().iter().flatten().copied().collect();
    let mut file = landmark_file::read(&std::fs::read(&pairs).unwrap()).unwrap();
    for [point, _] in &mut file.pairs {
        if let landmark_file::LandmarkPoint::Vertex(v) = point {
            *v = corners.iter().rposition(|w| w.0 == *v).unwrap() as u32;
        }
    }
    let by_corner = folder.join("corners.json");
    std::fs::write(&by_corner, landmark_file::write(&file)).unwrap();
    for (source, pairs, out) in [(&source, &pairs, "out"), (&stl, &by_corner, "out-stl")] {
        let out = folder.join(out);
        let [landmarks, to] = ["--landmarks", "--out"].map(OsStr::new);
        let files = [source, &target, pairs, &out].map(|path| path.as_os_str());
        let output = conemap([OsStr::new("map"), files[0], files[1], landmarks, files[2], to, files[3]]);
        assert!(output.status.success(), "{}", errors(&output));
    }
    let by_vertex = rows(&folder.join("out/vertex-distortion.csv"));
    let by_corner = rows(&folder.join("out-stl/vertex-distortion.csv"));
    assert_eq!(by_corner.len(), corners.len());
    for (row, vertex) in by_corner.iter().zip(&corners) {
        let [there, here] = [&by_vertex[vertex.index()][1], &row[1]].map(|x| x.parse::<f64>().unwrap());
        assert!((there - here).abs() < 0.02, "{there} {here}");
    }
}

/// Two demos that are mapped quickly, one of animals and one of bodies without limbs.
const QUICK_DEMOS: [&str; 2] = ["horse-cat", "sphere-tetrahedron"];

/// Maps demos by the command line.
fn map_demos(ids: &[&str]) {
    for id in ids {
        let folder = folder(&format!("map_demos/{id}"));
        let demo = conemap::demo::build(id).unwrap();
        let files = write_files(&folder, [&demo.source, &demo.target], &demo.landmarks);
        map_and_check(files.each_ref().map(PathBuf::as_path), &folder);
    }
}

#[test]
fn maps_small_demos() {
    map_demos(&QUICK_DEMOS);
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn maps_the_other_demos() {
    let others = conemap::demo::list().iter().map(|info| info.id).filter(|id| !QUICK_DEMOS.contains(id));
    map_demos(&others.collect::<Vec<_>>());
}

#[test]
fn meshes_whose_map_may_take_more_than_the_memory_limit_are_refused_before_the_run() {
    let folder = folder("memory_limit");
    let [source, target, pairs] = write_bodies(&folder);
    let map = |mib: &str| {
        let flags = ["map", "--memory-limit", mib, "--landmarks"].map(OsStr::new);
        conemap([&flags[..], &[&pairs, &source, &target].map(|path| path.as_os_str())].concat())
    };
    let refused = map("100");
    assert!(!refused.status.success());
    let faces = [octasphere().face_count(), egg().face_count()];
    let sentence =
        format!("a map of meshes with {} and {} triangles may take 109 MiB of memory", faces[0], faces[1]);
    assert!(errors(&refused).contains(&sentence), "{}", errors(&refused));
    let mapped = map("109");
    assert!(mapped.status.success(), "{}", errors(&mapped));
}

#[test]
fn files_that_are_too_large_are_refused_unread() {
    let file = folder("too_large").join("mesh.obj");
    // The file has a length, and no contents on the disk.
    std::fs::File::create(&file).unwrap().set_len(io::MAX_BYTES as u64 + 1).unwrap();
    let refused = conemap([OsStr::new("check"), file.as_os_str()]);
    assert!(!refused.status.success());
    let sentence =
        format!("mesh.obj: it has more than {} bytes, the most that a file may have", io::MAX_BYTES);
    assert!(errors(&refused).contains(&sentence), "{}", errors(&refused));
}

/// Runs `map` on a demo with a time limit in seconds, and returns the report.
fn mapped_within(seconds: &str) -> Value {
    let folder = folder(&format!("mapped_within/{seconds}"));
    let demo = conemap::demo::build("horse-cat").unwrap();
    let [source, target, pairs] = write_files(&folder, [&demo.source, &demo.target], &demo.landmarks);
    let report = folder.join("report.json");
    let flags = ["map", "--time-limit", seconds, "--landmarks"].map(OsStr::new);
    let files = [&pairs, &source, &target].map(|path| path.as_os_str());
    let output = conemap([&flags[..], &files[..], &[OsStr::new("--report"), report.as_os_str()]].concat());
    assert!(output.status.success(), "{}", errors(&output));
    assert!(errors(&output).contains("certified bijective: 0 of "), "{}", errors(&output));
    let report = json(&report);
    let early = report["stopped_early"].as_bool().unwrap();
    assert_eq!(errors(&output).contains("warning: Finished early on request, at energy "), early);
    report
}

#[test]
fn a_limit_of_time_gives_a_certified_map_sooner() {
    let (short, long) = (mapped_within("0"), mapped_within("1000"));
    assert_eq!([&short["stopped_early"], &long["stopped_early"]], [&Value::Bool(true), &Value::Bool(false)]);
    let number = |report: &Value, path: &str| report.pointer(path).and_then(Value::as_f64).unwrap();
    assert!(number(&short, "/distortion/energy") > number(&long, "/distortion/energy"));
    assert!(number(&short, "/seconds/total") < 0.7 * number(&long, "/seconds/total"));
    assert_eq!(short["layout"]["judged"], 1, "{short}");
}

/// Ctrl-C during the relaxation of the map gives a whole result.
#[cfg(unix)]
#[test]
fn an_interrupt_finishes_with_a_certified_map() {
    use std::io::{BufRead, BufReader};
    let folder = folder("an_interrupt_finishes_with_a_certified_map");
    let demo = conemap::demo::build("horse-cat").unwrap();
    let [source, target, pairs] = write_files(&folder, [&demo.source, &demo.target], &demo.landmarks);
    let mut child = Command::new(env!("CARGO_BIN_EXE_conemap"))
        .arg("map")
        .args([&source, &target])
        .args([OsStr::new("--landmarks"), pairs.as_os_str()])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    // The stage before the search for the layout has been printed, so the program listens to Ctrl-C now.
    let mut said =
        vec![lines.find(|line| line.starts_with("findings")).expect("the stage before the search")];
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    said.extend(lines);
    assert!(child.wait().unwrap().success(), "{said:?}");
    for words in
        ["finishing with the best map so far", "certified bijective: 0 of ", "Finished early on request"]
    {
        assert!(said.iter().any(|line| line.contains(words)), "{words}: {said:?}");
    }
}

#[test]
fn writes_demos_that_can_be_mapped() {
    let folder = folder("writes_demos_that_can_be_mapped");
    let listed = String::from_utf8(conemap(["demo"]).stdout).unwrap();
    let ids: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(ids, conemap::demo::list().iter().map(|info| info.id).collect::<Vec<_>>());
    let id = "sphere-tetrahedron";
    assert!(
        conemap([OsStr::new("demo"), OsStr::new(id), OsStr::new("--out"), folder.as_os_str()])
            .status
            .success()
    );
    let built = conemap::demo::build(id).unwrap();
    let file = landmark_file::read(&std::fs::read(folder.join(format!("{id}.json"))).unwrap()).unwrap();
    for (mesh, side, name) in [(&built.source, 0, file.source), (&built.target, 1, file.target)] {
        let soup = io::read_mesh(&std::fs::read(folder.join(name.unwrap())).unwrap()).unwrap();
        let read = closed_genus_zero(&soup).unwrap().mesh;
        assert_eq!(read.triangles(), mesh.triangles());
        for (pair, known) in file.pairs.iter().zip(&built.landmarks) {
            assert_eq!(pair[side], landmark_file::LandmarkPoint::Vertex(known[side]));
        }
    }
    assert!(!folder.join(format!("{id}-truth.csv")).exists());
    assert!(errors(&conemap(["demo", "teapot"])).contains("there is no demo “teapot”"));
}

#[test]
fn the_report_tells_how_far_a_map_is_from_the_known_one() {
    let folder = folder("the_report_tells_how_far_a_map_is_from_the_known_one");
    // The target is the bent source: each vertex goes to the vertex with its number.
    let mesh = octasphere();
    let image = fixtures::bent(&mesh);
    let landmarks: Vec<_> = extreme_vertices(&mesh).into_iter().map(|v| [v.0; 2]).collect();
    let [source, target, pairs] = write_files(&folder, [&mesh, &image], &landmarks);
    let rows = image.positions().iter_enumerated().map(|(v, p)| format!("{},{},{},{}\n", v.0, p.x, p.y, p.z));
    let [truth, report] = ["truth.csv", "report.json"].map(|name| folder.join(name));
    std::fs::write(&truth, format!("source_vertex,x,y,z\n{}", rows.collect::<String>())).unwrap();
    let map = || {
        let files = [&source, &target].map(|path| path.as_os_str());
        let options = [("--landmarks", &pairs), ("--truth", &truth), ("--report", &report)];
        let options = options.into_iter().flat_map(|(name, path)| [OsStr::new(name), path.as_os_str()]);
        conemap([OsStr::new("map")].into_iter().chain(files).chain(options))
    };
    let mapped = map();
    assert!(mapped.status.success(), "{}", errors(&mapped));
    assert!(errors(&mapped).contains("true images: mean"), "{}", errors(&mapped));
    let told: Value = serde_json::from_slice(&std::fs::read(&report).unwrap()).unwrap();
    let mean = told["ground_truth"]["mean"].as_f64().unwrap();
    // The bend is not the map of least energy, but near it.
    assert!(0.0 < mean && mean < 0.02, "{mean}");
    std::fs::write(&truth, "source_vertex,x,y\n0,1,2\n").unwrap();
    let refused = map();
    assert!(!refused.status.success());
    assert!(errors(&refused).contains("there is no column \"z\""), "{}", errors(&refused));
}

/// The demo whose true map is known comes with a file of it, with which the program's map is compared.
#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn the_turning_horse_is_near_its_known_map() {
    let folder = folder("the_turning_horse_is_near_its_known_map");
    let id = "horse-turning";
    let written = conemap([OsStr::new("demo"), OsStr::new(id), OsStr::new("--out"), folder.as_os_str()]);
    assert!(written.status.success(), "{}", errors(&written));
    let [source, target, pairs, truth] =
        ["-source.obj", "-target.obj", ".json", "-truth.csv"].map(|end| folder.join(format!("{id}{end}")));
    let report = folder.join("report.json");
    let options = [("--landmarks", &pairs), ("--truth", &truth), ("--report", &report)];
    let options = options.into_iter().flat_map(|(name, path)| [OsStr::new(name), path.as_os_str()]);
    let meshes = [&source, &target].map(|path| path.as_os_str());
    let mapped = conemap([OsStr::new("map")].into_iter().chain(meshes).chain(options));
    assert!(mapped.status.success(), "{}", errors(&mapped));
    let mean = json(&report)["ground_truth"]["mean"].as_f64().unwrap();
    assert!(mean < 0.01, "{mean}");
}

#[test]
fn suggests_vertices_as_json() {
    let folder = folder("suggests_vertices_as_json");
    let demo = conemap::demo::build("horse-cat").unwrap();
    let [source, _, _] = write_files(&folder, [&demo.source, &demo.target], &demo.landmarks);
    let suggested = |flags: &[&str]| -> Vec<Value> {
        let flags: Vec<_> = flags.iter().map(OsStr::new).collect();
        let output = conemap([&[OsStr::new("suggest"), source.as_os_str()], &flags[..]].concat());
        assert!(output.status.success(), "{}", errors(&output));
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        json["suggestions"].as_array().unwrap().clone()
    };
    let found = suggested(&["--count", "9"]);
    assert_eq!(found.len(), 9);
    let vertex = |s: &Value| s["vertex"].as_u64().unwrap();
    assert!(found.iter().all(|s| vertex(s) < demo.source.vertex_count() as u64));
    let partnered = found.iter().filter(|s| !s["partner"].is_null()).count();
    assert!(partnered >= 4 && found[0]["reason"] == "tip", "{found:?}");
    let first = vertex(&found[0]);
    let beside = suggested(&["--beside", &first.to_string()]);
    assert!(beside.iter().all(|s| vertex(s) != first), "{beside:?}");
    assert_refused(
        &[OsStr::new("suggest"), source.as_os_str(), OsStr::new("--beside=99999999")],
        &["no vertex 99999999"],
    );
}

#[test]
fn a_map_of_straight_patches_is_certified_and_has_no_map_file() {
    let folder = folder("a_map_of_straight_patches_is_certified_and_has_no_map_file");
    let [source, target, pairs] = write_bodies(&folder);
    let report_file = folder.join("report.json");
    let flags = ["map", "--method=tutte", "--landmarks"].map(OsStr::new);
    let files = [&pairs, &source, &target].map(|path| path.as_os_str());
    let output =
        conemap([&flags[..], &files[..], &[OsStr::new("--report"), report_file.as_os_str()]].concat());
    assert!(output.status.success(), "{}", errors(&output));
    assert!(errors(&output).contains("certified bijective: 0 of"), "{}", errors(&output));
    let report = json(&report_file);
    assert_eq!((&report["certificate"]["bijective"], &report["unmapped_share"]), (&true.into(), &0.0.into()));
    let map_flags = [OsStr::new("--map"), OsStr::new("map.conemap")];
    assert_refused(&[&flags[..], &files[..], &map_flags[..]].concat(), &["--map", "no pieces"]);
}

#[test]
fn the_patchwise_map_has_no_certificate() {
    let folder = folder("the_patchwise_map_has_no_certificate");
    let [source, target, pairs] = write_bodies(&folder);
    let report_file = folder.join("report.json");
    let flags = ["map", "--method=thesis", "--base=qem", "--cones=uniform", "--landmarks"].map(OsStr::new);
    let files = [&pairs, &source, &target].map(|path| path.as_os_str());
    let report_flags = [OsStr::new("--report"), report_file.as_os_str()];
    let output = conemap([&flags[..], &files[..], &report_flags[..]].concat());
    assert!(output.status.success(), "{}", errors(&output));
    assert!(errors(&output).contains("not certified"), "{}", errors(&output));
    let report = json(&report_file);
    assert!(report["certificate"].is_null());
    assert!((0.0..1.0).contains(&report["unmapped_share"].as_f64().unwrap()));
}

#[test]
fn flows_to_the_listed_cones() {
    let folder = folder("flows_to_the_listed_cones");
    let [mesh, _, _] = write_bodies(&folder);
    let (list, report_file) = (folder.join("cones.txt"), folder.join("report.json"));
    std::fs::write(&list, cones(&extreme_vertices(&octasphere()))).unwrap();
    for scheme in ["inversive", "vertex-scaling", "fixed-triangulation"] {
        let output = conemap([
            OsStr::new("flow"),
            mesh.as_os_str(),
            OsStr::new("--cones"),
            list.as_os_str(),
            OsStr::new("--scheme"),
            OsStr::new(scheme),
            OsStr::new("--report"),
            report_file.as_os_str(),
        ]);
        assert!(output.status.success(), "{scheme}: {}", errors(&output));
        let report = json(&report_file);
        assert_eq!(report["converged"], true);
        assert!(report["cone_metric"]["max_curvature_error"].as_f64().unwrap() < 1e-8);
        assert_eq!(report["faces"], 512);
        std::fs::remove_file(&report_file).unwrap();
    }
}

#[test]
fn a_flow_that_does_not_converge_fails_and_still_reports() {
    let folder = folder("a_flow_that_does_not_converge/cat");
    let case = fixtures::rough_demo("horse-cat");
    let mesh = folder.join("cat.obj");
    std::fs::write(&mesh, export::obj::mesh(&case.target)).unwrap();
    a_failed_flow_reports(&mesh, &case.landmarks.target.raw, &folder);
}

/// Checks that the program fails with code 1 and one sentence that holds all the words.
fn assert_refused(arguments: &[&OsStr], words: &[&str]) {
    let output = conemap(arguments);
    let errors = errors(&output);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    let sentence = errors.lines().last().unwrap_or_default();
    assert!(words.iter().all(|word| sentence.contains(word)), "{words:?} in: {sentence}");
}

#[test]
fn bad_meshes_and_landmarks_are_refused_by_name() {
    let folder = folder("bad_meshes_and_landmarks_are_refused_by_name");
    let [source, target, pairs] = write_bodies(&folder);
    let sheet = folder.join("sheet.obj");
    std::fs::write(&sheet, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let [noise, far, broken, shared, corner] =
        ["noise.obj", "far.json", "broken.json", "shared.json", "corner.json"].map(|name| folder.join(name));
    std::fs::write(&noise, "this is not a mesh\n").unwrap();
    std::fs::write(&far, r#"{"pairs": [[0, 0], [1, 1], [2, 2], [3, 999999]]}"#).unwrap();
    std::fs::write(&broken, "{\"pairs\":\n [[0, 0]").unwrap();
    std::fs::write(&shared, r#"{"pairs": [[0, 0], [1, 1], [2, 2], [3, 1], [4, 4]]}"#).unwrap();
    let first = octasphere().triangles()[FaceId(0)][0].0;
    let on_corner = r#"{"face": 0, "barycentric": [1, 0, 0]}"#;
    std::fs::write(&corner, format!("{{\"pairs\": [[{first}, 0], [{on_corner}, 1], [100, 2], [101, 3]]}}"))
        .unwrap();
    let missing = folder.join("missing.obj");
    let cases: [([&Path; 3], &[&str]); 8] = [
        ([&missing, &target, &pairs], &["missing.obj"]),
        ([&source, &noise, &pairs], &["noise.obj", "not a mesh file"]),
        ([&sheet, &target, &pairs], &["sheet.obj", "open sheet"]),
        ([&source, &target, &missing], &["missing.obj"]),
        ([&source, &target, &broken], &["broken.json", "line 2"]),
        ([&source, &target, &far], &["far.json", "999999"]),
        ([&source, &target, &shared], &["shared.json", "pairs 2 and 4", "the target"]),
        ([&source, &target, &corner], &["corner.json", "pairs 1 and 2", "same vertex of the source"]),
    ];
    for ([a, b, landmarks], words) in cases {
        let flags = ["map", "--landmarks"].map(OsStr::new);
        assert_refused(&[flags[0], a.as_os_str(), b.as_os_str(), flags[1], landmarks.as_os_str()], words);
    }
}

/// Writes two round bodies with landmarks, one face missing from the source and those around a vertex from the target.
fn write_open_bodies(folder: &Path) -> [PathBuf; 3] {
    let [source, target, pairs] = write_bodies(folder);
    let text = std::fs::read_to_string(&source).unwrap();
    std::fs::write(&source, text.rsplit_once("f ").unwrap().0).unwrap();
    let text = std::fs::read_to_string(&target).unwrap();
    let hole: Vec<usize> = egg().star(VertexId(100)).map(|h| h.face().index()).collect();
    let mut face = 0;
    let stays = |line: &&str| {
        face += usize::from(line.starts_with("f "));
        !line.starts_with("f ") || !hole.contains(&(face - 1))
    };
    let lines: Vec<&str> = text.lines().filter(stays).collect();
    std::fs::write(&target, lines.join("\n")).unwrap();
    [source, target, pairs]
}

#[test]
fn open_meshes_are_capped_and_the_map_says_so() {
    let folder = folder("open_meshes_are_capped_and_the_map_says_so");
    let [source, target, pairs] = write_open_bodies(&folder);
    let (out, report) = (folder.join("out"), folder.join("report.json"));
    let map = |flags: &[&OsStr]| {
        let files = [OsStr::new("map"), source.as_os_str(), target.as_os_str(), OsStr::new("--landmarks")];
        conemap([&files[..], &[pairs.as_os_str()], flags].concat())
    };
    let strict = map(&[OsStr::new("--strict")]);
    assert_eq!(strict.status.code(), Some(1));
    assert!(errors(&strict).contains("source.obj: the surface is open: 3 edges"), "{}", errors(&strict));

    let output = map(&[OsStr::new("--out"), out.as_os_str(), OsStr::new("--report"), report.as_os_str()]);
    let said = errors(&output);
    assert!(output.status.success() && said.contains("certified bijective"), "{said}");
    assert!(said.contains("without map.conemap: a mesh was repaired"), "{said}");
    assert!(!out.join("map.conemap").exists() && out.join("vertex-images.csv").exists());
    assert!(
        said.contains("The target could not be mapped as it is and was repaired: 1 hole was capped ("),
        "{said}"
    );
    let report = json(&report);
    let of = |kind: &str, side: &str| {
        let all = report["warnings"].as_array().unwrap();
        all.iter()
            .find(|w| w["kind"] == kind && w["side"] == side)
            .unwrap_or_else(|| panic!("{all:?}"))
            .clone()
    };
    assert!(of("repaired", "source")["sentence"].as_str().unwrap().contains("1 hole was capped"));
    let share = of("capped", "target")["value"].as_f64().unwrap();
    assert!((0.01..0.05).contains(&share), "{share}");
    // Nearly all skin is mapped onto skin, and the measures are those of skin.
    let coverage = |side: &str| report["coverage"][side].as_f64().unwrap();
    for side in ["source", "target"] {
        assert!((0.9..1.0).contains(&coverage(side)), "{side}: {}", coverage(side));
    }
    let hidden = 1.0 - 0.5 * (coverage("source") + coverage("target"));
    assert!((coverage("hidden") - hidden).abs() < 1e-12);
    assert!(
        said.contains(&format!("coverage: {:.2} % of the source's skin", 100.0 * coverage("source"))),
        "{said}"
    );
    let triangles = rows(&out.join("distortion.csv"));
    let densities = |mark: &str| {
        let marked = triangles.iter().filter(|row| row[6] == mark);
        marked.map(|row| row[3].parse::<f64>().unwrap()).fold(0.0, f64::max)
    };
    assert!(densities("0") > 0.0);
    // Pieces so thin that rounding may have made them are not among the worst.
    assert!(densities("1") >= report["distortion"]["max"].as_f64().unwrap() * (1.0 - 1e-9));

    // The faces of the images are numbered as in the target's file; those of the cap follow.
    let soup = io::read_mesh(&std::fs::read(&target).unwrap()).unwrap();
    let rows = rows(&out.join("vertex-images.csv"));
    let [mut in_cap, mut on_skin] = [0, 0];
    for row in &rows {
        let [_, face, .., mark] = &row[..] else { panic!("{row:?}") };
        let is_cap = face.parse::<usize>().unwrap() >= soup.polygons.len();
        assert_eq!(mark == "1", is_cap, "{row:?}");
        *(if is_cap { &mut in_cap } else { &mut on_skin }) += 1;
    }
    assert!(in_cap > 0 && on_skin > 10 * in_cap, "{in_cap} {on_skin}");
}

#[test]
fn a_check_says_what_is_wrong_and_writes_the_repaired_mesh() {
    let folder = folder("a_check_says_what_is_wrong_and_writes_the_repaired_mesh");
    let [source, target, _] = write_open_bodies(&folder);
    let check = |flags: &[&str]| {
        let output = conemap([&["check", target.to_str().unwrap()][..], flags].concat());
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned(), errors(&output))
    };
    let (code, told, error) = check(&[]);
    assert_eq!(code, Some(1));
    assert!(error.contains("target.obj: the surface is open"), "{error}");
    assert!(told.contains("1 hole was capped (") && told.contains("edges from vertex "), "{told}");

    let fixed = folder.join("fixed.off");
    let (code, told, _) = check(&["--repair", "--out", fixed.to_str().unwrap(), "--report", "-"]);
    assert_eq!(code, Some(0));
    let report: Value = serde_json::from_str(&told).unwrap();
    assert_eq!((&report["can_be_mapped"], &report["repaired"]), (&true.into(), &true.into()));
    assert_eq!(report["fault"]["kind"], "open_edges");
    let kinds: Vec<_> = report["changes"].as_array().unwrap().iter().map(|c| c["kind"].clone()).collect();
    assert_eq!(kinds, ["capped_holes", "unused_vertices"]);
    assert_eq!(report["changes"][1]["vertices"], serde_json::json!([100]));
    // Vertex 100 is dropped, and the next ones have moved up.
    assert_eq!(report["numbers"]["vertices"][100], 101);
    let closed = closed_genus_zero(&io::read_mesh(&std::fs::read(&fixed).unwrap()).unwrap()).unwrap();
    assert_eq!(report["faces"], closed.mesh.face_count());

    let again = conemap([OsStr::new("check"), fixed.as_os_str()]);
    assert!(again.status.success());
    assert_eq!(String::from_utf8_lossy(&again.stdout), "can be mapped as it is\n");
    let [command, repair, out, stl] = ["check", "--repair", "--out", "fixed.stl"].map(OsStr::new);
    assert_refused(&[command, repair, source.as_os_str(), out, stl], &["fixed.stl", ".obj"]);
}

#[test]
fn every_command_repairs_its_meshes_and_says_so() {
    let folder = folder("every_command_repairs_its_meshes_and_says_so");
    let [source, target, pairs] = write_open_bodies(&folder);
    let list = folder.join("cones.txt");
    std::fs::write(&list, cones(&[0, 50, 120, 160].map(VertexId))).unwrap();
    let remeshed = folder.join("remeshed.off");
    let [cones, faces, out, input] = ["--cones", "--faces=400", "--out", "--in"].map(OsStr::new);
    let commands: [Vec<&OsStr>; 4] = [
        vec![OsStr::new("suggest"), target.as_os_str()],
        vec![OsStr::new("flow"), target.as_os_str(), cones, list.as_os_str()],
        vec![OsStr::new("remesh"), target.as_os_str(), faces, out, remeshed.as_os_str()],
        vec![OsStr::new("landmarks"), source.as_os_str(), target.as_os_str(), input, pairs.as_os_str()],
    ];
    for command in &commands {
        let output = conemap(command);
        let said = errors(&output);
        assert!(output.status.success(), "{said}");
        let told = "target.obj could not be used as it is and was repaired: 1 hole was capped (";
        assert!(said.contains("warning: ") && said.contains(told), "{said}");
        assert_eq!(said.contains("source.obj could not be used"), command[0] == "landmarks", "{said}");
        let strict = [&command[..], &[OsStr::new("--strict")]].concat();
        assert_refused(&strict, &[".obj: the surface is open"]);
    }
    // The suggested points are vertices of the file, and none lies in the cap.
    let output = conemap([&commands[0][..], &[OsStr::new("--count=200")]].concat());
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let found = found["suggestions"].as_array().unwrap();
    let file_vertices = egg().vertex_count() as u64;
    assert!(!found.is_empty() && found.iter().all(|s| s["vertex"].as_u64().unwrap() < file_vertices));
    let ring = folder.join("ring.obj");
    std::fs::write(&ring, export::obj::mesh(&torus(12, 8))).unwrap();
    let suggest = [OsStr::new("suggest"), ring.as_os_str()];
    assert_refused(&suggest, &["ring.obj: the surface has 1 handle", "--cut-handles"]);
    assert!(conemap([&suggest[..], &[OsStr::new("--cut-handles")]].concat()).status.success());
}

#[test]
fn small_gaps_are_told_with_the_distance_that_closes_them() {
    let folder = folder("small_gaps_are_told_with_the_distance_that_closes_them");
    let ball = icosphere(2);
    // The triangles are apart from each other, each a little smaller than its place.
    let shrunk = |f: FaceId| {
        let corners = ball.corners(f);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        corners.map(|p| p + 1e-3 * (middle - p))
    };
    let vertices: String =
        ball.faces().flat_map(shrunk).map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
    let faces: String =
        (0..ball.face_count()).map(|f| format!("f {} {} {}\n", 3 * f + 1, 3 * f + 2, 3 * f + 3)).collect();
    let loose = folder.join("loose.obj");
    std::fs::write(&loose, vertices + &faces).unwrap();
    let check = |flags: &[&str]| {
        let words = [OsStr::new("check"), loose.as_os_str(), OsStr::new("--repair")];
        conemap(words.into_iter().chain(flags.iter().map(OsStr::new)))
    };
    let output = check(&[]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let (_, rest) =
        said.split_once("960 vertices on open edges lie near others at gaps: --join-within ").unwrap();
    let distance = rest.split_whitespace().next().unwrap();
    let closed = check(&["--join-within", distance]);
    assert!(closed.status.success(), "{}", errors(&closed));
    // A distance in another unit joins all of them, and takes no time.
    let gone = check(&["--join-within", "1000"]);
    assert!(errors(&gone).contains("of every face are within 1000 of each other"), "{}", errors(&gone));
}

#[test]
fn handles_are_told_and_cut_when_that_is_asked_for() {
    let folder = folder("handles_are_told_and_cut_when_that_is_asked_for");
    let [ring, fixed] = ["ring.obj", "fixed.obj"].map(|name| folder.join(name));
    std::fs::write(&ring, export::obj::mesh(&torus(12, 8))).unwrap();
    let [check, repair, cut, out, report, dash] =
        ["check", "--repair", "--cut-handles", "--out", "--report", "-"].map(OsStr::new);
    assert_refused(
        &[check, ring.as_os_str(), repair],
        &["ring.obj: the surface has 1 handle (at vertex ", " a loop of 8 edges, ", "--cut-handles"],
    );
    let output = conemap([check, ring.as_os_str(), repair, cut, out, fixed.as_os_str(), report, dash]);
    assert!(output.status.success(), "{}", errors(&output));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let change = &report["changes"][0];
    assert_eq!((&change["kind"], &change["count"]), (&"cut_handles".into(), &1.into()));
    assert_eq!(change["handles"][0]["vertices"].as_array().map(Vec::len), Some(8));
    assert_eq!(report["cap_share"], change["area_share"]);
    let again = conemap([check, fixed.as_os_str()]);
    assert_eq!(String::from_utf8_lossy(&again.stdout), "can be mapped as it is\n");
}

fn wrap<'a>([base, scan, pairs]: [&'a Path; 3], out: &'a Path, flags: &[&'a str]) -> std::process::Output {
    let [command, landmarks, to] = ["wrap", "--landmarks", "--out"].map(OsStr::new);
    let mut arguments = vec![command, base.as_os_str(), scan.as_os_str()];
    arguments.extend([landmarks, pairs.as_os_str(), to, out.as_os_str()]);
    arguments.extend(flags.iter().map(OsStr::new));
    conemap(arguments)
}

#[test]
fn a_base_is_laid_onto_a_scan() {
    let folder = folder("a_base_is_laid_onto_a_scan");
    let [base, scan, pairs] = write_bodies(&folder);
    // The base is in Latin-1, with carriage returns as ends of lines.
    let mut text = [b"# b\xe4r\n".to_vec(), obj_with_quads(&octasphere(), |_| true)].concat();
    text.iter_mut().filter(|byte| **byte == b'\n').for_each(|byte| *byte = b'\r');
    std::fs::write(&base, &text).unwrap();
    let (out, report) = (folder.join("new/wrapped.obj"), folder.join("report.json"));
    let flags = ["--drop-normals", &format!("--report={}", report.display())];
    let output = wrap([&base, &scan, &pairs], &out, &flags);
    assert!(output.status.success(), "{}", errors(&output));
    for words in ["certified bijective", "wrapped: ", "distance to the scan: mean", "quads: largest angle"] {
        assert!(errors(&output).contains(words), "{words}: {}", errors(&output));
    }
    assert!(!errors(&output).contains("normals"), "{}", errors(&output));
    let wrapped = std::fs::read(&out).unwrap();
    let has = |word: &[u8]| wrapped.windows(word.len()).any(|part| part == word);
    assert!(wrapped.starts_with(b"# b\xe4r\r") && !has(b"vn ") && !has(b"\n") && has(b"\rusemtl skin0\r"));
    let [before, after] = [&text[..], &wrapped[..]].map(|bytes| io::read_mesh(bytes).unwrap());
    assert_eq!(before.polygons, after.polygons);
    // The vertices lie near the egg, whose own vertices are farther apart than those of the ball.
    let off = |p: &DVec3| ((*p / DVec3::new(1.0, 1.3, 0.9)).length() - 1.0).abs();
    assert!(after.positions.iter().all(|p| off(p) < 0.05));
    let report = json(&report);
    assert_eq!(report["map"]["certificate"]["bijective"], true);
    assert_eq!(report["wrap"]["flipped_triangles"], 0);
    assert!(report["wrap"]["distance"]["from_scan"]["p95"].as_f64().unwrap() < 0.01);
    assert!(report["wrap"]["quads"]["largest"].as_f64().unwrap() > 90.0);
}

#[test]
fn a_base_without_lines_to_keep_is_refused_before_the_work() {
    let folder = folder("a_base_without_lines_to_keep_is_refused_before_the_work");
    let [base, scan, pairs] = write_bodies(&folder);
    let ply = folder.join("base.ply");
    std::fs::write(&ply, export::ply::mesh(&octasphere())).unwrap();
    let refused = |base: &Path, out: &str, words: &str| {
        let output = wrap([base, &scan, &pairs], &folder.join(out), &[]);
        assert_eq!(output.status.code(), Some(1));
        assert!(errors(&output).contains(words), "{}", errors(&output));
        assert!(!folder.join(out).exists());
    };
    refused(&ply, "out.ply", "base.ply: lines can be kept of OBJ and OFF files only");
    let off = folder.join("base.off");
    std::fs::write(&off, [b"OFF BINARY\n".to_vec(), vec![0; 12]].concat()).unwrap();
    refused(&off, "out.off", "base.off: lines can be kept of text files only");
    refused(&base, "out.off", "its name must end in .obj");
}

#[test]
fn bad_cones_are_refused_by_line() {
    let folder = folder("bad_cones_are_refused_by_line");
    let [mesh, _, _] = write_bodies(&folder);
    let list = folder.join("cones.txt");
    let cases: [(&str, &[&str]); 6] = [
        ("0 NaN\n3 2.0\n", &["cones.txt, line 1", "vertex 0 has an angle defect that is not a number"]),
        ("0 1.0\n3 7\n", &["cones.txt, line 2", "vertex 3 has the angle defect 7: it must be below 2 pi"]),
        ("0 1.0\nthree 2.0\n", &["cones.txt", "line 2"]),
        ("0 1.0\n999999 2.0\n", &["cones.txt", "line 2", "999999"]),
        ("0 1.0\n3 2.0\n0 2.0\n", &["cones.txt, line 3", "vertex 0 has an angle defect on line 1"]),
        ("0 1.0\n", &["cones.txt", "4 pi"]),
    ];
    for (text, words) in cases {
        std::fs::write(&list, text).unwrap();
        let flags = ["flow", "--cones"].map(OsStr::new);
        assert_refused(&[flags[0], mesh.as_os_str(), flags[1], list.as_os_str()], words);
    }
}

#[test]
fn a_map_file_is_proved_or_refused() {
    let folder = folder("a_map_file_is_proved_or_refused");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("verify/tests/data");
    let [map, bean, ball] = ["bean-ball.conemap", "bean.off", "ball.off"].map(|name| data.join(name));
    let report = folder.join("proof.json");
    let asked = |map: &Path, source: &Path, target: &Path| {
        let words = [OsStr::new("verify"), map.as_os_str(), source.as_os_str(), target.as_os_str()];
        conemap(words.into_iter().chain([OsStr::new("--report"), report.as_os_str()]))
    };
    let output = asked(&map, &bean, &ball);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.starts_with("Proved: the map is one-to-one from the source onto the target."), "{said}");
    let proved = json(&report);
    assert_eq!((&proved["verdict"], &proved["doubtful"]["triangles"]), (&"proved".into(), &0.into()));
    assert_eq!((&proved["faces"]["source"], &proved["landmarks"]["pairs"]), (&320.into(), &7.into()));
    let words = [OsStr::new("verify"), map.as_os_str(), bean.as_os_str(), ball.as_os_str()];
    let printed = conemap(words.into_iter().chain(["--report", "-"].map(OsStr::new)));
    let printed: Value = serde_json::from_slice(&printed.stdout).unwrap();
    assert_eq!(printed["landmarks"], proved["landmarks"]);
    let output = asked(&map, &ball, &bean);
    assert_eq!(output.status.code(), Some(1));
    let sentence = errors(&output);
    assert!(
        sentence.contains("ball.off: the source is not the mesh that the map was made with"),
        "{sentence}"
    );
    assert_eq!(
        (&json(&report)["verdict"], &json(&report)["kind"]),
        (&"refused".into(), &"other-mesh".into())
    );
    let damaged = folder.join("damaged.conemap");
    let mut bytes = std::fs::read(&map).unwrap();
    let last = bytes.len() - 2000;
    bytes[last] ^= 16;
    std::fs::write(&damaged, &bytes).unwrap();
    let output = asked(&damaged, &bean, &ball);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("damaged.conemap: section"), "{}", errors(&output));
    assert_eq!(asked(&folder.join("none.conemap"), &bean, &ball).status.code(), Some(1));
}

#[test]
fn landmarks_that_nobody_gave_are_found_or_asked_for() {
    let folder = folder("landmarks_that_nobody_gave_are_found_or_asked_for");
    let demo = conemap::demo::build("horse-cat").unwrap();
    let first = &demo.landmarks[..1];
    let [source, target, given] = write_files(&folder, [&demo.source, &demo.target], first);
    let named = landmark_file::read(&std::fs::read(&given).unwrap()).unwrap();
    let named = landmark_file::LandmarkFile { target: Some("zebra.off".to_owned()), ..named };
    std::fs::write(&given, landmark_file::write(&named)).unwrap();
    let [found, told, report] = ["found.json", "told.json", "report.json"].map(|name| folder.join(name));
    let [with, out, to] = ["--landmarks", "--out", "--report"].map(OsStr::new);
    let meshes = [source.as_os_str(), target.as_os_str()];
    let [given, pairs] = [given.as_os_str(), found.as_os_str()];
    let held = [with, given, out, pairs, to, told.as_os_str()];
    let output = conemap([OsStr::new("match")].into_iter().chain(meshes).chain(held));
    assert!(output.status.success(), "{}", errors(&output));
    // The program says that the landmark file names another mesh.
    assert!(errors(&output).contains("zebra.off"), "{}", errors(&output));
    let file = landmark_file::read(&std::fs::read(&found).unwrap()).unwrap();
    assert_eq!(file.pairs[0], first[0].map(landmark_file::LandmarkPoint::Vertex));
    assert!(file.pairs.len() >= 5, "{file:?}");
    let told = json(&told);
    assert_eq!(told["candidates"][0]["pairs"].as_array().unwrap().len(), file.pairs.len(), "{told}");
    assert!(errors(&output).contains(told["verdict"]["sentence"].as_str().unwrap()), "{}", errors(&output));

    // Cones of the program's own, which so few landmarks would get, have their own tests.
    let flags = ["map", "--own-cones", "0"].map(OsStr::new);
    let output = conemap(flags.into_iter().chain(meshes).chain([to, report.as_os_str()]));
    assert!(errors(&output).contains("certified bijective"), "{}", errors(&output));
    let matching = &json(&report)["matching"];
    assert!(errors(&output).contains(matching["verdict"]["sentence"].as_str().unwrap()), "{matching}");

    // Round bodies have no limbs to match, so the user is asked to mark vertices.
    let [source, target, _] = write_bodies(&folder);
    assert_refused(&["map".as_ref(), source.as_os_str(), target.as_os_str()], &["mark the vertices"]);
}

#[test]
fn wrong_arguments_end_in_the_usage() {
    let cases: [(&[&str], &str); 6] = [
        (&["verify", "map.conemap", "source.off"], "<TARGET>"),
        (&["map", "only-one.obj"], "<TARGET>"),
        (&["remesh", "ball.obj", "--faces=100"], "--out"),
        (&["remesh", "ball.obj", "--out=new.obj"], "--faces"),
        (&["remesh", "ball.obj", "--out=new.obj", "--faces=-5"], "--faces"),
        (&["remesh", "ball.obj", "--out=new.obj", "--faces=50", "--crease-angle=200"], "from 0 to 180"),
    ];
    for (arguments, word) in cases {
        let output = conemap(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(errors(&output).contains(word), "{arguments:?}: {}", errors(&output));
    }
}

#[test]
fn remeshes_into_every_format() {
    let folder = folder("remeshes_into_every_format");
    let [source, _, _] = write_bodies(&folder);
    let read =
        |path: &Path| closed_genus_zero(&io::read_mesh(&std::fs::read(path).unwrap()).unwrap()).unwrap();
    let written: Vec<_> = ["new.obj", "deep/new.off", "new.PLY"]
        .iter()
        .map(|name| {
            let [out, report] = [folder.join(name), folder.join("report.json")];
            let flags = ["remesh", "--faces=300", "--out", "--report"].map(OsStr::new);
            let paths = [&source, &out, &report].map(|path| path.as_os_str());
            let output = conemap([flags[0], paths[0], flags[1], flags[2], paths[1], flags[3], paths[2]]);
            assert!(output.status.success(), "{}", errors(&output));
            assert!(errors(&output).contains(" faces, edges "), "{}", errors(&output));
            let report = json(&report);
            let fields = common::json_fields(&report);
            let expected = [
                "distance.from_original",
                "distance.to_original",
                "edge_length.deviation",
                "edge_length.mean",
                "faces",
                "mean_min_angle",
                "min_angle",
                "rounds",
                "seconds.remeshing",
                "seconds.total",
            ];
            assert_eq!(fields, expected);
            let mesh = read(&out).mesh;
            assert_eq!(report["faces"], mesh.face_count());
            assert!(mesh.face_count().abs_diff(300) <= 15);
            mesh
        })
        .collect();
    for mesh in &written[1..] {
        assert_eq!(mesh.positions(), written[0].positions());
        assert_eq!(mesh.triangles(), written[0].triangles());
    }
}

#[test]
fn bad_remeshing_is_refused_in_a_sentence() {
    let folder = folder("bad_remeshing_is_refused_in_a_sentence");
    let [source, _, _] = write_bodies(&folder);
    let [missing, noise] = ["missing.obj", "noise.obj"].map(|name| folder.join(name));
    std::fs::write(&noise, "this is not a mesh\n").unwrap();
    let cases: [(&Path, &str, &str, &[&str]); 7] = [
        (&source, "4000000000", "new.obj", &["source.obj", "4000000000 faces were asked for; the limit is"]),
        (&source, "3", "new.obj", &["source.obj", "3 faces are too few"]),
        (&source, "0", "new.obj", &["source.obj", "0 faces are too few"]),
        (&source, "300", "new.stl", &["new.stl", ".obj, .off, .ply"]),
        (&source, "300", "new", &["new", ".obj, .off, .ply"]),
        (&missing, "300", "new.obj", &["missing.obj"]),
        (&noise, "300", "new.obj", &["noise.obj", "not a mesh file"]),
    ];
    for (mesh, faces, name, words) in cases {
        let out = folder.join(name);
        let flags = ["remesh", "--faces", faces, "--out"].map(OsStr::new);
        assert_refused(&[flags[0], mesh.as_os_str(), flags[1], flags[2], flags[3], out.as_os_str()], words);
        assert!(!out.exists());
    }
}

/// Runs `conemap landmarks` on meshes, with the files to read and to write.
fn landmarks(meshes: [&Path; 2], input: &[&Path], output: &[&Path], flags: &[&str]) -> std::process::Output {
    let mut arguments =
        vec![OsStr::new("landmarks"), meshes[0].as_os_str(), meshes[1].as_os_str(), OsStr::new("--in")];
    arguments.extend(input.iter().map(|path| path.as_os_str()));
    if !output.is_empty() {
        arguments.push(OsStr::new("--out"));
        arguments.extend(output.iter().map(|path| path.as_os_str()));
    }
    arguments.extend(flags.iter().map(OsStr::new));
    conemap(arguments)
}

#[test]
fn landmark_files_are_converted_there_and_back() {
    let folder = folder("landmark_files_are_converted_there_and_back");
    let [source, target, pairs] = write_bodies(&folder);
    let meshes = [source.as_path(), target.as_path()];
    let mut file = landmark_file::read(&std::fs::read(&pairs).unwrap()).unwrap();
    file.pairs.push([landmark_file::LandmarkPoint::OnFace { face: 7, barycentric: [0.5, 0.375, 0.125] }; 2]);
    std::fs::write(&pairs, landmark_file::write(&file)).unwrap();
    let back = folder.join("back.json");
    for names in [&["a.csv"][..], &["a.tps"], &["a.mrk.json"], &["a.fcsv", "b.pp"], &["a.nts", "b.pts"]] {
        let files: Vec<_> = names.iter().map(|name| folder.join(name)).collect();
        let files: Vec<_> = files.iter().map(PathBuf::as_path).collect();
        for (input, output) in [(&[pairs.as_path()][..], &files[..]), (&files[..], &[back.as_path()][..])] {
            let told = landmarks(meshes, input, output, &["--json"]);
            assert!(told.status.success(), "{names:?}: {}", errors(&told));
            let value: Value = serde_json::from_slice(&told.stdout).unwrap();
            assert_eq!(value["pairs"].as_array().unwrap().len(), file.pairs.len());
            assert_eq!(value["remarks"], serde_json::json!([]));
            let off = value["pairs"][6]["distances"][1].as_f64().unwrap();
            assert!(off < 1e-12, "{names:?}: {off}");
        }
        let read = landmark_file::read(&std::fs::read(&back).unwrap()).unwrap();
        assert_eq!(read.source.as_deref(), Some("source.obj"));
        assert_eq!(read.pairs[..6], file.pairs[..6], "{names:?}");
    }
    let wrap = [folder.join("a.json"), folder.join("b.json")];
    let wrap = wrap.each_ref().map(PathBuf::as_path);
    assert!(landmarks(meshes, &[&pairs], &wrap, &["--format=wrap"]).status.success());
    let told = landmarks(meshes, &wrap, &[&back], &[]);
    assert!(told.status.success(), "{}", errors(&told));
    assert_eq!(landmark_file::read(&std::fs::read(&back).unwrap()).unwrap().pairs, file.pairs);
    assert!(
        String::from_utf8(told.stdout)
            .unwrap()
            .starts_with(" pair        source        target  label\n    1")
    );

    let soft = folder.join("soft.json");
    file.radii = Some(vec![0.05; file.pairs.len()]);
    std::fs::write(&soft, landmark_file::write(&file)).unwrap();
    for (name, is_lost) in [("soft.csv", true), ("soft-again.json", false)] {
        let told = landmarks(meshes, &[&soft], &[&folder.join(name)], &[]);
        assert!(told.status.success() && errors(&told).contains("no radii") == is_lost, "{}", errors(&told));
    }

    let says = |output: std::process::Output| {
        assert_eq!(output.status.code(), Some(1));
        errors(&output)
    };
    assert!(
        says(landmarks(meshes, &[&pairs], &[&folder.join("c.pp")], &[]))
            .contains("c.pp: a MeshLab point file holds the landmarks of one mesh")
    );
    assert!(
        says(landmarks(meshes, &[&folder.join("a.fcsv")], &[], &[]))
            .contains("a.fcsv: this file holds the landmarks of one mesh")
    );
    assert!(
        says(landmarks(meshes, &[&pairs], &[&folder.join("c.what")], &[]))
            .contains("choose a format with --format")
    );
    let moved = std::fs::read_to_string(folder.join("a.csv")).unwrap().replacen("\n,", "\n,1000", 1);
    std::fs::write(folder.join("moved.csv"), moved).unwrap();
    let sentence = says(landmarks(meshes, &[&folder.join("moved.csv")], &[], &[]));
    assert!(
        sentence.contains("moved.csv: landmark")
            && sentence.contains("units or coordinate systems may differ"),
        "{sentence}"
    );
}

#[test]
fn a_map_is_made_from_the_landmark_files_of_both_meshes() {
    let folder = folder("a_map_is_made_from_the_landmark_files_of_both_meshes");
    let [source, target, pairs] = write_bodies(&folder);
    let files = [folder.join("source.fcsv"), folder.join("target.pts")];
    let files = files.each_ref().map(PathBuf::as_path);
    assert!(landmarks([&source, &target], &[&pairs], &files, &[]).status.success());
    let images = |landmarks: &[&Path], out: &str| {
        let out = folder.join(out);
        let [map, option, to] = ["map", "--landmarks", "--out"].map(OsStr::new);
        let mut arguments = vec![map, source.as_os_str(), target.as_os_str(), option];
        arguments.extend(landmarks.iter().map(|path| path.as_os_str()));
        arguments.extend([to, out.as_os_str()]);
        let output = conemap(arguments);
        assert!(output.status.success(), "{}", errors(&output));
        std::fs::read(out.join("vertex-images.csv")).unwrap()
    };
    assert_eq!(images(&files, "from-two"), images(&[&pairs], "from-one"));
}

/// Runs `map` on files with further options.
fn map_with(files: &[PathBuf; 3], options: &[&OsStr]) -> std::process::Output {
    let [source, target, pairs] = files.each_ref().map(|path| path.as_os_str());
    let named = [OsStr::new("map"), source, target, OsStr::new("--landmarks"), pairs];
    conemap([&named[..], options].concat())
}

#[test]
fn entries_of_a_landmark_file_that_mean_nothing_are_told_and_are_no_warning() {
    let folder = folder("entries_of_a_landmark_file_that_mean_nothing_are_told_and_are_no_warning");
    let files = write_bodies(&folder);
    let [source, target, pairs] = files.each_ref().map(PathBuf::as_path);
    let known = std::fs::read_to_string(pairs).unwrap();
    std::fs::write(pairs, known.replacen('{', "{\"radius\": [0.1], \"Comment\": {\"labels\": 1},", 1))
        .unwrap();
    let sentence = "the landmark file has entries that are not known and not used: \"Comment\", \"radius\"";

    let told = landmarks([source, target], &[pairs], &[], &[]);
    assert!(told.status.success(), "{}", errors(&told));
    let text = String::from_utf8(told.stdout).unwrap();
    assert!(text.ends_with(&format!("\nwarning: {sentence}\n")), "{text}");
    let told = landmarks([source, target], &[pairs], &[], &["--json"]);
    let value: Value = serde_json::from_slice(&told.stdout).unwrap();
    assert_eq!(value["remarks"], serde_json::json!([{ "kind": "unknown_entries", "sentence": sentence }]));

    let report = folder.join("report.json");
    let output = map_with(&files, &[OsStr::new("--report"), report.as_os_str()]);
    assert!(output.status.success(), "{}", errors(&output));
    let line = format!("landmarks: {sentence}");
    assert!(errors(&output).lines().any(|said| said == line), "{}", errors(&output));
    let warnings = json(&report)["warnings"].clone();
    assert!(warnings.as_array().unwrap().iter().all(|w| w["kind"] != "landmark_file"), "{warnings}");
}

#[test]
fn what_cannot_be_written_is_found_before_the_run() {
    let folder = folder("what_cannot_be_written_is_found_before_the_run");
    let files = write_bodies(&folder);
    let before = files.each_ref().map(|path| std::fs::read(path).unwrap());
    let refused = |options: &[&Path], words: &str| {
        let options: Vec<&OsStr> = options.iter().map(|option| option.as_os_str()).collect();
        let output = map_with(&files, &options);
        let said = errors(&output);
        assert!(!output.status.success() && said.contains(words), "{options:?}: {said}");
        // No stage was begun.
        assert_eq!(said.lines().count(), 1, "{said}");
    };
    let [map, out, report] = ["--map", "--out", "--report"].map(Path::new);
    let read = "this file is read; choose another name";
    refused(&[report, &files[0]], read);
    refused(&[report, &folder.join("../what_cannot_be_written_is_found_before_the_run/pairs.json")], read);
    refused(
        &[map, &folder.join("a"), report, &folder.join("a")],
        "two results would be written to this file",
    );
    refused(
        &[out, &folder, report, &folder.join("distortion.csv")],
        "two results would be written to this file",
    );
    refused(&[report, &folder.join("a"), out, &folder.join("a")], "one would be the folder of the other");
    refused(&[report, &folder], "it cannot be written");
    refused(&[out, &files[0].join("below")], "it cannot be written");
    refused(&[map, &folder.join("a"), Path::new("--method=thesis")], "has no pieces");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&files[1], folder.join("link.json")).unwrap();
        refused(&[report, &folder.join("link.json")], read);
    }
    assert_eq!(files.each_ref().map(|path| std::fs::read(path).unwrap()), before);
    // No unfinished file was left behind.
    let names = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name());
    assert!(names.into_iter().all(|name| !name.to_string_lossy().contains("part")));
}

#[test]
fn a_result_is_written_although_nobody_listens() {
    let folder = folder("a_result_is_written_although_nobody_listens");
    let [source, target, pairs] = write_bodies(&folder);
    let landmarks = std::fs::read_to_string(&pairs).unwrap();
    let named = landmarks.replacen('{', "{\"source\": \"cow.off\", \"labels\": [\"one\"],", 1);
    std::fs::write(&pairs, named).unwrap();
    let report = folder.join("report.json");
    let mut child = Command::new(env!("CARGO_BIN_EXE_conemap"))
        .args([OsStr::new("map"), source.as_os_str(), target.as_os_str()])
        .args([OsStr::new("--landmarks"), pairs.as_os_str(), OsStr::new("--report"), report.as_os_str()])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stderr.take());
    assert!(child.wait().unwrap().success());
    let report = json(&report);
    assert_eq!(report["certificate"]["bijective"], true);
    // The report says as well that the landmark file is doubtful.
    let warnings = report["warnings"].as_array().unwrap();
    let doubts: Vec<_> = warnings.iter().filter(|w| w["kind"] == "landmark_file").collect();
    assert_eq!(doubts.len(), 2, "{warnings:?}");
    let says = |words: &str| doubts.iter().any(|w| w["sentence"].as_str().unwrap().contains(words));
    assert!(says("1 labels for 6 pairs") && says("\"cow.off\""), "{doubts:?}");
}

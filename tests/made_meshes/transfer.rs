//! Tests of `conemap transfer` on files: every kind of content there and back, and sentences for files that do not fit.

use crate::command_line::{conemap, errors, folder, json};
use conemap::export::picture::png;
use conemap::export::{obj, ply};
use conemap::io::landmark_file::{LandmarkFile, LandmarkPoint, write};
use conemap::io::picture::{self, Picture};
use conemap::io::vertex_table::{self, Column, NumberType};
use conemap::io::{curve_file, read_mesh};
use conemap::mesh::SurfaceMesh;
use conemap::mesh::generators::{icosphere, midpoint_subdivision, octahedron};
use glam::DVec3;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

fn ball() -> SurfaceMesh {
    let fine = (0..3).fold(octahedron(), |mesh, _| midpoint_subdivision(&mesh));
    fine.with_positions(fine.positions().iter().map(|p| p.normalize()).collect())
}

fn egg() -> SurfaceMesh {
    let sphere = icosphere(2);
    sphere.with_positions(sphere.positions().iter().map(|p| *p * DVec3::new(1.0, 1.3, 0.9)).collect())
}

/// The files of a ball, an egg, and a map between them.
struct Files {
    folder: PathBuf,
    source: SurfaceMesh,
    target: SurfaceMesh,
}

impl Files {
    fn new(test: &str) -> Self {
        let folder = folder(test);
        let (source, target) = (ball(), egg());
        let end = |mesh: &SurfaceMesh, axis: DVec3| {
            let along = |v: &conemap::mesh::VertexId| mesh.positions()[*v].dot(axis);
            mesh.vertices().max_by(|v, w| along(v).total_cmp(&along(w))).unwrap().0
        };
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let pair = |axis| [end(&source, axis), end(&target, axis)].map(LandmarkPoint::Vertex);
        let landmarks = LandmarkFile { pairs: axes.map(pair).to_vec(), ..LandmarkFile::default() };
        std::fs::write(folder.join("source.obj"), obj::mesh(&source)).unwrap();
        std::fs::write(folder.join("target.obj"), obj::mesh(&target)).unwrap();
        std::fs::write(folder.join("pairs.json"), write(&landmarks)).unwrap();
        let files = Self { folder, source, target };
        let [map, source, target, pairs] =
            ["map.conemap", "source.obj", "target.obj", "pairs.json"].map(|name| files.path(name));
        let words = ["map", "--landmarks"].map(OsStr::new);
        let output = conemap([
            words[0],
            source.as_os_str(),
            target.as_os_str(),
            words[1],
            pairs.as_os_str(),
            OsStr::new("--map"),
            map.as_os_str(),
        ]);
        assert!(output.status.success(), "{}", errors(&output));
        files
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Runs `transfer` and returns its text on standard error; words that begin with @ are files of the folder.
    fn transfer(&self, words: &[&str]) -> Result<String, String> {
        let files = ["map.conemap", "source.obj", "target.obj"].map(|name| self.path(name).into_os_string());
        let word = |word: &&str| match word.strip_prefix('@') {
            Some(name) => self.path(name).into_os_string(),
            None => word.into(),
        };
        let output = conemap(std::iter::once("transfer".into()).chain(files).chain(words.iter().map(word)));
        let said = errors(&output);
        if output.status.success() { Ok(said) } else { Err(said) }
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }
}

fn positions(mesh: &SurfaceMesh) -> Vec<DVec3> {
    mesh.positions().iter().copied().collect()
}

#[test]
fn attributes_go_there_and_back() {
    let files = Files::new("attributes_go_there_and_back");
    // The table on the source has a smooth function, weights that sum to 1, and a label.
    let mut table = String::from("vertex,heat,left,right,part\n");
    for (v, p) in files.source.positions().iter_enumerated() {
        let left = if p.x > 0.0 { 0.9 } else { 0.2 };
        table += &format!(
            "{},{},{left},{},{}\n",
            v.0,
            p.x * p.y + p.z,
            1.0 - left,
            if p.y > 0.0 { 4 } else { -2 }
        );
    }
    files.write("values.csv", &table);
    let kinds = ["--labels", "part", "--weights", "left,right"];
    for method in ["projection", "mean", "sample"] {
        let there =
            ["--attributes", "@values.csv", "--from", "source", "--out", "@there.csv", "--method", method];
        files.transfer(&[&there[..], &kinds].concat()).unwrap();
        let back = ["--attributes", "@there.csv", "--out", "@back.csv", "--method", method];
        files.transfer(&[&back[..], &kinds].concat()).unwrap();
        let given = vertex_table::read(table.as_bytes(), files.source.vertex_count()).unwrap();
        let found = vertex_table::read(&files.read("back.csv"), files.source.vertex_count()).unwrap();
        assert_eq!(given.rows, found.rows);
        let column = |k: usize| found.columns[k].values.iter().map(|x| x.unwrap());
        for (left, right) in column(1).zip(column(2)) {
            assert!(
                (left + right - 1.0).abs() < 1e-11 && left >= 0.0 && right >= 0.0,
                "{method}: {left} {right}"
            );
        }
        assert!(column(3).all(|label| label == 4.0 || label == -2.0));
        let tolerance = if method == "mean" { 0.15 } else { 0.05 };
        for (a, b) in given.columns[0].values.iter().zip(column(0)) {
            assert!((a.unwrap() - b).abs() < tolerance, "{method}: {a:?} {b}");
        }
    }
}

#[test]
fn properties_of_a_ply_file_keep_their_names_and_types() {
    let files = Files::new("properties_of_a_ply_file_keep_their_names_and_types");
    let column = |name: &str, number_type, value: fn(&DVec3) -> f64| Column {
        name: name.to_owned(),
        number_type,
        values: files.target.positions().iter().map(|p| Some(value(p))).collect(),
    };
    let columns = [
        column("red", NumberType::UChar, |p| if p.x > 0.0 { 255.0 } else { 0.0 }),
        column("bone", NumberType::Int, |p| if p.z > 0.0 { 11.0 } else { 3.0 }),
        column("u", NumberType::Float, |p| 0.5 + 0.25 * p.y),
    ];
    let faces: Vec<Vec<u32>> = files.target.triangles().iter().map(|t| t.map(|v| v.0).to_vec()).collect();
    files.write("coloured.ply", ply::polygons_with(&positions(&files.target), &faces, &columns));
    files.transfer(&["--attributes", "@coloured.ply", "--out", "@source.PLY"]).unwrap();
    let bytes = files.read("source.PLY");
    let soup = read_mesh(&bytes).unwrap();
    assert_eq!(soup.positions, positions(&files.source));
    let found = vertex_table::read(&bytes, files.source.vertex_count()).unwrap();
    assert!(
        found.columns.iter().zip(&columns).all(|(a, b)| (&a.name, a.number_type) == (&b.name, b.number_type))
    );
    // Whole numbers that are no colours are labels, and are not mixed.
    assert!(found.columns[1].values.iter().all(|bone| [Some(11.0), Some(3.0)].contains(bone)));
    for (p, u) in files.source.positions().iter().zip(&found.columns[2].values) {
        assert!((u.unwrap() - 0.5 - 0.325 * p.y).abs() < 0.03, "{u:?} at {p}");
    }
}

#[test]
fn frames_move_the_other_mesh() {
    let files = Files::new("frames_move_the_other_mesh");
    let motion = |p: &DVec3| DVec3::new(-p.y, p.x, p.z) * 2.0 + DVec3::new(1.0, 0.0, -3.0);
    let moved = files.target.with_positions(files.target.positions().iter().map(motion).collect());
    files.write("rest.obj", obj::mesh(&files.target));
    files.write("turned.obj", obj::mesh(&moved));
    files.transfer(&["--frames", "@rest.obj", "@turned.obj", "--out", "@frames"]).unwrap();
    let frame = |name: &str| read_mesh(&files.read(name)).unwrap();
    let [rest, turned] = ["frames/frame-000.obj", "frames/frame-001.obj"].map(frame);
    for (v, p) in positions(&files.source).iter().enumerate() {
        assert!(rest.positions[v].distance(*p) < 1e-9);
        assert!(turned.positions[v].distance(motion(p)) < 1e-9);
    }
    files.write("other.obj", obj::mesh(&files.source));
    let said = files.transfer(&["--frames", "@rest.obj", "@other.obj", "--out", "@none"]).unwrap_err();
    assert!(said.contains("other.obj: it has 258 vertices") && said.contains("162"), "{said}");
    assert!(!files.path("none").exists(), "nothing is written where a frame is no frame");
}

#[test]
fn shapes_come_with_their_figures() {
    let files = Files::new("shapes_come_with_their_figures");
    let said = files.transfer(&["--shape", "--out", "@shape"]).unwrap();
    assert!(said.contains("source in the target's shape: Hausdorff distance"), "{said}");
    let report = json(&files.path("shape/shape.json"));
    for (way, faces) in [("source_in_target_shape", 512), ("target_in_source_shape", 320)] {
        let report = &report[way];
        assert_eq!(report["faces"], faces);
        let [largest, mean] = ["largest", "mean"].map(|name| report["to_shape"][name].as_f64().unwrap());
        assert!(mean > 0.0 && mean < largest && largest <= report["hausdorff"].as_f64().unwrap());
        assert!(report["normals"]["psnr"].as_f64().unwrap() > 15.0);
    }
    let soup = read_mesh(&files.read("shape/source-in-target-shape.obj")).unwrap();
    assert_eq!(soup.polygons.len(), 512);
}

#[test]
fn the_way_to_the_target_is_an_animated_mesh() {
    let files = Files::new("the_way_to_the_target_is_an_animated_mesh");
    files.transfer(&["--morph", "--out", "@way.glb"]).unwrap();
    let bytes = files.read("way.glb");
    let soup = read_mesh(&bytes).unwrap();
    assert!(soup.polygons.len() > 512, "the map's pieces");
    let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let document: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    assert_eq!(document["animations"][0]["channels"][0]["target"]["path"], "weights");
    assert_eq!(document["meshes"][0]["primitives"][0]["targets"].as_array().unwrap().len(), 4);
    let refused = files.transfer(&["--morph", "--out", "@way.obj"]).unwrap_err();
    assert!(refused.contains("the name must end in one of .glb"), "{refused}");
}

/// An OBJ file of a mesh with texture coordinates, which `chart` gives by face, position and corner.
fn with_charts(mesh: &SurfaceMesh, chart: impl Fn(usize, DVec3, usize) -> [f64; 2]) -> String {
    let mut text = String::from_utf8(obj::mesh(mesh)).unwrap();
    text.truncate(text.find("\nf ").unwrap() + 1);
    let (mut coordinates, mut faces) = (String::new(), String::new());
    for (f, triangle) in mesh.triangles().iter_enumerated() {
        let corners = [0, 1, 2].map(|k| {
            let [u, v] = chart(f.index(), mesh.positions()[triangle[k]], k);
            coordinates += &format!("vt {u} {v}\n");
            format!("{}/{}", triangle[k].0 + 1, 3 * f.index() + k + 1)
        });
        faces += &format!("f {}\n", corners.join(" "));
    }
    text + &coordinates + &faces
}

#[test]
fn a_texture_is_baked_over_the_source_s_own_coordinates() {
    let files = Files::new("a_texture_is_baked_over_the_source_s_own_coordinates");
    // Every face has its own cell of a grid in the texture. A map file is bound to the mesh, not to the file's other lines.
    let grid = |f: usize, _: DVec3, k: usize| {
        let [column, row] = [f % 23, f / 23].map(|x| x as f64);
        let [u, v] = [[0.05, 0.05], [0.95, 0.05], [0.05, 0.95]][k];
        [(column + u) / 23.0, (row + v) / 23.0]
    };
    files.write("source.obj", with_charts(&files.source, grid));
    files.write("target.obj", with_charts(&files.target, |_, p, _| [0.5 + 0.3 * p.x, 0.5 + 0.3 * p.y]));
    // The texture is red where x is larger, and blue on the other side.
    let pixel = |k: usize| if k % 64 < 32 { [0, 0, 255, 255] } else { [255, 0, 0, 255] };
    let picture = Picture { width: 64, height: 64, pixels: (0..64 * 64).map(pixel).collect() };
    files.write("texture.png", png(&picture).unwrap());
    files
        .transfer(&["--texture", "@texture.png", "--size", "460", "--border", "2", "--out", "@baked.png"])
        .unwrap();
    let baked = picture::read(&files.read("baked.png")).unwrap();
    assert_eq!((baked.width, baked.height), (460, 460));
    for f in files.source.faces() {
        let middle = files.source.corners(f).iter().sum::<DVec3>() / 3.0;
        // The texel lies in the middle of the face's chart.
        let [column, row] = [f.index() % 23, f.index() / 23].map(|x| 20 * x);
        let found = baked.pixels[(459 - row - 6) * 460 + column + 6];
        if middle.x.abs() > 0.15 {
            assert_eq!(found, pixel(if middle.x > 0.0 { 63 } else { 0 }), "{f:?} at {middle}");
        }
    }
    // The error about coordinates outside the picture names the file that has them.
    files.write("source.obj", with_charts(&files.source, |f, p, k| grid(f, p, k).map(|x| 2.0 * x)));
    let said = files.transfer(&["--texture", "@texture.png", "--out", "@b.png"]).unwrap_err();
    assert!(said.contains("source.obj: face ") && said.contains("must be from 0 to 1"), "{said}");
    files.write("plain.obj", obj::mesh(&files.source));
    files.write("source.obj", obj::mesh(&files.source));
    let said = files.transfer(&["--texture", "@texture.png", "--out", "@b.png"]).unwrap_err();
    assert!(said.contains("source.obj: line 259: a corner of the face has no texture coordinates"), "{said}");
    let said = files.transfer(&["--texture", "@plain.obj", "--out", "@b.png"]).unwrap_err();
    assert!(said.contains("plain.obj: this is no PNG file"), "{said}");
}

/// Brings curves on the source, in one of the formats, to the target and back.
fn there_and_back(files: &Files, given: &str, between: &str) -> Vec<curve_file::Curve> {
    files.transfer(&["--curves", given, "--from", "source", "--out", between]).unwrap();
    files.transfer(&["--curves", between, "--out", "@back.json"]).unwrap();
    curve_file::read(&files.read("back.json"), files.source.vertex_count()).unwrap()
}

#[test]
fn curves_go_there_and_back() {
    let files = Files::new("curves_go_there_and_back");
    // The curve is the equator of the ball, which consists of edges, as lines of the ball's OBJ file.
    let mut ring: Vec<_> =
        files.source.vertices().filter(|v| files.source.positions()[*v].z == 0.0).collect();
    let angle = |v: &conemap::mesh::VertexId| {
        let p = files.source.positions()[*v];
        conemap::math::scalar::atan2(p.y, p.x)
    };
    ring.sort_by(|v, w| angle(v).total_cmp(&angle(w)));
    let numbers: Vec<String> = ring.iter().chain([&ring[0]]).map(|v| (v.0 + 1).to_string()).collect();
    let lines = format!("g belt\nl {}\n", numbers.join(" "));
    files.write("belt.obj", [obj::mesh(&files.source), lines.into_bytes()].concat());
    for between in ["@there.json", "@there.csv"] {
        let back = there_and_back(&files, "@belt.obj", between);
        assert!(back.len() == 1 && back[0].is_closed && back[0].name == "belt");
        assert!(back[0].points.len() > ring.len());
        let soup = read_mesh(&files.read("source.obj")).unwrap();
        for point in &back[0].points {
            let LandmarkPoint::OnFace { face, barycentric } = point else { panic!("{point:?}") };
            let corners = &soup.polygons[*face as usize];
            let p: DVec3 = (0..3).map(|k| soup.positions[corners[k] as usize] * barycentric[k]).sum();
            assert!(p.z.abs() < 1e-9, "{p}");
        }
    }
    files.transfer(&["--curves", "@belt.obj", "--from", "source", "--out", "@there.obj"]).unwrap();
    let text = String::from_utf8(files.read("there.obj")).unwrap();
    assert!(text.starts_with("o belt\nv ") && text.contains("\nl 1 2 3 "));
}

#[test]
fn what_does_not_fit_is_told() {
    let files = Files::new("what_does_not_fit_is_told");
    files.write("short.csv", "vertex,a\n0,1\n");
    files.write("text.csv", "vertex,a\n0,warm\n");
    files.write("half.csv", (0..162).fold("vertex,a\n".to_owned(), |text, v| text + &format!("{v},0.5\n")));
    files.write("jump.csv", "c,0\nc,1\n");
    files.write("far.csv", "c,0\nc,99999\n");
    files.write(
        "weights.json",
        r#"{"curves": [{"name": "w", "points": [{"face": 0, "barycentric": [2, 0, 0]}]}]}"#,
    );
    let huge = "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty double a\nend_header\n";
    files.write("huge.ply", huge);
    let cases: [(&[&str], &str); 9] = [
        (&["--attributes", "@short.csv", "--out", "@a.csv"], "short.csv: vertex 1 has no value of \"a\""),
        (
            &["--attributes", "@text.csv", "--out", "@a.csv"],
            "text.csv: line 2: \"warm\" should be a number of \"a\"",
        ),
        (
            &["--attributes", "@half.csv", "--labels", "b", "--out", "@a.csv"],
            "there is no column \"b\": there are \"a\"",
        ),
        (
            &["--attributes", "@half.csv", "--labels", "a", "--out", "@a.csv"],
            "vertex 0 has the label 0.5 of \"a\"",
        ),
        (&["--attributes", "@half.csv", "--out", "@a.txt"], "the name must end in one of .csv, .ply"),
        (&["--attributes", "@huge.ply", "--out", "@a.csv"], "huge.ply: header: it announces at least"),
        (
            &["--curves", "@jump.csv", "--out", "@a.json"],
            "jump.csv: curve 1 (\"c\"), point 2: it lies in no face with",
        ),
        (
            &["--curves", "@far.csv", "--out", "@a.json"],
            "point 2: there is no vertex 99999: the mesh file has 162",
        ),
        (
            &["--curves", "@weights.json", "--out", "@a.json"],
            "(\"w\"), point 1: the weights [2.0, 0.0, 0.0] are negative",
        ),
    ];
    for (words, sentence) in cases {
        let said = files.transfer(words).unwrap_err();
        assert!(said.contains(sentence), "{words:?}: {said}");
    }
    assert!(!Path::new(&files.path("a.csv")).exists());
    let usage = files.transfer(&["--out", "@a.csv"]).unwrap_err();
    assert!(usage.contains("--attributes") && usage.contains("--frames"), "{usage}");
}

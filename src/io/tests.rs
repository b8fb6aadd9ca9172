use super::landmark_file::{LandmarkFile, LandmarkPoint};
use super::mesh_reader::ASKED_EVERY;
use super::*;
use crate::mesh::SurfaceMesh;
use crate::mesh::check::closed_genus_zero;
use crate::monitor::{Cancelled, Monitor, Step};
use proptest::prelude::*;

const OFF: &str = "OFF\n# a comment\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const OBJ: &str =
    "o t\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1/1 3/2 2/3\nf 1//1 2//1 4//1\nf 2 3 4\nf -4 -1 -2\n";

fn tetrahedron_of(bytes: &[u8]) -> SurfaceMesh {
    let mesh = closed_genus_zero(&read_mesh(bytes).unwrap()).unwrap().mesh;
    assert_eq!((mesh.vertex_count(), mesh.face_count()), (4, 4));
    assert!((mesh.area() - (1.5 + 0.75_f64.sqrt())).abs() < 1e-6);
    mesh
}

const POSITIONS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[i32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

/// The corners of `copies` tetrahedra in one place, as loose triangles.
fn corners(copies: usize) -> Vec<[[f32; 3]; 3]> {
    FACES.map(|t| t.map(|v| POSITIONS[v as usize])).repeat(copies)
}

/// The faces of so many tetrahedra with vertices of their own.
fn faces(copies: usize) -> impl Iterator<Item = [i32; 3]> {
    (0..copies as i32).flat_map(|copy| FACES.map(|t| t.map(|v| 4 * copy + v)))
}

fn off(copies: usize) -> String {
    let vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n".repeat(copies);
    let faces: String = faces(copies).map(|f| format!("3 {} {} {}\n", f[0], f[1], f[2])).collect();
    format!("OFF\n# a comment\n{0} {0} {1}\n{vertices}{faces}", 4 * copies, 6 * copies)
}

fn binary_stl(header: &[u8], copies: usize) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((4 * copies as u32).to_le_bytes());
    for t in corners(copies) {
        bytes.extend([0; 12]);
        t.iter().flatten().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl(copies: usize) -> String {
    let facet = |t: [[f32; 3]; 3]| {
        let vertices: String = t.iter().map(|p| format!("vertex {} {} {}\n", p[0], p[1], p[2])).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!("solid t\n{}endsolid t\n", corners(copies).into_iter().map(facet).collect::<String>())
}

fn ply(encoding: &str, copies: usize) -> Vec<u8> {
    let count = 4 * copies;
    let header = format!(
        "ply\nformat {encoding} 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\nelement face {count}\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    let positions = POSITIONS.repeat(copies);
    if encoding == "ascii" {
        positions.iter().for_each(|p| bytes.extend(format!("{} {} {}\n", p[0], p[1], p[2]).bytes()));
        faces(copies).for_each(|f| bytes.extend(format!("3 {} {} {}\n", f[0], f[1], f[2]).bytes()));
        return bytes;
    }
    let little = encoding == "binary_little_endian";
    positions
        .iter()
        .flatten()
        .for_each(|x| bytes.extend(if little { x.to_le_bytes() } else { x.to_be_bytes() }));
    for f in faces(copies) {
        bytes.push(3);
        f.iter().for_each(|v| bytes.extend(if little { v.to_le_bytes() } else { v.to_be_bytes() }));
    }
    bytes
}

fn gltf_text(copies: usize) -> String {
    let mut buffer = Vec::new();
    let count = 12 * copies;
    let length = 12 * count;
    corners(copies).iter().flatten().flatten().for_each(|x| buffer.extend(x.to_le_bytes()));
    let code = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, &buffer);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{count},"type":"VEC3","min":[0,0,0],"max":[1,1,1]}}],
        "bufferViews":[{{"buffer":0,"byteLength":{length}}}],
        "buffers":[{{"byteLength":{length},"uri":"data:application/octet-stream;base64,{code}"}}]}}"#
    )
}

/// Files of `copies` tetrahedra in every format.
fn samples(copies: usize) -> Vec<Vec<u8>> {
    vec![
        off(copies).into(),
        OBJ.repeat(copies).into(),
        ascii_stl(copies).into(),
        binary_stl(b"binary", copies),
        binary_stl(b"solid but binary", copies),
        ply("ascii", copies),
        ply("binary_little_endian", copies),
        ply("binary_big_endian", copies),
        gltf_text(copies).into(),
    ]
}

#[test]
fn every_format_gives_the_same_tetrahedron() {
    let formats = samples(1).iter().map(|bytes| detect(bytes).unwrap()).collect::<Vec<_>>();
    use Format::{Gltf, Obj, Off, Ply, Stl};
    assert_eq!(formats, [Off, Obj, Stl, Stl, Stl, Ply, Ply, Ply, Gltf]);
    samples(1).iter().for_each(|bytes| drop(tetrahedron_of(bytes)));
}

/// Asked so often; stops at the last question that it may answer.
struct Asked {
    times: usize,
    most: usize,
}

impl Monitor for Asked {
    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        self.times += 1;
        if self.times < self.most { Ok(()) } else { Err(Cancelled) }
    }
}

#[test]
fn every_reader_asks_and_stops() {
    const COPIES: usize = 3000;
    for (sample, bytes) in samples(COPIES).iter().enumerate() {
        let mut asked = Asked { times: 0, most: usize::MAX };
        let soup = read_mesh_asking(bytes, &mut asked).unwrap();
        assert_eq!(soup.polygons.len(), 4 * COPIES, "sample {sample}");
        // Vertices and faces, or loose triangles.
        assert!(asked.times >= 8 * COPIES / ASKED_EVERY, "sample {sample} asks {} times", asked.times);
        for most in 1..=asked.times {
            let mut stopping = Asked { times: 0, most };
            let stopped = read_mesh_asking(bytes, &mut stopping);
            assert_eq!(
                (stopped, stopping.times),
                (Err(ReadError::Stopped(Cancelled)), most),
                "sample {sample}"
            );
        }
    }
}

/// A glTF of one primitive whose accessor 0 has the positions and accessor 1 the indices.
fn gltf_of(parts: &[&[u8]], positions: &str, indices: &str, mode: u32, extension: &str) -> Vec<u8> {
    let mut views = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let offset: usize = parts[..k].iter().map(|part| part.len()).sum();
        views.push(format!("{{\"buffer\":0,\"byteOffset\":{offset},\"byteLength\":{}}}", part.len()));
    }
    let buffer = parts.concat();
    let code = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, &buffer);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[1]}}],"extensionsRequired":["{extension}"],
        "nodes":[{{"mesh":0,"scale":[2,2,2]}},{{"children":[0],"scale":[0.5,0.5,0.5],"translation":[7,0,0]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}]}}],
        "accessors":[{positions},{indices}],"bufferViews":[{}],
        "buffers":[{{"byteLength":{},"uri":"data:;base64,{code}"}}]}}"#,
        views.join(","),
        buffer.len()
    )
    .into_bytes()
}

#[test]
fn gltf_positions_and_triangles_come_in_many_ways() {
    let floats: Vec<u8> =
        [0.0_f32, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.].iter().flat_map(|x| x.to_le_bytes()).collect();
    let list = [0_u8, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    let whole = r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#;
    let bytes =
        |count: usize| format!(r#"{{"bufferView":1,"componentType":5121,"count":{count},"type":"SCALAR"}}"#);
    let texture = "KHR_texture_transform";
    tetrahedron_of(&gltf_of(&[&floats, &list], whole, &bytes(12), 4, texture));
    let strip = [0_u8, 2, 1, 3, 0, 2];
    tetrahedron_of(&gltf_of(&[&floats, &strip], whole, &bytes(6), 5, "KHR_materials_unlit"));

    let shorts: Vec<u8> =
        [0_i16, 0, 0, 32767, 0, 0, 0, 32767, 0, 0, 0, 32767].iter().flat_map(|x| x.to_le_bytes()).collect();
    let quantised = r#"{"bufferView":0,"componentType":5122,"normalized":true,"count":4,"type":"VEC3"}"#;
    tetrahedron_of(&gltf_of(&[&shorts, &list], quantised, &bytes(12), 4, "KHR_mesh_quantization"));

    let sparse = r#"{"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":3,
        "indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":0,"byteOffset":12}}}"#;
    tetrahedron_of(&gltf_of(&[&floats, &list, &[1, 2, 3]], sparse, &bytes(12), 4, texture));

    let says = |file: &[u8]| read_mesh(file).unwrap_err().to_string();
    let broken = [
        (gltf_of(&[&shorts, &list], quantised, &bytes(12), 4, texture), "its positions are not floats"),
        (
            gltf_of(&[&floats, &list, &[1, 2, 4]], sparse, &bytes(12), 4, texture),
            "sparse element 4 is not there",
        ),
        (
            gltf_of(&[&floats, &[0, 2, 9]], whole, &bytes(3), 4, texture),
            "it names vertex 9, but has 4 vertices",
        ),
        (
            gltf_of(&[&floats, &list], whole, &bytes(13), 4, texture),
            "accessor 1 reaches past the end of its view",
        ),
        (
            gltf_of(&[&floats, &list], whole, &bytes(11), 4, texture),
            "its 11 corners do not make whole triangles",
        ),
        (gltf_of(&[&floats, &list], whole, &bytes(12), 7, texture), "its mode 7 is unknown"),
        (gltf_of(&[&floats, &list], whole, &bytes(12), 4, "EXT_meshopt_compression"), "packed by meshopt"),
        (
            gltf_of(&[&floats, &list], whole, &bytes(12), 4, "ACME_shape"),
            "it requires the extension ACME_shape",
        ),
    ];
    for (file, words) in broken {
        let sentence = says(&file);
        assert!(sentence.contains(words), "{sentence}");
    }
}

#[test]
fn text_formats_have_many_forms() {
    let faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let files = [
        OFF.replace("OFF\n", ""),
        OFF.replace('\n', "\r"),
        OFF.replace("# a comment\n", "").replace('\n', " "),
        OFF.replace("OFF\n# a comment\n", "OFF"),
        OFF.replace("6\n0 0 0\n1 0 0\n0 1", "6\n0 0 0 1 0 0\n0 1"),
        format!("OFF\n4 4 6\n0 0 0 1 0 0 0 1 0 0 0 1\n{}", faces.replace('\n', " ")),
        format!("OFF\n4 4 6\n0 0 0 1 0 0 0 1 0 0 0 1 {faces}")
            .replace([' ', '\n'], "\n")
            .replacen("4\n4\n", "4 4 ", 1),
        format!("4OFF\n4 4 6\n0 0 0 2\n2 0 0 2\n0 2 0 2\n0 0 2 2\n{faces}"),
        format!("nOFF 3\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n{faces}"),
        format!(
            "CNOFF 4 4 6 {} {}",
            ["0 0 0", "1 0 0", "0 1 0", "0 0 1"].map(|p| format!("{p} 0 0 1 1 1 1 1")).join(" "),
            faces.replace('\n', " ")
        ),
        OBJ.replace("f 2 3 4", "f 2 \\\n 3 \\\r\n4 # the third"),
        format!("{}vp 0.5\nl 1 2\np 3\n{OBJ}", "# \u{fc}ber C:\\\n".repeat(2000)),
        ascii_stl(1).to_uppercase(),
    ];
    for file in files {
        tetrahedron_of(file.as_bytes());
        // Not UTF-8, and UTF-16.
        let latin1: Vec<u8> = file.chars().map(|c| c as u8).collect();
        tetrahedron_of(&latin1);
        let utf16: Vec<u8> = format!("\u{feff}{file}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        tetrahedron_of(&utf16);
    }
    let says = |text: &str| read_mesh(text.as_bytes()).unwrap_err().to_string();
    assert!(says("4OFF\n1 0 0\n1 2 3 0\n").contains("it lies at infinity"));
    // A file that was cut off is no file with several elements a line.
    let cut_off = &OFF[..OFF.len() - 16];
    assert!(says(cut_off).contains("the file ends before face 2 of 4"), "{}", says(cut_off));
    assert!(says("nOFF 5\n1 0 0\n1 2 3 4 5\n").contains("its vertices have 5 coordinates"));
    let stl = ascii_stl(1);
    assert!(says(&stl[..stl.len() - 12]).contains("cut off"));
    let binary = binary_stl(b"binary", 1);
    tetrahedron_of(&[&binary[..], &[0; 7]].concat());
    let cut = read_mesh(&binary[..binary.len() - 1]).unwrap_err().to_string();
    assert_eq!(cut, "STL file, header: it announces 4 triangles and has 3: the file is cut off");
}

#[test]
fn ply_headers_are_read_from_any_system() {
    let text = String::from_utf8(ply("ascii", 1)).unwrap();
    tetrahedron_of(text.replace('\n', "\r").as_bytes());
    tetrahedron_of(text.replace('\n', "\r\n").as_bytes());
    let binary = ply("binary_little_endian", 1);
    let end = binary.windows(11).position(|word| word == b"end_header\n").unwrap() + 11;
    for line_end in ["\r", "\r\n"] {
        let header = String::from_utf8(binary[..end].to_vec()).unwrap().replace('\n', line_end);
        tetrahedron_of(&[header.as_bytes(), &binary[end..]].concat());
    }
    let commented = text.replace("element face", "comment \u{e9}\nelement face");
    let latin1: Vec<u8> = commented.chars().map(|c| c as u8).collect();
    tetrahedron_of(&latin1);
    let says = |text: String| read_mesh(text.as_bytes()).unwrap_err().to_string();
    assert!(says(text.replace("float z", "float y")).contains("its name is there twice"));
    assert!(says(text.replace("float z", "float w")).contains("its vertices have no coordinate z"));
    assert!(says(text.replace("vertex_indices", "vertices")).contains("no list vertex_indices"));
    assert!(says(text.replace("end_header\n", "")).contains("end_header"));
}

#[test]
fn joined_vertices_keep_the_files_numbers() {
    // Corner k of triangle t is vertex 3 t + k.
    let vertices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    let first = [0, 2, 1, 5].map(|number| number as usize);
    for bytes in [ascii_stl(1).into(), binary_stl(b"binary", 1), gltf_text(1).into()] {
        let checked = closed_genus_zero(&read_mesh(&bytes).unwrap()).unwrap();
        assert_eq!(checked.vertex_from_file.len(), 12);
        for (corner, vertex) in vertices.iter().enumerate() {
            assert_eq!(checked.vertex_from_file[corner], checked.vertex_from_file[first[*vertex]]);
        }
        let mut numbers = checked.file_from_vertex();
        assert!(
            numbers.iter().zip(checked.mesh.vertices()).all(|(&n, v)| checked.vertex_from_file[n] == Some(v))
        );
        numbers.sort_unstable();
        assert_eq!(numbers, [0, 1, 2, 5]);
    }
}

#[test]
fn errors_name_the_line() {
    let says = |text: &str| read_mesh(text.as_bytes()).unwrap_err().to_string();
    assert_eq!(says(&OFF.replace("1 0 0", "1 x 0")), "OFF file, line 5: \"x\" should be a coordinate");
    assert_eq!(
        says(&OBJ.replace("f 2 3 4", "f 2 3 9")),
        "OBJ file, line 8: the face names vertex 9, but the file has 4 vertices"
    );
    // The face may stand before its vertices, and of several the one that misses its vertex by most is named.
    assert_eq!(
        says("f 1 2 3\nf 1 2 5\nf 1 9 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"),
        "OBJ file, line 3: the face names vertex 9, but the file has 3 vertices"
    );
    assert_eq!(says(&OBJ.replace("f 2 3 4", "f 2 3 -5")), "OBJ file, line 8: there is no vertex -5");
    assert_eq!(
        says(&OFF.replace("3 1 2 3", "3 1 2 8")),
        "OFF file, face 2: it names vertex 8, but the file has 4 vertices"
    );
    assert_eq!(
        says(&OBJ.replace("v 1 0 0", "v nan 0 0")),
        "OBJ file, line 3: the coordinates [NaN, 0, 0] are not usable numbers"
    );
    assert!(says("hello world").contains("OBJ, OFF, PLY"));
    assert!(says("OFF\n4000000000 3 0\n").contains("more than the file can hold"));
    let huge = String::from_utf8(ply("ascii", 1)).unwrap().replace("vertex 4", "vertex 4000000000");
    assert!(says(&huge).contains("announces"));
}

#[test]
fn landmark_files_are_refused_by_line_and_pairs() {
    let says = |pairs: &str| {
        landmark_file::read(format!("{{\"pairs\": {pairs}}}").as_bytes()).unwrap_err().to_string()
    };
    let on = |face: u32, weights: &str| format!("{{\"face\": {face}, \"barycentric\": [{weights}]}}");
    assert_eq!(
        says("[[0, 5], [1, 6], [2, 5]]"),
        "landmark pairs 1 and 3 (the first is 1) have the same point of the target"
    );
    let point = on(3, "0.2, 0.3, 0.5");
    assert_eq!(
        says(&format!("[[0, 1], [{point}, 0], [{point}, 2]]")),
        "landmark pairs 2 and 3 (the first is 1) have the same point of the source"
    );
    // Different points of different faces, and a vertex with a face's number.
    let fine = format!("[[3, 1], [{point}, 0], [{}, 2]]", on(4, "0.2, 0.3, 0.5"));
    assert!(landmark_file::read(format!("{{\"pairs\": {fine}}}").as_bytes()).is_ok());
    assert_eq!(
        says(&format!("[[0, 1], [1, {}]]", on(3, "0.2, 0.3, 0.6"))),
        "landmark pair 2 (the first is 1) has barycentric coordinates on the target that are negative or do not sum to 1: \
         [0.2, 0.3, 0.6]"
    );
    assert!(says(&format!("[[{}, 1]]", on(3, "-0.5, 0.5, 1.0"))).starts_with("landmark pair 1 "));
    for wrong in
        ["-1", "1.5", "\"7\"", "null", &on(3, "0.5, 0.5"), &on(3, "1, 0, null"), &on(3, "0, 0, 1e999")]
    {
        let sentence = says(&format!("[[0, 1],\n[2, {wrong}]]"));
        assert!(sentence.starts_with("the landmark file, line 2: "), "{wrong}: {sentence}");
    }
}

#[test]
fn entries_of_landmark_files_are_known_or_told() {
    let whole = LandmarkFile {
        source: Some("cat.off".into()),
        target: Some("lion.off".into()),
        pairs: vec![[LandmarkPoint::Vertex(0); 2]],
        radii: Some(vec![0.1]),
        labels: Some(vec!["nose".into()]),
        ground_truth: Some("same connectivity".into()),
    };
    let whole = String::from_utf8(landmark_file::write(&whole)).unwrap();
    assert_eq!(whole.matches("\": ").count(), 6, "each entry is written");
    assert!(landmark_file::unknown_entries(whole.as_bytes()).is_empty());
    let more = whole.replacen('{', "{\"radius\": [0.1], \"Comment\": {\"pairs\": 1},", 1);
    assert!(landmark_file::read(more.as_bytes()).is_ok());
    assert_eq!(landmark_file::unknown_entries(more.as_bytes()), ["Comment", "radius"]);
    let marked: Vec<u8> =
        [0xff, 0xfe].into_iter().chain(more.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    assert_eq!(landmark_file::unknown_entries(&marked), ["Comment", "radius"]);
    assert!(landmark_file::unknown_entries(b"[1]").is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn damaged_files_never_panic(sample in 0_usize..9, cut in 0.0_f64..1.0, at in 0.0_f64..1.0, byte in 0_u8..=255) {
        let mut bytes = samples(1).swap_remove(sample);
        bytes.truncate((bytes.len() as f64 * cut.sqrt()) as usize);
        let place = (bytes.len() as f64 * at) as usize;
        if let Some(b) = bytes.get_mut(place) {
            *b = byte;
        }
        if let Ok(soup) = read_mesh(&bytes) {
            let _ = closed_genus_zero(&soup);
        }
    }

    #[test]
    fn landmark_files_never_panic(text in "\\{\"pairs\": ?\\[(\\[[0-9]{1,12}, ?-?[0-9.]{1,4}\\],?){0,5}\\]?\\}?") {
        let _ = landmark_file::read(text.as_bytes());
    }
}

use super::*;
use crate::mesh::SurfaceMesh;
use crate::mesh::check::closed_genus_zero;
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

/// The tetrahedron as loose triangles.
fn corners() -> Vec<[[f32; 3]; 3]> {
    let p = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(|t: [usize; 3]| t.map(|v| p[v])).to_vec()
}

fn binary_stl(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(4_u32.to_le_bytes());
    for t in corners() {
        bytes.extend([0; 12]);
        t.iter().flatten().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl() -> String {
    let facet = |t: [[f32; 3]; 3]| {
        let vertices: String = t.iter().map(|p| format!("vertex {} {} {}\n", p[0], p[1], p[2])).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!("solid t\n{}endsolid t\n", corners().into_iter().map(facet).collect::<String>())
}

fn ply(encoding: &str) -> Vec<u8> {
    let header = format!(
        "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    let p: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let faces: [[i32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    if encoding == "ascii" {
        p.iter().for_each(|p| bytes.extend(format!("{} {} {}\n", p[0], p[1], p[2]).bytes()));
        faces.iter().for_each(|f| bytes.extend(format!("3 {} {} {}\n", f[0], f[1], f[2]).bytes()));
        return bytes;
    }
    let little = encoding == "binary_little_endian";
    p.iter().flatten().for_each(|x| bytes.extend(if little { x.to_le_bytes() } else { x.to_be_bytes() }));
    for f in faces {
        bytes.push(3);
        f.iter().for_each(|v| bytes.extend(if little { v.to_le_bytes() } else { v.to_be_bytes() }));
    }
    bytes
}

fn gltf_text() -> String {
    let mut buffer = Vec::new();
    corners().iter().flatten().flatten().for_each(|x| buffer.extend(x.to_le_bytes()));
    let code = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, &buffer);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":12,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}}],
        "bufferViews":[{{"buffer":0,"byteLength":144}}],
        "buffers":[{{"byteLength":144,"uri":"data:application/octet-stream;base64,{code}"}}]}}"#
    )
}

fn samples() -> Vec<Vec<u8>> {
    vec![
        OFF.into(),
        OBJ.into(),
        ascii_stl().into(),
        binary_stl(b"binary"),
        binary_stl(b"solid but binary"),
        ply("ascii"),
        ply("binary_little_endian"),
        ply("binary_big_endian"),
        gltf_text().into(),
    ]
}

#[test]
fn every_format_gives_the_same_tetrahedron() {
    let formats = samples().iter().map(|bytes| detect(bytes).unwrap()).collect::<Vec<_>>();
    use Format::{Gltf, Obj, Off, Ply, Stl};
    assert_eq!(formats, [Off, Obj, Stl, Stl, Stl, Ply, Ply, Ply, Gltf]);
    samples().iter().for_each(|bytes| drop(tetrahedron_of(bytes)));
}

#[test]
fn joined_vertices_keep_the_files_numbers() {
    // Corner k of triangle t is vertex 3 t + k.
    let vertices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    let first = [0, 2, 1, 5].map(|number| number as usize);
    for bytes in [ascii_stl().into(), binary_stl(b"binary"), gltf_text().into()] {
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
        "OBJ file, face 2: it names vertex 8, but the file has 4 vertices"
    );
    assert_eq!(
        says(&OBJ.replace("v 1 0 0", "v nan 0 0")),
        "OBJ file, vertex 1: the coordinates [NaN, 0, 0] are not usable numbers"
    );
    assert!(says("hello world").contains("OBJ, OFF, PLY"));
    assert!(says("OFF\n4000000000 3 0\n").contains("more than the file can hold"));
    let huge = String::from_utf8(ply("ascii")).unwrap().replace("vertex 4", "vertex 4000000000");
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn damaged_files_never_panic(sample in 0_usize..9, cut in 0.0_f64..1.0, at in 0.0_f64..1.0, byte in 0_u8..=255) {
        let mut bytes = samples().swap_remove(sample);
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

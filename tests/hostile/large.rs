//! Files of up to 1 MiB that ask for much memory or time.

const SIZE: usize = 1 << 20;

/// A text of about `SIZE` bytes that repeats a part between a beginning and an end.
fn repeated(begin: &str, part: &str, end: &str) -> Vec<u8> {
    let count = (SIZE - begin.len() - end.len()) / part.len();
    [begin, &part.repeat(count), end].concat().into_bytes()
}

/// A glTF with one list of many small elements.
fn list(name: &str, element: &str) -> Vec<u8> {
    let begin =
        format!("{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"{name}\":[{element}");
    repeated(&begin, &format!(",{element}"), "]}")
}

/// A file of one polygon with its corners at given places.
fn polygon(places: impl Iterator<Item = [f64; 2]>) -> Vec<u8> {
    let mut text = String::new();
    let mut count = 0;
    for [x, y] in places {
        text += &format!("v {x:.3} {y:.3} 0\n");
        count += 1;
    }
    let corners: Vec<String> = (1..=count).map(|k| k.to_string()).collect();
    (text + "f " + &corners.join(" ") + "\n").into_bytes()
}

/// The number of corners of a polygon whose file has about `SIZE` bytes.
const CORNERS: usize = 30_000;

fn on_circle(k: usize, turns: f64, radius: f64) -> [f64; 2] {
    let angle = std::f64::consts::TAU * turns * k as f64 / CORNERS as f64;
    [radius * conemap::math::scalar::cos(angle), radius * conemap::math::scalar::sin(angle)]
}

/// A PLY file of elements of one byte each.
fn bytes_ply(elements: &str, counts: usize) -> Vec<u8> {
    let header = format!("ply\nformat binary_little_endian 1.0\n{elements}end_header\n");
    [header.into_bytes(), vec![0; counts]].concat()
}

/// All large files, with their names.
pub fn files() -> Vec<(&'static str, Vec<u8>)> {
    let doubled: Vec<String> = (1..60).map(|k| format!("{{\"children\":[{k},{k}]}}")).collect();
    let doubled = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{},{{}}]}}",
        doubled.join(",")
    );
    let chain: Vec<String> = (1..90_000).map(|k| format!("{{\"children\":[{k}]}}")).take(45_000).collect();
    let chain = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{},{{}}]}}",
        chain.join(",")
    );
    let primitives = |count: usize| {
        let primitive = "{\"attributes\":{\"POSITION\":0}},".repeat(count);
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],\
             \"meshes\":[{{\"primitives\":[{}]}}],\
             \"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":20000,\"type\":\"VEC3\"}}],\
             \"bufferViews\":[{{\"buffer\":0,\"byteLength\":240000}}],\
             \"buffers\":[{{\"byteLength\":240000,\"uri\":\"data:;base64,{}\"}}]}}",
            primitive.trim_end_matches(','),
            "A".repeat(320_000)
        )
    };
    let vertices =
        "element vertex 1000000\nproperty uchar x\nelement face 1\nproperty list uchar int vertex_indices\n";
    let points = "element vertex 300000\nproperty uchar x\nproperty uchar y\nproperty uchar z\n\
                  element face 100000\nproperty list uchar uchar vertex_indices\n";
    let others = "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n\
                  element face 1\nproperty list uchar uchar vertex_indices\nelement other 1000000\nproperty uchar a\n";
    let radius = |k: usize| if k.is_multiple_of(2) { 1.0 } else { 0.2 };
    vec![
        ("nodes that double", doubled.into_bytes()),
        ("a chain of nodes", chain.into_bytes()),
        ("empty nodes", list("nodes", "{}")),
        ("empty scenes", list("scenes", "{}")),
        ("empty meshes", list("meshes", "{\"primitives\":[]}")),
        ("empty materials", list("materials", "{}")),
        ("small accessors", list("accessors", "{\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"}")),
        ("buffers without data", list("buffers", "{\"byteLength\":1}")),
        ("positions read again and again", primitives(10_000).into_bytes()),
        ("nested lists", repeated("{\"asset\":", "[", "")),
        ("vertices of one byte", bytes_ply(vertices, 1_000_001)),
        ("vertices of three bytes", bytes_ply(points, 1_000_000)),
        ("other elements of one byte", bytes_ply(others, 1_000_010)),
        ("a header of properties", {
            let many: String = (0..40_000).map(|k| format!("property uchar p{k}\n")).collect();
            bytes_ply(&format!("element vertex 1\n{many}element face 0\n"), 0)
        }),
        ("faces without corners", repeated("v 0 0 0\n", "f\n", "")),
        ("short faces", repeated("v 0 0 0\n", "f 1 1 1\n", "")),
        ("vertices alone", repeated("", "v 0 0 0\n", "")),
        ("one face of two vertices", repeated("v 0 0 0\nv 1 0 0\nf", " 1 2", "\n")),
        ("polygons of sixteen corners", {
            let ring: String = (0..16).map(|k| format!("v {} {} 0\n", k % 4, k * k % 7)).collect();
            repeated(&ring, "f 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\n", "")
        }),
        ("a star", polygon((0..CORNERS).map(|k| on_circle(k, 1.0, 1e4 * radius(k))))),
        ("a comb", polygon((0..CORNERS).map(|k| [k as f64, radius(k)]).chain([[3e4, 9.0], [-1.0, 9.0]]))),
        ("a spiral", {
            let half = CORNERS / 2;
            let there = (0..half).map(|k| on_circle(k, 200.0, 1.0 + k as f64));
            polygon(there.chain((0..half).rev().map(|k| on_circle(k, 200.0, 40.0 + k as f64))))
        }),
        (
            "a ball of wool",
            polygon((0..CORNERS).map(|k| on_circle(k * 7919, 1.0, 1e3 + (k * k % 31) as f64))),
        ),
        ("a continued line", repeated("v 0 0 0\nf", " 1\\\n", "\n")),
        ("comments", repeated("", "#\n", "v 0 0 0\n")),
        ("many small OFF faces", repeated("OFF\n1 130000 0\n0 0 0\n", "3 0 0 0\n", "")),
        ("a long line", repeated("solid ", "a", "\nendsolid")),
        ("short vertices", repeated("solid a\n", "vertex 0 0 0\n", "endsolid")),
        ("commas", repeated("name,x,y,z\n", ",", "\n")),
        ("columns", {
            let names: Vec<String> = (0..140_000).map(|k| k.to_string()).collect();
            format!("vertex,{}\n0\n", names.join(",")).into_bytes()
        }),
        ("curves of one point", repeated("", "a,1\nb,1\n", "")),
        ("curves without points", repeated("{\"curves\":[{\"points\":[1,2]}", ",{\"points\":[]}", "]}")),
        ("points of a curve", repeated("{\"curves\":[{\"points\":[1,2", ",3", "]}]}")),
        ("lines of two vertices", repeated("", "l 1 2\n", "")),
        ("corners without texture coordinates", repeated("v 0 0 0\nvt 0 0\n", "f 1/1 1/1 1/1\n", "")),
        ("pairs", repeated("{\"pairs\":[[0,0]", ",[1,1]", "]}")),
        ("labels", repeated("{\"pairs\":[[0,0]],\"labels\":[\"\"", ",\"\"", "]}")),
        ("open lists", repeated("", "[", "")),
        (
            "points",
            repeated(
                "<!DOCTYPE PickedPoints><PickedPoints>",
                "<point x=\"0\" y=\"0\" z=\"0\"/>",
                "</PickedPoints>",
            ),
        ),
        ("open elements", repeated("<!DOCTYPE PickedPoints>", "<PickedPoints>", "")),
    ]
}

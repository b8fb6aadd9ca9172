//! Bodies that no other table has: writes a data folder of bodies of many kinds, with the ends of their limbs as landmarks. The tables of pairs
//! (`match`, `fit`, `pairs`, `clicks`, `remeshed`) take it by `--data`.

use crate::arguments::Arguments;
use crate::bodies;
use crate::common;
use conemap::export::MeshFormat;
use std::path::Path;

/// The lengths of the edges of the bodies of a kind: three of other numbers of triangles.
const EDGES: [f64; 3] = [0.026, 0.023, 0.020];

/// Writes three bodies of each kind, the pattern first, and their pairs, into the folder that `--data` names; `--seed` draws others.
pub fn write(arguments: &Arguments) {
    let folder = &arguments.data;
    assert!(*folder != common::data_path(), "name another folder with --data");
    ["bodies", "pairs"].iter().for_each(|name| make(&folder.join(name)));
    for kind in bodies::names() {
        let number = |k: usize| if k == 0 { 0 } else { 2 * arguments.seed + k as u64 };
        let made = [0, 1, 2].map(|k| bodies::body(&kind, number(k), EDGES[k]));
        let path = |k: usize| format!("bodies/{kind}{k}.off");
        for (k, body) in made.iter().enumerate() {
            std::fs::write(folder.join(path(k)), MeshFormat::Off.write(&body.mesh))
                .expect("a file can be written");
        }
        for [a, b] in [[0, 1], [0, 2], [1, 2]] {
            let (labels, pairs) = made[a].common_ends(&made[b]);
            let file =
                serde_json::json!({ "source": path(a), "target": path(b), "pairs": pairs, "labels": labels });
            let name = folder.join(format!("pairs/{kind}{a}-{kind}{b}.json"));
            std::fs::write(name, file.to_string()).expect("a file can be written");
        }
        let faces = made.map(|body| body.mesh.face_count());
        println!("{kind:12} {faces:?} faces");
    }
}

fn make(folder: &Path) {
    std::fs::create_dir_all(folder).expect("a folder can be made");
}

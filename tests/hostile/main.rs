//! Tests of readers on hostile files: kept ones with the expected answer to each, large ones that ask for much memory, and changed copies
//! of both. Every file must be answered within 256 MiB; the time is only printed, since other programs may run.
//!
//! `cargo xtask fuzz --runs N --seed S` makes more changes.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod counting;
mod large;
mod mutation;
mod readers;
mod small_map;

use counting::most_bytes;
use mutation::Mutator;
use readers::Reader;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The memory in bytes that the reading of a file of up to 1 MiB may take, beyond the file itself.
const MOST_BYTES: usize = 256 << 20;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hostile")
}

/// The kept files with their names, in the names' order.
fn kept() -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder().join("files")).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = entries
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&path).unwrap()))
        .collect();
    files.sort();
    files
}

/// The answer to a file, and the memory that it took, in bytes.
fn answer(name: &str, bytes: &[u8]) -> (String, usize) {
    if name.ends_with(".json") {
        most_bytes(|| readers::landmarks(name, bytes))
    } else {
        most_bytes(|| readers::mesh(bytes))
    }
}

/// `outcomes.txt` has a line for each kept file: its name and the answer to it. With `CONEMAP_WRITE_OUTCOMES` set the file is written anew.
#[test]
fn kept_files_are_answered_as_told() {
    let mut told = String::new();
    for (name, bytes) in kept() {
        let (said, memory) = answer(&name, &bytes);
        assert!(memory <= MOST_BYTES, "{name} took {memory} bytes");
        let said: String = said.chars().take(300).map(|c| if c.is_control() { ' ' } else { c }).collect();
        told += &format!("{name}: {said}\n");
    }
    let place = folder().join("outcomes.txt");
    if std::env::var_os("CONEMAP_WRITE_OUTCOMES").is_some() {
        std::fs::write(&place, &told).unwrap();
    }
    let expected = std::fs::read_to_string(&place).unwrap();
    let other: Vec<_> = told.lines().filter(|line| !expected.lines().any(|known| known == *line)).collect();
    assert!(other.is_empty(), "answered otherwise than in outcomes.txt:\n{}", other.join("\n"));
    assert_eq!(told.lines().count(), expected.lines().count());
}

#[test]
fn large_files_are_answered_in_little_memory() {
    for (name, bytes) in large::files() {
        assert!(bytes.len() <= (1 << 20) + 64, "{name}: {} bytes", bytes.len());
        let begun = Instant::now();
        for reader in Reader::of_large_files() {
            let (_, memory) = most_bytes(|| reader.read(&bytes));
            let seconds = begun.elapsed().as_secs_f64();
            println!("{name}, {}: {seconds:.2} s, {} MiB", reader.name(), memory >> 20);
            assert!(memory <= MOST_BYTES, "{name}, {}: {memory} bytes", reader.name());
        }
    }
}

/// The runs of a reader on changed files.
struct Runs {
    reader: Reader,
    count: usize,
    most_bytes: usize,
    longest: Duration,
}

/// Has a reader read changed files; a panic says how to make the file again.
fn run(reader: Reader, count: usize, seed: u64) -> Runs {
    let mut files = kept();
    files.extend(written());
    files.extend(beside_meshes());
    let seeds: Vec<Vec<u8>> =
        files.into_iter().filter(|(name, bytes)| reader.reads(name, bytes)).map(|(_, bytes)| bytes).collect();
    assert!(!seeds.is_empty(), "no file for {}", reader.name());
    let mut mutator = Mutator::new(seed);
    let mut runs = Runs { reader, count, most_bytes: 0, longest: Duration::ZERO };
    for number in 0..count {
        let bytes = mutator.changed(&seeds);
        let begun = Instant::now();
        let outcome = std::panic::catch_unwind(|| most_bytes(|| reader.read(&bytes)));
        let place = folder().join("../../target/finding.bin");
        let Ok((_, memory)) = outcome else {
            std::fs::write(&place, &bytes).unwrap();
            panic!("{}, seed {seed}, run {number}: panic; the file is {}", reader.name(), place.display());
        };
        if memory > MOST_BYTES {
            std::fs::write(&place, &bytes).unwrap();
            panic!("{}, seed {seed}, run {number}: {memory} bytes; {}", reader.name(), place.display());
        }
        runs.most_bytes = runs.most_bytes.max(memory);
        runs.longest = runs.longest.max(begun.elapsed());
    }
    runs
}

/// Landmark files of all formats, as the program writes them.
fn written() -> Vec<(String, Vec<u8>)> {
    use conemap::io::landmark_file::{LandmarkFile, LandmarkPoint};
    use conemap::io::landmark_formats::{LandmarkFormat, Space};
    use conemap::landmark_exchange::{Surface, write_pairs, write_side};
    use conemap::landmarks::MeshSide;
    let surface = Surface { mesh: readers::MESH.checked(), space: Space::Lps };
    let pairs = (0..6).map(|v| [LandmarkPoint::Vertex(v); 2]).collect();
    let labels = Some((0..6).map(|k| format!("point {k}")).collect());
    let file = LandmarkFile { pairs, labels, ..LandmarkFile::default() };
    let mut files = Vec::new();
    for format in LandmarkFormat::ALL {
        let name = format!("a.{}", format.ending());
        files.extend(write_pairs(format, &file, [surface; 2]).map(|bytes| (name.clone(), bytes)));
        files.extend(write_side(format, &file, surface, MeshSide::Source).map(|bytes| (name, bytes)));
    }
    files
}

/// Good files of the kinds that go with a mesh; readers accept each.
fn beside_meshes() -> Vec<(String, Vec<u8>)> {
    let vertices = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n";
    let textured =
        format!("{vertices}vt 0 0\nvt 0.5 1 0\nvt 1 \\\n0 # c\nf 1/1/1 3/2 5/-1\nf 3/-3/2 2/2 5/3\n");
    let ply = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
               property uchar red\nproperty double u\nproperty double v\nproperty list uchar int others\n\
               element face 2\nproperty list uchar int vertex_indices\nend_header\n1 0 0 255 0.5 0 1 7\n-1 0 0 0 0 1 0\n\
               0 1 0 3 1 1 2 8 9\n0 -1 0 4 0 0 0\n0 0 1 5 0.25 0.5 0\n0 0 -1 6 1 0 0\n3 0 2 4\n3 2 1 4\n";
    let binary = {
        let head = "ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
                    property ushort u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let numbers = [1.0_f32, 0.0, 2.5].iter().flat_map(|x| x.to_le_bytes());
        let row: Vec<u8> = numbers.chain(7_u16.to_le_bytes()).chain(0.5_f32.to_le_bytes()).collect();
        let face: Vec<u8> =
            std::iter::once(3).chain([0_i32, 2, 4].iter().flat_map(|v| v.to_le_bytes())).collect();
        [head.as_bytes(), &row.repeat(6), &face].concat()
    };
    let curves = r#"{"curves": [{"name": "belt", "closed": true, "points": [0, 2, {"face": 3, "barycentric": [0.5, 0.5, 0]}]}]}"#;
    let map = small_map::bytes(&readers::MESH);
    let texts = [
        ("table.csv", "1.5,0.25\n-2,3\n0,0\n1e3,-1e-3\n5,5\n6,6\n"),
        ("table-numbered.csv", "vertex,heat,u # both\r\n3,1.5,0.25\r\n\r\n0,,3\r\n5,1,1"),
        ("table.ply", ply),
        ("texture.ply", ply),
        ("texture.obj", &textured),
        ("moved.obj", &format!("{textured}vn 0 0 1\nvn 1 0 \\\n 0\n")),
        ("curves.obj", &format!("{vertices}g belt\nl 1 2/2 3 \\\n1 # 5\ng\nl -1 -2\n")),
        ("curves.csv", "curve,vertex\nbelt,0\nbelt,1\nbelt,2\nbelt,0 # again\n2,5\n2,3,0.5,0.5,0,1,2\n"),
        ("curves.json", curves),
        ("points.csv", "\"\",\"face\",\"b0\",\"b1\",\"b2\"\n\"1\",0,0.5,0.5,0 # middle\n\"2\",\"5\"\n"),
    ];
    let texts = texts.into_iter().map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    let others = [
        ("table-binary.ply", binary.clone()),
        ("texture-binary.ply", binary),
        ("unpacked.conemap", mutation::unpacked(&map)),
    ];
    texts.chain(others.map(|(name, bytes)| (name.to_owned(), bytes))).collect()
}

#[test]
fn good_files_are_read() {
    for (name, bytes) in beside_meshes() {
        for reader in Reader::all().into_iter().filter(|reader| reader.reads(&name, &bytes)) {
            let said = reader.read(&bytes);
            let is_read = said.starts_with(|c: char| c.is_ascii_digit()) || said == "can be moved";
            // Some of the files are meshes with holes, or lists of landmarks, which need not be accepted.
            assert!(
                is_read || matches!(reader, Reader::Mesh(_) | Reader::Landmarks(_)),
                "{name}, {}: {said}",
                reader.name()
            );
        }
    }
}

#[test]
fn changed_files_are_answered() {
    for reader in Reader::all() {
        run(reader, 400, 1);
    }
}

/// Run by `cargo xtask fuzz`, which sets the numbers and, where one is wanted alone, the reader's name.
#[test]
#[ignore = "takes as long as one wants"]
fn many_changed_files_are_answered() {
    let number = |name: &str, usual: u64| {
        std::env::var(name).ok().map_or(usual, |text| text.parse().expect("a whole number"))
    };
    let (count, seed) = (number("CONEMAP_FUZZ_RUNS", 100_000) as usize, number("CONEMAP_FUZZ_SEED", 1));
    let wanted = std::env::var("CONEMAP_FUZZ_READER").ok();
    let readers: Vec<Reader> = Reader::all()
        .into_iter()
        .filter(|reader| wanted.as_ref().is_none_or(|name| *name == reader.name()))
        .collect();
    assert!(
        !readers.is_empty(),
        "the readers: {}",
        Reader::all().into_iter().map(Reader::name).collect::<Vec<_>>().join(", ")
    );
    for reader in readers {
        let begun = Instant::now();
        let runs = run(reader, count, seed);
        println!(
            "{:24} {} runs, {:.0} s, longest {:.3} s, at most {:.1} MiB",
            runs.reader.name(),
            runs.count,
            begun.elapsed().as_secs_f64(),
            runs.longest.as_secs_f64(),
            runs.most_bytes as f64 / (1 << 20) as f64
        );
    }
}

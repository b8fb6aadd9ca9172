//! Real map files of two small meshes, taken apart so that tests can change them.
#![allow(clippy::expect_used, clippy::unwrap_used, clippy::panic, reason = "a test fails by a panic")]
#![allow(dead_code, reason = "every test file uses another part")]

use conemap_verify::{GivenMesh, Proof, Refusal, verify};
use serde_json::{Value, json};
use std::ops::ControlFlow;

/// A mesh of a test.
#[derive(Clone)]
pub struct Mesh {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Reads an OFF file of triangles.
    pub fn read(text: &str) -> Self {
        let mut words = text.split_whitespace().skip(1);
        let mut next = || words.next().expect("a number");
        let [vertices, faces, _] = [(); 3].map(|()| next().parse::<usize>().expect("a count"));
        let positions =
            (0..vertices).map(|_| [(); 3].map(|()| next().parse().expect("a coordinate"))).collect();
        let triangle = |_| {
            assert_eq!(next(), "3");
            [(); 3].map(|()| next().parse().expect("a vertex"))
        };
        Self { positions, triangles: (0..faces).map(triangle).collect() }
    }

    pub fn given(&self) -> GivenMesh<'_> {
        GivenMesh { positions: &self.positions, joined_with: &[], triangles: &self.triangles }
    }
}

/// The elements of a section.
#[derive(Clone, Debug)]
pub enum Elements {
    U8(Vec<u8>),
    U32(Vec<u32>),
    F64(Vec<f64>),
}

/// A map file taken apart, with its meshes.
#[derive(Clone)]
pub struct Example {
    pub header: Value,
    pub sections: Vec<(String, Elements)>,
    pub meshes: [Mesh; 2],
}

/// A bean, most of its faces inside out and one of its vertices unused, mapped onto a ball; one landmark pair lies inside faces.
pub const BEAN_BALL: &[u8] = include_bytes!("../data/bean-ball.conemap");
/// The same meshes, the map going to the ball's mirror image; it has pieces that are too thin to tell their matrix.
pub const BEAN_BALL_MIRRORED: &[u8] = include_bytes!("../data/bean-ball-mirrored.conemap");

/// The bean and the ball.
pub fn meshes() -> [Mesh; 2] {
    [include_str!("../data/bean.off"), include_str!("../data/ball.off")].map(Mesh::read)
}

/// Proves a map file of bytes.
pub fn judged(bytes: &[u8], meshes: &[Mesh; 2]) -> Result<Proof, Refusal> {
    verify(bytes, [meshes[0].given(), meshes[1].given()], &mut |_| ControlFlow::Continue(()))
}

impl Example {
    pub fn new(bytes: &[u8]) -> Self {
        let length = u32::from_le_bytes(bytes[12..16].try_into().expect("4 bytes")) as usize;
        let (text, data) = bytes[16..].split_at(length);
        let header: Value = serde_json::from_slice(text).expect("a header");
        let section = |entry: &Value| {
            let number = |key: &str| entry[key].as_u64().expect("a number") as usize;
            let stored = &data[number("offset")..number("offset") + number("bytes")];
            let bytes = match entry["packing"].as_str() {
                Some("deflate") => miniz_oxide::inflate::decompress_to_vec_zlib(stored).expect("packed"),
                _ => stored.to_vec(),
            };
            let elements = match entry["type"].as_str() {
                Some("u8") => Elements::U8(bytes),
                Some("u32") => {
                    Elements::U32(bytes.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect())
                }
                _ => Elements::F64(bytes.as_chunks().0.iter().map(|b| f64::from_le_bytes(*b)).collect()),
            };
            (entry["name"].as_str().expect("a name").to_owned(), elements)
        };
        let sections = header["sections"].as_array().expect("sections").iter().map(section).collect();
        Self { header, sections, meshes: meshes() }
    }

    /// The file, nothing of it packed.
    pub fn bytes(&self) -> Vec<u8> {
        let (mut data, mut entries) = (Vec::new(), Vec::new());
        for (name, elements) in &self.sections {
            let (kind, count, bytes) = match elements {
                Elements::U8(x) => ("u8", x.len(), x.clone()),
                Elements::U32(x) => ("u32", x.len(), x.iter().flat_map(|x| x.to_le_bytes()).collect()),
                Elements::F64(x) => ("f64", x.len(), x.iter().flat_map(|x| x.to_le_bytes()).collect()),
            };
            let entry = json!({
                "name": name, "type": kind, "count": count, "packing": "none", "offset": data.len(), "bytes": bytes.len(),
            });
            entries.push(entry);
            data.extend(bytes);
            data.resize(data.len().next_multiple_of(8), 0);
        }
        let mut header = self.header.clone();
        header["sections"] = Value::Array(entries);
        let mut text = serde_json::to_vec(&header).expect("JSON");
        text.resize(text.len().next_multiple_of(8), b' ');
        let length = (text.len() as u32).to_le_bytes();
        [b"CONEMAP\0\x01\0\0\0".as_slice(), &length, &text, &data].concat()
    }

    pub fn judged(&self) -> Result<Proof, Refusal> {
        judged(&self.bytes(), &self.meshes)
    }

    /// The refusal of this file with a change.
    pub fn refused(&self, change: impl FnOnce(&mut Self)) -> Refusal {
        let mut changed = self.clone();
        change(&mut changed);
        changed.judged().expect_err("the change was not refused")
    }

    fn section(&mut self, name: &str) -> &mut Elements {
        &mut self.sections.iter_mut().find(|(other, _)| other == name).expect("a section").1
    }

    pub fn bytes_of(&mut self, name: &str) -> &mut Vec<u8> {
        match self.section(name) {
            Elements::U8(x) => x,
            other => panic!("{name}: {other:?}"),
        }
    }

    pub fn integers(&mut self, name: &str) -> &mut Vec<u32> {
        match self.section(name) {
            Elements::U32(x) => x,
            other => panic!("{name}: {other:?}"),
        }
    }

    pub fn numbers(&mut self, name: &str) -> &mut Vec<f64> {
        match self.section(name) {
            Elements::F64(x) => x,
            other => panic!("{name}: {other:?}"),
        }
    }

    /// The corners of all pieces.
    pub fn rings(&mut self) -> Vec<Vec<u32>> {
        let sizes = self.integers("pieces.sizes").clone();
        let mut corners = self.integers("pieces.corners").clone().into_iter();
        sizes.iter().map(|&n| corners.by_ref().take(n as usize).collect()).collect()
    }

    /// Other pieces in place of those that there are, each with its faces.
    pub fn set_pieces(&mut self, pieces: &[(Vec<u32>, [u32; 2])]) {
        *self.integers("pieces.sizes") = pieces.iter().map(|(ring, _)| ring.len() as u32).collect();
        *self.integers("pieces.corners") = pieces.iter().flat_map(|(ring, _)| ring.clone()).collect();
        *self.integers("pieces.source_faces") = pieces.iter().map(|(_, faces)| faces[0]).collect();
        *self.integers("pieces.target_faces") = pieces.iter().map(|(_, faces)| faces[1]).collect();
    }

    /// All pieces with their faces.
    pub fn pieces(&mut self) -> Vec<(Vec<u32>, [u32; 2])> {
        let rings = self.rings();
        let faces =
            [self.integers("pieces.source_faces").clone(), self.integers("pieces.target_faces").clone()];
        rings.into_iter().enumerate().map(|(k, ring)| (ring, [faces[0][k], faces[1][k]])).collect()
    }

    /// Where the parameters of an overlay vertex begin, and how many they are.
    pub fn parameters(&mut self, side: &str, vertex: usize) -> std::ops::Range<usize> {
        let count = |kind: &u8| [0, 1, 3][usize::from(*kind)];
        let kinds = self.bytes_of(&format!("vertices.{side}.kinds"));
        let begin = kinds[..vertex].iter().map(count).sum();
        begin..begin + count(&kinds[vertex])
    }

    /// The first overlay vertex of a kind of place.
    pub fn first_of(&mut self, side: &str, kind: u8) -> usize {
        let kinds = self.bytes_of(&format!("vertices.{side}.kinds"));
        kinds.iter().position(|&k| k == kind).expect("a vertex of that kind")
    }
}

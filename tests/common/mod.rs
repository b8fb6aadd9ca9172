//! Real meshes and landmark pairs that live beside the project, for tests and benchmarks.
//!
//! They are read from `../shared/data`. A plain checkout has no folder `../shared`: tests that need the meshes are shown as ignored there,
//! by name. Where the folder exists, a missing file is a failure.
#![allow(clippy::print_stderr, reason = "benchmarks say why they are left out")]
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::io;
use conemap::io::landmark_file::{LandmarkFile, LandmarkPoint};
use conemap::landmarks::Landmarks;
use conemap::mesh::coarsening::Level;
use conemap::mesh::{SurfaceMesh, VertexId, check};
use conemap::monitor::Silent;
use conemap::pipeline::{CapFaces, GroundTruth, MapInput};
use std::path::{Path, PathBuf};

/// The folder of the real meshes, whether it exists or not.
pub fn data_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data")
}

/// Whether this checkout lies beside a folder `../shared`; a file that is missing in that folder is a failure.
pub fn has_data() -> bool {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").exists()
}

/// The data folder; `None` in a plain checkout, where standard error says that `user` is left out.
pub fn data_folder(user: &str) -> Option<PathBuf> {
    if !has_data() {
        eprintln!("left out, {user}: the real meshes (../shared/data) are not part of a plain checkout");
        return None;
    }
    Some(data_path())
}

/// Reads a mesh of the data folder.
pub fn read_mesh(path: &Path) -> SurfaceMesh {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let soup = io::read_mesh(&bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    check::closed_genus_zero(&soup).unwrap_or_else(|e| panic!("{}: {e}", path.display())).mesh
}

/// A landmark file with both its meshes.
pub struct Pair {
    pub name: String,
    pub source: SurfaceMesh,
    pub target: SurfaceMesh,
    pub file: LandmarkFile,
}

impl Pair {
    /// The pair as input of the pipeline.
    pub fn input<'a>(&'a self, landmarks: &'a Landmarks, ground_truth: GroundTruth<'a>) -> MapInput<'a> {
        MapInput {
            source: &self.source,
            target: &self.target,
            landmarks,
            ground_truth,
            caps: CapFaces::default(),
        }
    }
}

/// Reads `pairs/NAME.json` and its meshes.
pub fn read_pair(data: &Path, name: &str) -> Pair {
    let path = data.join("pairs").join(format!("{name}.json"));
    let text = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let file: LandmarkFile =
        serde_json::from_slice(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mesh = |p: &Option<String>| read_mesh(&data.join(p.as_ref().expect("pair files name their meshes")));
    Pair { name: name.into(), source: mesh(&file.source), target: mesh(&file.target), file }
}

/// The names of all pair files, sorted.
pub fn pair_names(data: &Path) -> Vec<String> {
    let folder = data.join("pairs");
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut names: Vec<String> =
        entries.filter_map(|e| Some(e.ok()?.path().file_stem()?.to_str()?.to_owned())).collect();
    names.sort();
    names
}

/// The pairs of a file whose landmarks are all vertices.
pub fn vertex_pairs(file: &LandmarkFile) -> Vec<[u32; 2]> {
    let vertex = |p: LandmarkPoint| match p {
        LandmarkPoint::Vertex(v) => v,
        LandmarkPoint::OnFace { .. } => panic!("the data has vertices only"),
    };
    file.pairs.iter().map(|pair| pair.map(vertex)).collect()
}

/// The landmarks of a pair file.
pub fn landmarks(pair: &Pair) -> Landmarks {
    Landmarks::from_vertices(&pair.source, &pair.target, &vertex_pairs(&pair.file))
        .unwrap_or_else(|e| panic!("{}: {e}", pair.name))
}

/// Two meshes of one connectivity coarsened to about `goal` vertices, in the same way, and the landmarks, which stay, by their new numbers.
pub fn coarsened(
    [source, target]: [&SurfaceMesh; 2],
    landmarks: &[VertexId],
    goal: usize,
) -> ([SurfaceMesh; 2], Vec<VertexId>) {
    let level = Level::coarse(source, landmarks, goal, &mut Silent).expect("nothing cancels");
    let places = level.vertices.iter().map(|&v| target.positions()[v]).collect();
    let target = level.mesh.with_positions(places);
    let landmarks = level.numbers(landmarks).collect();
    ([level.mesh, target], landmarks)
}

/// Landmarks by farthest points in space: the first vertex, then the one farthest from all so far.
pub fn farthest_points(mesh: &SurfaceMesh, count: usize) -> Vec<VertexId> {
    let mut chosen = vec![VertexId(0)];
    let mut nearest: Vec<f64> = vec![f64::INFINITY; mesh.vertex_count()];
    while chosen.len() < count {
        let last = mesh.positions()[chosen[chosen.len() - 1]];
        for (d, p) in nearest.iter_mut().zip(mesh.positions()) {
            *d = d.min(p.distance(last));
        }
        let far = (0..nearest.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).expect("vertices");
        chosen.push(far.into());
    }
    chosen
}

/// The names of all fields of a JSON value, as sorted paths to the leaves; arrays are leaves.
pub fn json_fields(value: &serde_json::Value) -> Vec<String> {
    fn collect(value: &serde_json::Value, path: &str, fields: &mut Vec<String>) {
        match value {
            serde_json::Value::Object(map) if !map.is_empty() => {
                for (key, inner) in map {
                    let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                    collect(inner, &path, fields);
                }
            }
            _ => fields.push(path.to_owned()),
        }
    }
    let mut fields = Vec::new();
    collect(value, "", &mut fields);
    fields.sort();
    fields
}

/// The fields of the report of a map; the fields inside `ground_truth` and `seconds` are not listed.
pub const REPORT_FIELDS: [&str; 44] = [
    "base_domain.faces",
    "base_domain.vertices",
    "borders",
    "certificate.bijective",
    "certificate.flipped_triangles",
    "certificate.max_angle_sum_error",
    "certificate.max_landmark_error",
    "certificate.triangles",
    "cone_metric.source.cg_iterations",
    "cone_metric.source.edge_flips",
    "cone_metric.source.max_curvature_error",
    "cone_metric.source.newton_steps",
    "cone_metric.source.residuals",
    "cone_metric.source.seconds",
    "cone_metric.target.cg_iterations",
    "cone_metric.target.edge_flips",
    "cone_metric.target.max_curvature_error",
    "cone_metric.target.newton_steps",
    "cone_metric.target.residuals",
    "cone_metric.target.seconds",
    "coverage",
    "distortion.dented",
    "distortion.energy",
    "distortion.l2_stretch",
    "distortion.max",
    "distortion.mean",
    "distortion.mean_log",
    "distortion.median",
    "distortion.p95",
    "distortion.worst",
    "faces.source",
    "faces.target",
    "layout.judged",
    "layout.mean_log",
    "layout.path_stretch",
    "layout.rival",
    "layout.runner_up",
    "layout.twists",
    "own_landmarks",
    "findings",
    "stopped_early",
    "unmapped_share",
    "warnings",
    "ground_truth",
];

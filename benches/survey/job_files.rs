//! The files of a job by name: a generated ball or a mesh of the data folder with a bent copy of itself, or a pair of the data folder.

use crate::arguments::Arguments;
use crate::common::{farthest_points, read_mesh};
use crate::hostile_geometry::HostileCase;
use crate::judged_job::Files;
use conemap::io::landmark_file::LandmarkPoint;
use conemap::mesh::generators::icosphere;
use conemap::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;

/// The files of the job that a name stands for: an icosphere of so many subdivisions ("ball-6"), a pair ("cat-lion"), or a mesh of the data
/// folder ("single/horse97k.off").
pub fn files(arguments: &Arguments, name: &str) -> Files {
    if let Some(levels) = name.strip_prefix("ball-") {
        let ball = icosphere(levels.parse().expect("a number of subdivisions"));
        let landmarks: Vec<VertexId> = (0..24).map(VertexId).collect();
        return onto_itself_bent(ball, &landmarks);
    }
    if name.contains('/') {
        let mesh = read_mesh(&arguments.data.join(name));
        let landmarks = farthest_points(&mesh, 24);
        return onto_itself_bent(mesh, &landmarks);
    }
    let bytes = |path: &str| {
        let path = arguments.data.join(path);
        std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    let landmarks = bytes(&format!("pairs/{name}.json"));
    let pair: serde_json::Value = serde_json::from_slice(&landmarks).expect("a landmark file");
    let mesh = |side: &str| bytes(pair[side].as_str().expect("a pair names its meshes"));
    Files { source: mesh("source"), target: mesh("target"), landmarks }
}

fn onto_itself_bent(source: SurfaceMesh, landmarks: &[VertexId]) -> Files {
    let size = source.area().sqrt();
    let bend = |p: &DVec3| {
        let q = *p / size;
        DVec3::new(1.3 * p.x, p.y + 0.2 * q.x * q.x * size, p.z * (1.0 + 0.2 * q.y))
    };
    let target = source.with_positions(source.positions().iter().map(bend).collect());
    let pairs = landmarks.iter().map(|v| [LandmarkPoint::Vertex(v.0); 2]).collect();
    HostileCase { meshes: [source, target], pairs }.into()
}

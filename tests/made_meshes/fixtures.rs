//! Meshes with landmarks that the project makes itself.

use crate::theorems::Case;
use conemap::demo;
use conemap::landmarks::Landmarks;
use conemap::math::scalar::{cos, sin};
use conemap::mesh::generators::midpoint_subdivision;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::GroundTruth;
use conemap::remesh::{Noise, Options, perturbed, remesh};
use glam::DVec3;

/// A demo with its landmarks.
pub fn demo(id: &str) -> Case {
    let demo = demo::build(id).unwrap_or_else(|| panic!("there is a demo {id}"));
    let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &demo.landmarks).unwrap();
    Case {
        name: id.into(),
        source: demo.source,
        target: demo.target,
        landmarks,
        ground_truth: GroundTruth::Unknown,
    }
}

/// The three small demos; the others are four times as large.
pub fn demos() -> Vec<Case> {
    ["horse-cat", "poses", "sphere-tetrahedron"].map(demo).into()
}

/// The mesh bent sideways along its length; vertex i corresponds to vertex i.
pub fn bent(mesh: &SurfaceMesh) -> SurfaceMesh {
    let bend = |p: &DVec3| {
        let (angle, radius) = (0.25 * p.x, 4.0 - p.z);
        DVec3::new(radius * sin(angle), p.y, 4.0 - radius * cos(angle))
    };
    mesh.with_positions(mesh.positions().iter().map(bend).collect())
}

/// The surface in other triangles, and its vertices nearest to the given ones, each taken once.
fn remeshed(mesh: &SurfaceMesh, faces: usize, vertices: &[VertexId]) -> (SurfaceMesh, Vec<VertexId>) {
    let new = remesh(mesh, &Options::to_faces(faces), &mut Silent).unwrap().mesh;
    let mut taken = Vec::new();
    for &v in vertices {
        let distance = |w: &VertexId| new.positions()[*w].distance_squared(mesh.positions()[v]);
        let free = new.vertices().filter(|w| !taken.contains(w));
        taken.extend(free.min_by(|a, b| distance(a).total_cmp(&distance(b))));
    }
    (new, taken)
}

/// A demo in other triangles, with the given numbers of faces on source and target.
pub fn remeshed_demo(id: &str, faces: [usize; 2]) -> Case {
    let Case { source, target, landmarks, ground_truth, .. } = demo(id);
    let (source, from) = remeshed(&source, faces[0], &landmarks.source.raw);
    let (target, onto) = remeshed(&target, faces[1], &landmarks.target.raw);
    let landmarks = Landmarks { source: from.into(), target: onto.into() };
    Case { name: format!("{id} with {faces:?} faces"), source, target, landmarks, ground_truth }
}

/// A demo with every vertex moved at random, so that its triangles are uneven and its surface is rough.
pub fn rough_demo(id: &str) -> Case {
    let case = demo(id);
    let [source, target] = [(&case.source, 1), (&case.target, 2)]
        .map(|(mesh, seed)| perturbed(mesh, Noise { tangential: 0.3, normal: 0.1, seed }));
    Case { name: format!("rough {id}"), source, target, ..case }
}

/// The horse, and the same surface moved, enlarged and with each triangle split into four; the first vertices correspond.
pub fn split_horse() -> Case {
    let Case { source, landmarks, .. } = demo("horse-cat");
    let split = midpoint_subdivision(&source);
    let turned = |p: &DVec3| 3.0 * DVec3::new(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z) + DVec3::ONE;
    let target = split.with_positions(split.positions().iter().map(turned).collect());
    let landmarks = Landmarks { source: landmarks.source.clone(), target: landmarks.source };
    Case { name: "split horse".into(), source, target, landmarks, ground_truth: GroundTruth::Unknown }
}

/// The horse, and the same horse with its front turned to the side: vertex i corresponds to vertex i.
pub fn bent_horse() -> Case {
    let Case { source, landmarks, .. } = demo("horse-cat");
    // The bend begins at the middle of the body and grows towards the nose, around a vertical axis.
    let bent = |p: &DVec3| {
        let along = ((p.x - 0.1) / 0.9).clamp(0.0, 1.0);
        let angle = 0.7 * along * along * (3.0 - 2.0 * along);
        let (s, c) = (sin(angle), cos(angle));
        DVec3::new(0.1 + c * (p.x - 0.1) + s * p.z, p.y, c * p.z - s * (p.x - 0.1))
    };
    let target = source.with_positions(source.positions().iter().map(bent).collect());
    let landmarks = Landmarks { source: landmarks.source.clone(), target: landmarks.source };
    Case { name: "bent horse".into(), source, target, landmarks, ground_truth: GroundTruth::SameConnectivity }
}

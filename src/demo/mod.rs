//! Demos: procedural closed shapes of genus 0, different connectivity on both sides, landmarks known.

mod animal;
mod figure;
mod implicit;
mod polygonise;
mod round;
mod shape;

use crate::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;
use shape::Shape;

/// A demo that can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DemoInfo {
    /// Name in links.
    pub id: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// What it shows.
    pub sentence: &'static str,
}

/// Two meshes with corresponding landmarks.
#[derive(Clone, Debug)]
pub struct Demo {
    /// The source.
    pub source: SurfaceMesh,
    /// The target.
    pub target: SurfaceMesh,
    /// Corresponding source and target vertices.
    pub landmarks: Vec<[u32; 2]>,
    /// One name per pair.
    pub labels: Vec<String>,
}

const DEMOS: [DemoInfo; 3] = [
    DemoInfo {
        id: "horse-cat",
        title: "Horse and cat",
        sentence: "Two four-legged shapes of different build",
    },
    DemoInfo { id: "poses", title: "Two poses", sentence: "One figure standing and dancing, meshed twice" },
    DemoInfo {
        id: "sphere-tetrahedron",
        title: "Sphere and tetrahedron",
        sentence: "A ball and a rounded tetrahedron",
    },
];

/// All demos.
pub fn list() -> &'static [DemoInfo] {
    &DEMOS
}

/// Builds a demo by its id.
pub fn build(id: &str) -> Option<Demo> {
    match id {
        "horse-cat" => Some(pair(animal::horse(), animal::cat())),
        "poses" => Some(pair(figure::standing(), figure::dancing())),
        "sphere-tetrahedron" => Some(pair(round::sphere(), round::tetrahedron())),
        _ => None,
    }
}

/// Pairs the points of equal place in both lists.
fn pair(source: Shape, target: Shape) -> Demo {
    let [s, t] = [&source, &target].map(|shape| nearest_vertices(&shape.mesh, &shape.points));
    let landmarks = s.into_iter().zip(t).map(|(a, b)| [a.0, b.0]).collect();
    let labels = source.points.iter().map(|(name, _)| (*name).to_owned()).collect();
    Demo { source: source.mesh, target: target.mesh, landmarks, labels }
}

/// The nearest vertex of each point, each vertex taken once.
fn nearest_vertices(mesh: &SurfaceMesh, points: &[(&'static str, DVec3)]) -> Vec<VertexId> {
    let mut taken = Vec::new();
    for (_, point) in points {
        let distance = |v: &VertexId| mesh.positions()[*v].distance_squared(*point);
        let free = mesh.vertices().filter(|v| !taken.contains(v));
        taken.extend(free.min_by(|a, b| distance(a).total_cmp(&distance(b))));
    }
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_demo_is_two_spheres_with_distinct_landmarks() {
        for info in list() {
            let demo = build(info.id).unwrap();
            for (mesh, side) in [(&demo.source, 0), (&demo.target, 1)] {
                assert_eq!(mesh.euler_characteristic(), 2, "{}", info.id);
                assert!((1500..15000).contains(&mesh.face_count()), "{}: {}", info.id, mesh.face_count());
                let mut vertices: Vec<_> = demo.landmarks.iter().map(|p| p[side]).collect();
                vertices.sort_unstable();
                vertices.dedup();
                assert_eq!(vertices.len(), demo.labels.len());
            }
            assert_ne!(demo.source.triangles(), demo.target.triangles());
        }
    }
}

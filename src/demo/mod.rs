//! Demos: procedural closed shapes of genus 0, different connectivity on both sides, landmarks known.
//!
//! Animals, a figure and hands are soft parts around a skeleton (`body`, `tube`), whose skin is meshed (`skin`). Of three older
//! demos, pairs of tubes and of balls (`implicit`, `polygonise`), others hold the numbers: they keep their bits.

mod animal;
mod body;
mod clawed;
mod figure;
mod hand;
mod hoofed;
mod human;
mod implicit;
mod polygonise;
mod quadruped;
mod round;
mod shape;
mod skin;
mod tube;

use crate::mesh::{SurfaceMesh, VertexId};
use body::Body;
use glam::DVec3;
use quadruped::Pose;
use shape::{Mark, Shape, skinned};
use skin::Cells;

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

/// The first is what a stranger sees first; the last is mapped quickest.
const DEMOS: [DemoInfo; 10] = [
    DemoInfo {
        id: "horse-camel",
        title: "Horse and camel",
        sentence: "Two animals with hooves; one has a hump and a bent neck",
    },
    DemoInfo { id: "wolf-cow", title: "Wolf and cow", sentence: "Paws and hooves, a bushy tail and a tuft, horns on one side" },
    DemoInfo { id: "cat-lion", title: "Cat and lion", sentence: "Two cats; one has a mane" },
    DemoInfo { id: "horse-gallop", title: "Galloping horse", sentence: "One horse standing and galloping, meshed twice" },
    DemoInfo {
        id: "horse-rearing",
        title: "Rearing horse",
        sentence: "One horse grazing and on its hind legs, meshed twice",
    },
    DemoInfo { id: "figure-running", title: "Runner", sentence: "One figure standing and running, meshed twice" },
    DemoInfo { id: "hands", title: "Two hands", sentence: "One hand open and grasping, meshed twice" },
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

/// Sizes of the cells in which the two sides are meshed: of animals, about 2 long, of a figure 1.8 high, of a hand 1 long.
const ANIMAL: [f64; 2] = [0.0210, 0.0220];
const FIGURE: [f64; 2] = [0.0105, 0.0110];
const HAND: [f64; 2] = [0.0125, 0.0131];

/// Builds a demo by its id.
pub fn build(id: &str) -> Option<Demo> {
    let rest = Pose::default();
    Some(match id {
        "horse-camel" => meshed([hoofed::horse(&rest), hoofed::camel(&rest)], ANIMAL),
        "wolf-cow" => meshed([clawed::wolf(&rest), hoofed::cow(&rest)], ANIMAL),
        "cat-lion" => meshed([clawed::cat(&rest), clawed::lion(&rest)], ANIMAL),
        "horse-gallop" => meshed([hoofed::horse(&rest), hoofed::horse(&hoofed::GALLOP)], ANIMAL),
        "horse-rearing" => meshed([hoofed::horse(&hoofed::GRAZE), hoofed::horse(&hoofed::REAR)], ANIMAL),
        "figure-running" => meshed([human::standing(), human::running()], FIGURE),
        "hands" => meshed([hand::hand(&hand::OPEN), hand::hand(&hand::GRASP)], HAND),
        "horse-cat" => pair(animal::horse(), animal::cat()),
        "poses" => pair(figure::standing(), figure::dancing()),
        "sphere-tetrahedron" => pair(round::sphere(), round::tetrahedron()),
        _ => return None,
    })
}

/// The skins of two bodies, in cells of different sizes and places.
fn meshed([source, target]: [(Body, Vec<Mark>); 2], sizes: [f64; 2]) -> Demo {
    let cells = |k: usize| Cells { size: sizes[k], offset: DVec3::splat(0.4 * k as f64), coarseness: 0.9 };
    pair(skinned(&source, &cells(0)), skinned(&target, &cells(1)))
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

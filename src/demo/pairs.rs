//! The construction of each demo, and the true maps of those that have one.

use super::bend::Bend;
use super::quadruped::Pose;
use super::shape::{MarkedBody, Shape, skinned};
use super::skin::Cells;
use super::{animal, ball_cone, clawed, figure, hand, hoofed, human, round};
use crate::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;

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
    /// The true image of each vertex of the source; it lies on the smooth shape that the target's triangles approximate. `None` where no
    /// map is the true one.
    pub truth: Option<Vec<DVec3>>,
}

// The sizes of the cells in which source and target are meshed: of animals, which are about 2 long, of a figure 1.8 high, and of a hand 1
// long.
const ANIMAL: [f64; 2] = [0.0225, 0.0235];
const FIGURE: [f64; 2] = [0.0105, 0.0110];
const HAND: [f64; 2] = [0.0145, 0.0152];

/// Builds a demo by its id.
pub fn build(id: &str) -> Option<Demo> {
    let rest = Pose::default();
    let demo = match id {
        "horse-camel" => meshed([hoofed::horse(&rest), hoofed::camel(&rest)], ANIMAL),
        "wolf-cow" => meshed([clawed::wolf(&rest), hoofed::cow(&rest)], ANIMAL),
        "cat-lion" => meshed([clawed::cat(&rest), clawed::lion(&rest)], ANIMAL),
        "horse-gallop" => meshed([hoofed::horse(&rest), hoofed::horse(&hoofed::GALLOP)], ANIMAL),
        "horse-turning" => bent(&hoofed::horse(&rest), ANIMAL),
        "horse-rearing" => meshed([hoofed::horse(&hoofed::GRAZE), hoofed::horse(&hoofed::REAR)], ANIMAL),
        "figure-running" => meshed([human::standing(), human::running()], FIGURE),
        "hands" => meshed([hand::hand(&hand::OPEN), hand::hand(&hand::GRASP)], HAND),
        "ball-cone" => pair(ball_cone::ball(), ball_cone::cone()),
        "horse-cat" => pair(animal::horse(), animal::cat()),
        "poses" => pair(figure::standing(), figure::dancing()),
        "sphere-tetrahedron" => pair(round::sphere(), round::tetrahedron()),
        _ => return None,
    };
    let truth = true_map(id).map(|image| demo.source.positions().iter().map(|&p| image(p)).collect());
    Some(Demo { truth, ..demo })
}

/// The bend of a horse that walks on a circle.
const TURN: Bend = Bend { radius: 1.6 };

/// The true map of a demo, which takes a place of the source to a place on the smooth shape that the target's triangles approximate; `None`
/// where no map is the true one.
pub fn true_map(id: &str) -> Option<fn(DVec3) -> DVec3> {
    (id == "horse-turning").then_some(|p| TURN.place(p))
}

/// The skins of two bodies, in cells of different sizes and places.
fn meshed([source, target]: [MarkedBody; 2], sizes: [f64; 2]) -> Demo {
    let [first, second] = cells(sizes);
    pair(skinned(&source, &first), skinned(&target, &second))
}

/// A body and the same body bent, meshed in cells of different sizes and places.
fn bent(body: &MarkedBody, sizes: [f64; 2]) -> Demo {
    let [first, second] = cells(sizes);
    pair(skinned(body, &first), TURN.shape(skinned(body, &second)))
}

fn cells(sizes: [f64; 2]) -> [Cells; 2] {
    [0, 1].map(|k| Cells { size: sizes[k], offset: DVec3::splat(0.4 * k as f64), coarseness: 0.9 })
}

/// Makes a demo of two shapes whose lists have corresponding points at the same positions.
fn pair(source: Shape, target: Shape) -> Demo {
    let [s, t] = [&source, &target].map(|shape| nearest_vertices(&shape.mesh, &shape.points));
    let landmarks = s.into_iter().zip(t).map(|(a, b)| [a.0, b.0]).collect();
    let labels = source.points.iter().map(|(name, _)| (*name).to_owned()).collect();
    Demo { source: source.mesh, target: target.mesh, landmarks, labels, truth: None }
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
    use crate::demo::list;
    use crate::mesh::FaceId;
    use crate::mesh_side::MeshSide;

    const SMALL: [&str; 3] = ["horse-cat", "poses", "sphere-tetrahedron"];

    /// The places of one side's landmarks, by their names.
    struct Places<'a> {
        demo: &'a Demo,
        side: MeshSide,
    }

    impl Places<'_> {
        fn of(&self, name: &str) -> DVec3 {
            let k = self.demo.labels.iter().position(|label| label == name).unwrap();
            self.mesh().positions()[VertexId(self.demo.landmarks[k][self.side])]
        }

        fn mesh(&self) -> &SurfaceMesh {
            [&self.demo.source, &self.demo.target][self.side]
        }
    }

    fn check(id: &str) -> Demo {
        let demo = build(id).unwrap();
        let [faces, marks] =
            if SMALL.contains(&id) { [1500..15_000, 10..22] } else { [20_000..40_000, 21..34] };
        let marks = if id == "ball-cone" { 14..25 } else { marks };
        for (mesh, side) in [&demo.source, &demo.target].into_iter().zip(MeshSide::BOTH) {
            assert_eq!(mesh.euler_characteristic(), 2, "{id}");
            assert!(is_connected(mesh), "{id}");
            assert!(faces.contains(&mesh.face_count()), "{id}: {}", mesh.face_count());
            let mut vertices: Vec<_> = demo.landmarks.iter().map(|p| p[side]).collect();
            vertices.sort_unstable();
            vertices.dedup();
            assert_eq!(vertices.len(), demo.labels.len(), "{id}");
        }
        assert!(marks.contains(&demo.labels.len()), "{id}: {}", demo.labels.len());
        assert_ne!(demo.source.triangles(), demo.target.triangles());
        demo
    }

    fn is_connected(mesh: &SurfaceMesh) -> bool {
        let mut seen = vec![false; mesh.vertex_count()];
        let mut open = vec![VertexId(0)];
        while let Some(v) = open.pop() {
            if !std::mem::replace(&mut seen[v.index()], true) {
                open.extend(mesh.star(v).map(|h| mesh.head(h)));
            }
        }
        seen.into_iter().all(|b| b)
    }

    /// Left and right points are equally far from the middle, and at the same height: at rest bodies are symmetric.
    fn is_symmetric(places: &Places) {
        for name in places.demo.labels.iter().filter_map(|label| label.strip_prefix("left ")) {
            let [left, right] = ["left", "right"].map(|side| places.of(&format!("{side} {name}")));
            assert!(left.z > 0.03, "{name}: {left}");
            assert!(left.distance(right * DVec3::new(1.0, 1.0, -1.0)) < 0.06, "{name}: {left} {right}");
        }
    }

    /// An animal at rest stands on its feet, its nose in front and its tail behind.
    fn stands(places: &Places) {
        let all = places.mesh().positions();
        let lowest = all.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        for foot in ["left fore foot", "right fore foot", "left hind foot", "right hind foot"] {
            assert!(places.of(foot).y - lowest < 0.16, "{foot}");
        }
        let foremost = all.iter().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max);
        assert!(foremost - places.of("nose").x < 0.06);
        assert!(places.of("tail root").x < places.of("left hip").x);
        assert!(places.of("left ear").x < places.of("left eye").x);
        assert!(places.of("left hock").x < places.of("left stifle").x, "a hock bends backwards");
        assert!(places.of("withers").y - places.of("belly").y > 0.35);
    }

    #[test]
    fn small_demos_are_two_spheres_with_distinct_landmarks() {
        for id in SMALL {
            check(id);
        }
    }

    #[test]
    fn species_stand_and_have_what_one_knows_them_by() {
        for id in ["horse-camel", "wolf-cow", "cat-lion"] {
            let demo = check(id);
            for side in MeshSide::BOTH {
                let places = Places { demo: &demo, side };
                stands(&places);
                is_symmetric(&places);
            }
            if id == "horse-camel" {
                let hump = |side| {
                    let places = Places { demo: &demo, side };
                    places.of("back").y - places.of("withers").y.max(places.of("croup").y)
                };
                let [horse, camel] = MeshSide::BOTH.map(hump);
                assert!(horse < 0.0 && camel > 0.25, "{horse} {camel}");
            }
        }
    }

    /// The area of the triangles whose middle is above a height, of the whole.
    fn share_above(mesh: &SurfaceMesh, height: f64) -> f64 {
        let middle = |f: FaceId| mesh.corners(f).iter().map(|p| p.y).sum::<f64>() / 3.0;
        mesh.faces().filter(|&f| middle(f) > height).map(|f| mesh.face_area(f)).sum::<f64>() / mesh.area()
    }

    #[test]
    fn rings_of_landmarks_cut_off_as_much_of_the_ball_as_of_the_cone() {
        let demo = check("ball-cone");
        let [ball, cone] = MeshSide::BOTH.map(|side| Places { demo: &demo, side });
        let highest =
            |places: &Places| places.mesh().positions().iter().map(|p| p.y).fold(f64::MIN, f64::max);
        for places in [&ball, &cone] {
            assert!((places.of("apex").y - highest(places)).abs() < 0.01);
            assert!(places.of("base").length() < 1.01);
        }
        for name in ["upper side 3", "lower side 1", "rim 5"] {
            let [on_ball, on_cone] =
                [&ball, &cone].map(|places| share_above(places.mesh(), places.of(name).y));
            // The cone is rounded, and landmarks are vertices.
            assert!((on_ball - on_cone).abs() < 0.04, "{name}: {on_ball} {on_cone}");
        }
    }

    #[test]
    fn poses_are_the_poses() {
        let demo = check("horse-gallop");
        let [rest, gallop] = MeshSide::BOTH.map(|side| Places { demo: &demo, side });
        let reach = |p: &Places| p.of("left fore foot").x - p.of("left hind foot").x;
        assert!(reach(&gallop) > reach(&rest) + 0.5);
        let demo = check("horse-rearing");
        let [graze, rear] = MeshSide::BOTH.map(|side| Places { demo: &demo, side });
        assert!(graze.of("nose").y < graze.of("left elbow").y);
        assert!(rear.of("left fore foot").y > rear.of("left hind foot").y + 0.6);
        // The torso is rigid: a lowered head takes no landmark of it along.
        for name in ["withers", "left shoulder", "belly"] {
            let [there, here] = [&graze, &rear].map(|p| p.of("chest").distance(p.of(name)));
            assert!((there - here).abs() < 0.12, "{name}: {there} {here}");
        }
        let demo = check("figure-running");
        let [stand, run] = MeshSide::BOTH.map(|side| Places { demo: &demo, side });
        assert!((stand.of("left heel").y - stand.of("right heel").y).abs() < 0.01);
        assert!(run.of("left toes").z - run.of("right toes").z > 0.5);
        let demo = check("hands");
        let [open, grasp] = MeshSide::BOTH.map(|side| Places { demo: &demo, side });
        let gap = |p: &Places| p.of("thumb tip").distance(p.of("middle tip"));
        assert!(gap(&grasp) < 0.7 * gap(&open), "{} {}", gap(&grasp), gap(&open));
    }

    #[test]
    fn the_true_images_lie_on_the_target_and_take_landmarks_to_their_partners() {
        let demo = check("horse-turning");
        let truth = demo.truth.as_ref().unwrap();
        assert_eq!(truth.len(), demo.source.vertex_count());
        for (pair, label) in demo.landmarks.iter().zip(&demo.labels) {
            let partner = demo.target.positions()[VertexId(pair[1])];
            assert!(truth[pair[0] as usize].distance(partner) < 0.05, "{label}");
        }
        let places: Vec<DVec3> = demo.target.positions().iter().copied().collect();
        let longest = demo.target.edges().map(|h| demo.target.length(h)).fold(0.0, f64::max);
        for image in truth.iter().step_by(97) {
            let nearest = places.iter().map(|p| p.distance(*image)).fold(f64::INFINITY, f64::min);
            assert!(nearest < longest, "{image}");
        }
    }

    #[test]
    fn every_demo_of_the_list_is_checked_and_no_other_is_built() {
        let known = [
            "horse-camel",
            "wolf-cow",
            "cat-lion",
            "horse-gallop",
            "horse-turning",
            "horse-rearing",
            "figure-running",
            "hands",
            "ball-cone",
        ];
        let ids: Vec<_> = list().iter().map(|info| info.id).collect();
        assert_eq!(ids, [&known[..], &SMALL[..]].concat());
        assert!(build("teapot").is_none());
    }
}

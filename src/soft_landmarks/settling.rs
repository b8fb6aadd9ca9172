//! The rounds in which soft landmarks are moved.
//!
//! A landmark at a wrong place drags the map around it along, but less with growing distance. So the images of the points around
//! it predict its true place better than the click. In each round a coarse map is made with the landmarks at their present places,
//! and each soft one moves to its image under the affine map that fits its surroundings; after a few rounds the places hardly change.

use super::prediction::predicted;
use crate::coarse_map::class_search::{ClassChoice, ClassSearchOptions, choose_class};
use crate::coarse_map::multilevel::LevelImages;
use crate::coarse_map::{LEAST_PER_LANDMARK, LandmarkedMesh, MultilevelOptions, coarse_levels};
use crate::landmarks::{LandmarkId, MeshSide};
use crate::layout::SearchOptions;
use crate::mesh::closest_point::closest_point;
use crate::mesh::insertion::insert;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step, unless_stopped};
use glam::DVec3;
use typed_index_collections::TiVec;

/// Two meshes with landmarks, some of them soft.
#[derive(Clone, Copy)]
pub struct SettlingInput<'a> {
    /// Source and target.
    pub meshes: [&'a SurfaceMesh; 2],
    /// The points of each landmark on both meshes.
    pub points: &'a [[SurfacePoint; 2]],
    /// The largest distance that each landmark's point on the target may move, in units of the root of the target's area; 0 for a landmark
    /// that is held.
    pub radii: &'a [f64],
    /// Whether a landmark may lie in a face of the target.
    pub may_hold: &'a dyn Fn(FaceId) -> bool,
}

/// Options of the rounds in which soft landmarks are moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettlingOptions {
    /// Coarse maps that are made, at most.
    pub rounds: usize,
    /// The rounds end when no landmark moves by more than this share of its radius.
    pub least_move: f64,
    /// Rings of the coarse level around a landmark from which its place is predicted.
    pub rings: usize,
    /// Options of the coarse maps.
    pub multilevel: MultilevelOptions,
    /// Options of the search for their layouts.
    pub search: SearchOptions,
}

impl Default for SettlingOptions {
    fn default() -> Self {
        // All numbers were chosen by hand: each round costs a coarse map, and wider rings average over more of the map's distortion.
        Self {
            rounds: 6,
            least_move: 0.02,
            rings: 2,
            multilevel: MultilevelOptions { finer: 0, finalists: 2, ..MultilevelOptions::default() },
            search: SearchOptions { candidates: 2, twists: 2, ..SearchOptions::default() },
        }
    }
}

/// The places of the landmarks after the last round.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// The point of each landmark on the target.
    pub places: Vec<SurfacePoint>,
    /// The distance of each of these points from the given one, in units of the root of the target's area.
    pub moved: Vec<f64>,
    /// Coarse maps that were made.
    pub rounds: usize,
}

/// Moves the target's points of soft landmarks to the places that coarse maps predict. Where no coarse map is found they stay.
///
/// # Errors
/// [`Cancelled`].
pub fn settle(
    input: SettlingInput<'_>,
    options: &SettlingOptions,
    monitor: &mut dyn Monitor,
) -> Result<Settled, Cancelled> {
    let [_, target] = input.meshes;
    let given: Vec<SurfacePoint> = input.points.iter().map(|ends| ends[1]).collect();
    let soft: Vec<usize> = (0..given.len()).filter(|&i| input.radii[i] > 0.0).collect();
    let scale = 1.0 / target.area().sqrt();
    let mut places = given.clone();
    let mut rounds = 0;
    while rounds < options.rounds && !soft.is_empty() && !monitor.wants_result() {
        let share = |round: usize| round as f64 / options.rounds as f64;
        let part = &mut Portion::new(monitor, share(rounds), share(rounds + 1));
        let Some(seen) = coarse(input, &places, options, part)? else { break };
        rounds += 1;
        let mut farthest: f64 = 0.0;
        for &i in &soft {
            // Each goes over all faces of the target.
            part.step(Step { fraction: 1.0, residual: None })?;
            let Some(next) = seen.place(i.into(), options.rings) else { continue };
            let next = next.within(input, i, given[i], scale);
            let from = places[i].position(target);
            if (input.may_hold)(next.face) {
                farthest = farthest.max(from.distance(next.position(target)) * scale / input.radii[i]);
                places[i] = next;
            }
        }
        if farthest < options.least_move {
            break;
        }
    }
    let distance = |(a, b): (&SurfacePoint, &SurfacePoint)| a.position(target).distance(b.position(target));
    let moved = places.iter().zip(&given).map(|pair| scale * distance(pair)).collect();
    Ok(Settled { places, moved, rounds })
}

/// The predicted place of a landmark near the target's surface, whose area is 1.
struct PredictedPlace {
    place: DVec3,
    /// A normal of the surface nearby, of any length.
    normal: DVec3,
}

impl PredictedPlace {
    /// The point of the target nearest to the place, or, where that is farther from the given point than the landmark's radius, a point
    /// within it in the same direction.
    fn within(self, input: SettlingInput<'_>, i: usize, given: SurfacePoint, scale: f64) -> SurfacePoint {
        let (target, radius) = (input.meshes[1], input.radii[i] / scale);
        let centre = given.position(target);
        let nearest = closest_point(target, self.place / scale, self.normal);
        let way = nearest.position(target) - centre;
        if way.length() <= radius {
            return nearest;
        }
        // A little inside, since the surface bends.
        closest_point(target, centre + way * (0.98 * radius / way.length()), self.normal)
    }
}

/// A coarse map with its landmarks.
struct Seen {
    images: LevelImages,
    /// The vertex of each landmark on the coarse level of each mesh.
    landmarks: [TiVec<LandmarkId, VertexId>; 2],
}

impl Seen {
    /// The place of a landmark that the map of its surroundings predicts; `None` where they are too few.
    fn place(&self, landmark: LandmarkId, rings: usize) -> Option<PredictedPlace> {
        let [source, target] = &self.images.levels;
        let own = self.landmarks[0][landmark];
        let around = surroundings(&source.mesh, own, rings);
        let points: Vec<DVec3> = around.iter().map(|&v| source.mesh.positions()[v]).collect();
        let image = |v: &VertexId| self.images.target_from_source[*v].position(&target.mesh);
        let images: Vec<DVec3> = around.iter().map(image).collect();
        let place = predicted(source.mesh.positions()[own], &points, &images)?;
        let faces = target.mesh.star(self.landmarks[1][landmark]).map(|h| target.mesh.corners(h.face()));
        let normal = faces.map(|[a, b, c]| (b - a).cross(c - a)).sum();
        Some(PredictedPlace { place, normal })
    }
}

/// The vertices at most `rings` edges away from a vertex, without the vertex itself.
fn surroundings(mesh: &SurfaceMesh, centre: VertexId, rings: usize) -> Vec<VertexId> {
    let mut found = vec![centre];
    let mut ring = 0..1;
    for _ in 0..rings {
        let end = found.len();
        for k in ring {
            for v in mesh.star(found[k]).map(|h| mesh.head(h)).collect::<Vec<_>>() {
                if !found.contains(&v) {
                    found.push(v);
                }
            }
        }
        ring = end..found.len();
    }
    found.split_off(1)
}

/// Makes the coarse map with the landmarks at these places of the target; `None` where there is none.
fn coarse(
    input: SettlingInput<'_>,
    places: &[SurfacePoint],
    options: &SettlingOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<Seen>, Cancelled> {
    let sources: Vec<SurfacePoint> = input.points.iter().map(|ends| ends[0]).collect();
    let side = |k: usize, points: &[SurfacePoint]| {
        let inserted = insert(input.meshes[k], points).ok()?;
        LandmarkedMesh::new(&inserted.mesh, &inserted.vertices).ok()
    };
    let (Some(source), Some(target)) = (side(0, &sources), side(1, places)) else { return Ok(None) };
    let full = [source, target];
    if full.iter().any(|mesh| has_one_twice(&mesh.landmarks.raw)) {
        return Ok(None);
    }
    let SettlingOptions { multilevel, search, .. } = options;
    let goal = multilevel.coarse_vertices.max(LEAST_PER_LANDMARK * places.len());
    let levels = coarse_levels(&full, goal, multilevel.rims, &mut Portion::new(monitor, 0.0, 0.1))?;
    let class = ClassSearchOptions { multilevel, search, choice: ClassChoice::Best };
    let chosen = unless_stopped(choose_class(&levels, class, &mut Portion::new(monitor, 0.1, 0.7).unseen()))?;
    let Some(mut map) = chosen.map(|chosen| chosen.map) else { return Ok(None) };
    let finished = unless_stopped(map.finish(multilevel, &mut Portion::new(monitor, 0.7, 1.0)))?;
    let Some(images) = finished.and_then(|()| map.images()) else { return Ok(None) };
    let landmarks =
        MeshSide::BOTH.map(|side| images.landmarks_of(side, &full[side]).iter().copied().collect());
    Ok(Some(Seen { images, landmarks }))
}

/// Whether two landmarks have met at one vertex.
fn has_one_twice(vertices: &[VertexId]) -> bool {
    let mut sorted = vertices.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).any(|pair| pair[0] == pair[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rigid3::small_turn;
    use crate::math::scalar::sin;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    /// A bent ball, and the same one turned, of other triangles: every point has a partner that is known, and the map between partners
    /// is the one of least distortion.
    struct Bodies {
        source: SurfaceMesh,
        target: SurfaceMesh,
        points: Vec<[SurfacePoint; 2]>,
    }

    const WRONG: usize = 3;

    fn bent(p: DVec3) -> DVec3 {
        DVec3::new(1.5 * p.x, p.y + 0.2 * p.x * p.x, p.z * (1.0 + 0.15 * sin(2.0 * p.y)))
    }

    fn turned(p: DVec3) -> DVec3 {
        small_turn(DVec3::new(0.5, -1.0, 0.3)) * p
    }

    /// With the vertices of an icosahedron as landmarks; one of them is `off` away from its place on the target.
    fn bodies(off: DVec3) -> Bodies {
        let (ball, other) = (icosphere(4), icosphere(3));
        let source = ball.with_positions(ball.positions().iter().map(|&p| bent(p)).collect());
        let target = other.with_positions(other.positions().iter().map(|&p| turned(bent(p))).collect());
        let directions: Vec<DVec3> = icosphere(0).positions().iter().copied().collect();
        let pair = |(k, &p): (usize, &DVec3)| {
            let away = if k == WRONG { off } else { DVec3::ZERO };
            [closest_point(&source, bent(p), p), closest_point(&target, turned(bent(p) + away), turned(p))]
        };
        let points = directions.iter().enumerate().map(pair).collect();
        Bodies { source, target, points }
    }

    fn settled(bodies: &Bodies, radius: f64) -> Settled {
        let mut radii = vec![0.0; bodies.points.len()];
        radii[WRONG] = radius;
        let Bodies { source, target, points } = bodies;
        let input = SettlingInput { meshes: [source, target], points, radii: &radii, may_hold: &|_| true };
        settle(input, &SettlingOptions::default(), &mut Silent).unwrap()
    }

    /// The distance between a place and the true place of the landmark that was clicked beside it, relative to the root of the area.
    fn miss(bodies: &Bodies, place: SurfacePoint) -> f64 {
        let right = turned(bodies.points[WRONG][0].position(&bodies.source));
        place.position(&bodies.target).distance(right) / bodies.target.area().sqrt()
    }

    #[test]
    fn a_click_beside_its_place_comes_back_and_the_others_stay() {
        for off in [DVec3::new(0.1, 0.1, 0.1), DVec3::new(-0.15, 0.1, -0.1), DVec3::new(0.0, -0.2, 0.1)] {
            let bodies = bodies(off);
            let before = miss(&bodies, bodies.points[WRONG][1]);
            let settled = settled(&bodies, 0.1);
            let after = miss(&bodies, settled.places[WRONG]);
            assert!(after < 0.35 * before, "{before} {after}");
            for (k, (place, given)) in settled.places.iter().zip(&bodies.points).enumerate() {
                assert_eq!(*place == given[1], k != WRONG);
            }
        }
    }

    #[test]
    fn a_landmark_never_leaves_its_radius() {
        let bodies = bodies(DVec3::new(0.0, -0.3, 0.2));
        for radius in [0.002, 0.01, 0.03] {
            let settled = settled(&bodies, radius);
            assert!(
                settled.moved[WRONG] <= radius && settled.moved[WRONG] > 0.5 * radius,
                "{:?}",
                settled.moved
            );
        }
    }

    #[test]
    fn without_soft_landmarks_nothing_is_computed() {
        let bodies = bodies(DVec3::ZERO);
        let settled = settled(&bodies, 0.0);
        assert_eq!(settled.rounds, 0);
        assert!(settled.moved.iter().all(|moved| *moved == 0.0));
    }
}

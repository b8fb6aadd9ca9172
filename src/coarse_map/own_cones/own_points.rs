//! The program's own points: their choice on the source, and their insertion with their images as landmarks after the user's.

use crate::coarse_map::LandmarkedMesh;
use crate::coarse_map::multilevel::LevelImages;
use crate::geodesic::distances;
use crate::landmark_suggestion::{Spread, farthest_points};
use crate::landmarks::MeshSide;
use crate::mesh::closest_point::closest_point;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec3;

/// Least distance of an own point from all others; the area is 1. 36 points spread evenly are 0.17 apart, so it only keeps points from
/// meeting on limbs. Chosen by hand.
const LEAST_DISTANCE: f64 = 0.03;

/// Least distance of a round's points from those of the round before, which are so free to move; the area is 1. With larger distances a
/// round misses the ends of limbs, where those before were, and its maps are worse by a tenth to a half: so it is about the length of the
/// coarse level's edges. Chosen by hand.
const APART: f64 = 0.05;

/// An own point is moved onto a side of its face where a barycentric coordinate is below this: its exact place does not matter, and a
/// needle would distort. Chosen by hand.
const SNAP: f64 = 0.15;

/// A point of the program's own, to be a landmark.
#[derive(Clone, Copy, Debug)]
pub struct OwnPair {
    /// A vertex of the source with the user's landmarks.
    pub source: VertexId,
    /// Its image on the target with the user's landmarks.
    pub target: SurfacePoint,
}

/// The own points that a round may take.
pub(super) struct PointChoice<'a> {
    /// Number of points, at most, but for further ones.
    pub count: usize,
    /// Number of points, at most, with further ones.
    pub most: usize,
    /// Further points are at least this far from all others; the area is 1.
    pub gap: f64,
    /// Whether a vertex of the source level may be taken.
    pub may: &'a dyn Fn(VertexId) -> bool,
}

/// Chooses points of the source, far from the landmarks and from each other and not at those of the round before, with their images on the
/// target.
pub(super) fn pairs(
    full: &[LandmarkedMesh; 2],
    images: &LevelImages,
    before: &[VertexId],
    choice: PointChoice<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Vec<OwnPair>, Cancelled> {
    let [source, target] = &images.levels;
    let weights = images.weights();
    let mesh = &source.mesh;
    let user = images.landmarks_of(MeshSide::Source, &full[0]);
    let mut free = vec![true; mesh.vertex_count()];
    user.iter().for_each(|&v| free[v.index()] = false);
    let before: Vec<VertexId> = before.iter().filter_map(|v| source.vertices.binary_search(v).ok()).collect();
    if !before.is_empty() {
        let near = distances(mesh, &before);
        mesh.vertices().filter(|&v| near[v] < APART).for_each(|v| free[v.index()] = false);
    }
    mesh.vertices().filter(|&v| !weights[0].is_on_skin(mesh, v)).for_each(|v| free[v.index()] = false);
    // The vertices that the round before inserted around its own points are not in the mesh with the user's landmarks alone.
    let known = full[0].refined.mesh.vertex_count();
    mesh.vertices().filter(|&v| source.vertices[v].index() >= known).for_each(|v| free[v.index()] = false);
    let may = |v: VertexId| free[v.index()] && (choice.may)(v);
    let first = Spread { count: choice.count, least_distance: LEAST_DISTANCE };
    let mut chosen = farthest_points(mesh, distances(mesh, user), first, may, monitor)?;
    if choice.most > chosen.len() {
        let from_all = distances(mesh, &[user, &chosen[..]].concat());
        let further = Spread { count: choice.most - chosen.len(), least_distance: choice.gap };
        chosen.extend(farthest_points(mesh, from_all, further, may, monitor)?);
    }
    let mut places: Vec<DVec3> =
        full[1].landmarks.iter().map(|&v| full[1].refined.mesh.positions()[v]).collect();
    let mut pairs = Vec::new();
    for v in chosen {
        // Each goes over all faces of the target.
        monitor.step(Step::default())?;
        let image = images.target_from_source[v];
        let place = image.position(&target.mesh);
        if !is_apart(&places, place) || !weights[1].is_skin(image.face) {
            continue;
        }
        let [a, b, c] = target.mesh.corners(image.face);
        let point = snapped(closest_point(&full[1].refined.mesh, place, (b - a).cross(c - a)));
        // A coarse face of skin may have some cap under it.
        if !full[1].weights().is_skin(point.face) {
            continue;
        }
        places.push(place);
        pairs.push(OwnPair { source: source.vertices[v], target: point });
    }
    Ok(pairs)
}

/// The pairs that lie apart from all landmarks and from each other on both meshes.
pub(super) fn apart(full: &[LandmarkedMesh; 2], pairs: &[OwnPair]) -> Vec<OwnPair> {
    let meshes = full.each_ref().map(|side| &side.refined.mesh);
    let mut taken: [Vec<DVec3>; 2] = MeshSide::BOTH
        .map(|side| full[side].landmarks.iter().map(|&v| meshes[side].positions()[v]).collect());
    let mut is_free = |pair: &&OwnPair| {
        let places = [meshes[0].positions()[pair.source], pair.target.position(meshes[1])];
        let is_free = MeshSide::BOTH.iter().all(|&side| is_apart(&taken[side], places[side]));
        if is_free {
            MeshSide::BOTH.iter().for_each(|&side| taken[side].push(places[side]));
        }
        is_free
    };
    pairs.iter().filter(|pair| is_free(pair)).copied().collect()
}

/// Whether a place is far enough from those that are taken.
fn is_apart(taken: &[DVec3], place: DVec3) -> bool {
    taken.iter().all(|p| p.distance(place) >= LEAST_DISTANCE)
}

/// The point moved onto a corner or a side that is near, so that no needles are made.
fn snapped(point: SurfacePoint) -> SurfacePoint {
    SurfacePoint::clamped(point.face, point.barycentric.map(|w| if w < SNAP { 0.0 } else { w }))
}

/// Both meshes with the pairs as landmarks after the user's; `None` where there are no pairs.
pub(super) fn with(
    inputs: [&SurfaceMesh; 2],
    full: &[LandmarkedMesh; 2],
    pairs: &[OwnPair],
    monitor: &mut dyn Monitor,
) -> Result<Option<[LandmarkedMesh; 2]>, Cancelled> {
    if pairs.is_empty() {
        return Ok(None);
    }
    let at = |pair: &OwnPair| SurfacePoint::at_vertex(&full[0].refined.mesh, pair.source);
    let points: [Vec<SurfacePoint>; 2] =
        [pairs.iter().map(at).collect(), pairs.iter().map(|pair| pair.target).collect()];
    let mut placed = |side: MeshSide| {
        let with_points = full[side].with_points(inputs[side], &points[side]);
        let Ok((mesh, vertices)) = with_points else { return Ok(None) };
        monitor.step(Step::default())?;
        let mesh = mesh.with_room_around(inputs[side], &vertices);
        monitor.step(Step::default())?;
        Ok(mesh.ok().map(|mesh| (mesh, vertices)))
    };
    let both = (placed(MeshSide::Source)?, placed(MeshSide::Target)?);
    let (Some((mut source, from)), Some((mut target, onto))) = both else { return Ok(None) };
    for (s, t) in from.into_iter().zip(onto) {
        if !target.landmarks.contains(&t) {
            source.push_landmark(s);
            target.push_landmark(t);
        }
    }
    Ok(Some([source, target]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::coarsening::Level;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    #[test]
    fn pairs_apart_meet_neither_landmarks_nor_each_other_on_either_mesh() {
        let ball = icosphere(5);
        let beside = |d: DVec3| {
            let off = |v: &VertexId| ball.positions()[*v].distance(d.normalize());
            ball.vertices().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
        };
        // The ball of area 1 has a radius of .28, on which an edge is .01 long.
        let landmarks = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_ONE].map(beside);
        let full = [0, 1].map(|_| LandmarkedMesh::new(&ball, &landmarks).unwrap());
        let mesh = &full[1].refined.mesh;
        let pair = |from: DVec3, onto: DVec3| OwnPair {
            source: beside(from),
            target: SurfacePoint::at_vertex(mesh, beside(onto)),
        };
        let near = |d: DVec3| d + DVec3::new(0.04, -0.03, 0.02);
        let [a, b, c] = [DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let given =
            [pair(a, b), pair(near(a), c), pair(c, near(b)), pair(near(DVec3::X), a), pair(b, DVec3::Y)];
        let kept = |given: &[OwnPair]| -> Vec<VertexId> {
            apart(&full, given).iter().map(|pair| pair.source).collect()
        };
        assert_eq!(kept(&given), [beside(a)]);
        // A pair that is not kept takes no place.
        assert_eq!(kept(&[pair(near(DVec3::X), a), pair(b, near(a))]), [beside(b)]);
    }

    /// Both ends of a long body are taken in every round, and no point twice.
    #[test]
    fn the_points_of_the_next_round_lie_beside_those_of_the_round_before() {
        let ball = icosphere(4);
        let long = DVec3::new(0.2, 0.2, 1.0);
        let mesh = ball.with_positions(ball.positions().iter().map(|p| *p * long).collect());
        let along = |v: &VertexId| mesh.positions()[*v].z;
        let ends = [
            mesh.vertices().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap(),
            mesh.vertices().min_by(|a, b| along(a).total_cmp(&along(b))).unwrap(),
        ];
        let beside = |d: DVec3| {
            let off = |v: &VertexId| mesh.positions()[*v].distance(0.2 * d);
            mesh.vertices().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
        };
        let landmarks = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y].map(beside);
        let full = [0, 1].map(|_| LandmarkedMesh::new(&mesh, &landmarks).unwrap());
        let surface = &full[0].refined.mesh;
        let images = LevelImages::of_itself(&Level::coarse(surface, &landmarks, 600, &mut Silent).unwrap())
            .with_landmarks([&landmarks, &landmarks]);
        let mut before: Vec<VertexId> = Vec::new();
        for round in 0..4 {
            let choice = PointChoice { count: 12, most: 12, gap: 1.0, may: &|_| true };
            let found: Vec<VertexId> = pairs(&full, &images, &before, choice, &mut Silent)
                .unwrap()
                .iter()
                .map(|p| p.source)
                .collect();
            assert!(found.len() > 8, "round {round} has {} points", found.len());
            let near = distances(surface, &found);
            assert!(ends.iter().all(|&end| near[end] < 2.5 * APART), "round {round} misses an end");
            assert!(before.iter().all(|&v| near[v] > 0.8 * APART), "round {round} has a point again");
            before = found;
        }
    }
}

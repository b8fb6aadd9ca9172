//! Images of the source's vertices on the target guessed from their distances to the landmarks alone, without a map.
//!
//! With few landmarks the class of a map is hard to judge: a limb that is turned once costs little, and a map that begins with it
//! carries the program's own points along. Distances along the surface do not depend on a map. They hardly change from pose to pose,
//! and tell the outside of a limb from its inside, so own points that are placed by them may lead to a better class.

use crate::geodesic::distances;
use crate::math::scalar::min;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::TiVec;

/// The guessed image of a vertex of the source.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    /// The vertex of the target whose distances to the landmarks are the most like its own.
    pub vertex: VertexId,
    /// Whether that vertex's own guess on the source is near, and no place elsewhere on the target fits nearly as well.
    pub is_trusted: bool,
}

/// A guess is trusted only where the guess back from it is within this distance of the vertex; the area is 1. Edges of a level with
/// 500 vertices are 0.05 to 0.1 long. Chosen by hand.
const RETURNS_WITHIN: f64 = 0.06;

/// Points farther from each other than this are at different places; the area is 1. Half the width of a body's trunk; chosen by hand.
const ELSEWHERE: f64 = 0.15;

/// A guess is clear where the misfit is this many times as large everywhere else. Chosen by hand.
const CLEARLY_WORSE: f64 = 2.0;

/// Misfits that differ by less than this for each landmark count as equal: the square of a relative difference of 0.01. Chosen by hand.
const ROUNDING: f64 = 1e-4;

/// Guesses the image of each vertex of the source from the distances of both meshes' vertices to the landmarks.
///
/// Both meshes are coarse levels of area 1, with their landmarks in the same order.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn guess(
    meshes: [&SurfaceMesh; 2],
    landmarks: [&[VertexId]; 2],
    monitor: &mut dyn Monitor,
) -> Result<TiVec<VertexId, Guess>, Cancelled> {
    let [source, target] = meshes;
    let fields = [fields(source, landmarks[0], monitor)?, fields(target, landmarks[1], monitor)?];
    let onto = nearest(source, target, [&fields[0], &fields[1]], monitor)?;
    let back = nearest(target, source, [&fields[1], &fields[0]], monitor)?;
    let places = source.positions();
    let trusted = |(v, Nearest { vertex, is_clear }): (VertexId, &Nearest)| {
        let returns = places[back[*vertex].vertex].distance(places[v]) < RETURNS_WITHIN;
        Guess { vertex: *vertex, is_trusted: *is_clear && returns }
    };
    Ok(onto.iter_enumerated().map(trusted).collect())
}

/// The distances of each vertex to all landmarks.
type Fields = TiVec<VertexId, Vec<f64>>;

fn fields(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<Fields, Cancelled> {
    let mut fields: Fields = mesh.vertices().map(|_| Vec::with_capacity(landmarks.len())).collect();
    for landmark in landmarks {
        monitor.step(Step::default())?;
        let distance = distances(mesh, &[*landmark]);
        fields.iter_mut().zip(&distance).for_each(|(field, d)| field.push(*d));
    }
    Ok(fields)
}

/// The vertex of least misfit.
#[derive(Clone, Copy)]
struct Nearest {
    vertex: VertexId,
    /// Whether no place elsewhere fits nearly as well.
    is_clear: bool,
}

/// For each vertex of `from` the vertex of `onto` of least misfit.
fn nearest(
    from: &SurfaceMesh,
    onto: &SurfaceMesh,
    fields: [&Fields; 2],
    monitor: &mut dyn Monitor,
) -> Result<TiVec<VertexId, Nearest>, Cancelled> {
    let places = onto.positions();
    let mut found = TiVec::with_capacity(from.vertex_count());
    let mut misfits: TiVec<VertexId, f64> = TiVec::with_capacity(onto.vertex_count());
    for field in fields[0] {
        monitor.step(Step::default())?;
        misfits.clear();
        misfits.extend(fields[1].iter().map(|other| misfit(field, other)));
        let vertex =
            onto.vertices().min_by(|a, b| misfits[*a].total_cmp(&misfits[*b])).unwrap_or(VertexId(0));
        let rivals = onto.vertices().filter(|v| places[*v].distance(places[vertex]) > ELSEWHERE);
        let rival = rivals.map(|v| misfits[v]).fold(f64::INFINITY, min);
        let limit = CLEARLY_WORSE * misfits[vertex] + ROUNDING * field.len() as f64;
        found.push(Nearest { vertex, is_clear: rival > limit });
    }
    Ok(found)
}

/// The sum of the squared relative differences of distances: near landmarks count more than far ones.
fn misfit(a: &[f64], b: &[f64]) -> f64 {
    let square = |(a, b): (&f64, &f64)| {
        let relative = (a - b) / (a + b).max(f64::MIN_POSITIVE);
        relative * relative
    };
    a.iter().zip(b).map(square).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use glam::{DQuat, DVec3};

    /// An ellipsoid of area 1 with vertices that mirrors across the coordinate planes exchange.
    fn ellipsoid(axes: DVec3) -> SurfaceMesh {
        let ball = icosphere(3);
        let mesh = ball.with_positions(ball.positions().iter().map(|p| *p * axes).collect());
        let scale = mesh.area().sqrt().recip();
        mesh.with_positions(mesh.positions().iter().map(|p| *p * scale).collect())
    }

    /// The vertices that are the farthest in some directions.
    fn farthest(mesh: &SurfaceMesh, directions: &[DVec3]) -> Vec<VertexId> {
        let at = |d: &DVec3| {
            let along = |v: &VertexId| mesh.positions()[*v].dot(*d);
            mesh.vertices().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap()
        };
        directions.iter().map(at).collect()
    }

    #[test]
    fn vertices_of_a_turned_copy_find_themselves() {
        let mesh = ellipsoid(DVec3::new(1.0, 0.7, 0.5));
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 1.1, -2.0);
        let copy = mesh.with_positions(mesh.positions().iter().map(|p| turn * *p).collect());
        let directions = [DVec3::X, DVec3::Y, DVec3::new(-0.6, 0.3, 0.7), DVec3::new(-0.2, -0.9, 0.3)];
        let landmarks = farthest(&mesh, &directions);
        let found = guess([&mesh, &copy], [&landmarks, &landmarks], &mut Silent).unwrap();
        assert!(found.iter_enumerated().all(|(v, guess)| guess.vertex == v && guess.is_trusted));
    }

    #[test]
    fn left_and_right_of_landmarks_on_the_plane_of_symmetry_are_not_trusted() {
        let source = ellipsoid(DVec3::new(1.0, 0.7, 0.5));
        let target = ellipsoid(DVec3::new(1.0, 0.8, 0.45));
        let directions = [DVec3::X, DVec3::Z, DVec3::new(-0.8, 0.0, 0.6), DVec3::new(-0.5, 0.0, -0.7)];
        let landmarks = [&source, &target].map(|mesh| farthest(mesh, &directions));
        assert!(landmarks.iter().flatten().all(|v| source.positions()[*v].y.abs() < 1e-12));
        let found = guess([&source, &target], [&landmarks[0], &landmarks[1]], &mut Silent).unwrap();
        let is_beside = |v: VertexId| target.positions()[found[v].vertex].y.abs() > 0.5 * ELSEWHERE;
        let beside: Vec<VertexId> = source.vertices().filter(|v| is_beside(*v)).collect();
        assert!(beside.len() > source.vertex_count() / 3);
        assert!(beside.iter().all(|v| !found[*v].is_trusted));
        // A landmark beside the plane tells them apart.
        let directions = [&directions[..], &[DVec3::new(-0.1, 0.9, 0.2)]].concat();
        let landmarks = [&source, &target].map(|mesh| farthest(mesh, &directions));
        let found = guess([&source, &target], [&landmarks[0], &landmarks[1]], &mut Silent).unwrap();
        let trusted: Vec<VertexId> = source.vertices().filter(|v| found[*v].is_trusted).collect();
        assert!(trusted.len() > source.vertex_count() / 3);
        let apart = |v: VertexId| target.positions()[found[v].vertex].distance(source.positions()[v]);
        assert!(trusted.iter().all(|v| apart(*v) < 2.0 * ELSEWHERE));
    }
}

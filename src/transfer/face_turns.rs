//! Turns of a mesh's faces that agree from face to face.
//!
//! A rotation tells its turn but for whole turns. Along a limb that is turned by more than half a turn the turns have to go on growing, or
//! half of the limb would come by the other way round. So turns are chosen face by face along a tree, each the one nearest to that of
//! the face before. The tree grows over the edges whose faces' rotations are most alike (Prim), and begins where the least is turned: a
//! face that stands on its head among others, as folds and slivers do, becomes a leaf and leads nobody astray.

use crate::math::min_queue::MinQueue;
use crate::math::rigid3::{polar_rotation, turn_of, turned_by};
use crate::mesh::{FaceId, SurfaceMesh};
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A turn shorter than this tells no axis.
const NO_AXIS: f64 = 1e-9;

/// The cost of an edge to a face without a rotation: more than that of any other, which is at most 2.
const LAST: f64 = 3.0;

/// The turn of every face of a mesh, axis by radians, from its gradient. A gradient that has no rotation gets the turn of the face before
/// it.
pub fn face_turns(mesh: &SurfaceMesh, gradients: &TiSlice<FaceId, DMat3>) -> TiVec<FaceId, DVec3> {
    let rotations: TiVec<FaceId, Option<DMat3>> = gradients.iter().map(polar_rotation).collect();
    let mut turns: TiVec<FaceId, DVec3> = ti_vec![DVec3::ZERO; mesh.face_count()];
    let mut is_done: TiVec<FaceId, bool> = ti_vec![false; mesh.face_count()];
    let mut queue: MinQueue<(FaceId, FaceId)> = MinQueue::default();
    let Some(first) = least_turned(&rotations) else { return turns };
    queue.push(0.0, (first, first), ());
    while let Some(next) = queue.pop() {
        let (face, before) = next.key;
        if is_done[face] {
            continue;
        }
        is_done[face] = true;
        turns[face] =
            rotations[face].map_or(turns[before], |rotation| nearest_turn(&rotation, turns[before]));
        for h in face.halfedges() {
            let other = mesh.twin(h).face();
            if !is_done[other] {
                // Alike are those whose faces turn alike; a face without a rotation turns as that before it.
                let own = rotations[face].unwrap_or_else(|| turned_by(turns[face]));
                let cost = rotations[other].map_or(LAST, |rotation| unlikeness(&own, &rotation));
                queue.push(cost, (other, face), ());
            }
        }
    }
    turns
}

/// The face with the smallest turn.
fn least_turned(rotations: &TiSlice<FaceId, Option<DMat3>>) -> Option<FaceId> {
    let sizes =
        rotations.iter_enumerated().filter_map(|(f, r)| Some((f, unlikeness(&DMat3::IDENTITY, r.as_ref()?))));
    sizes.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(f, _)| f)
}

/// One minus the cosine of the angle between two rotations.
fn unlikeness(a: &DMat3, b: &DMat3) -> f64 {
    let cosine = 0.5 * ((0..3).map(|k| a.col(k).dot(b.col(k))).sum::<f64>() - 1.0);
    1.0 - cosine
}

/// The turn that is nearest to another turn, among those that give a rotation.
fn nearest_turn(rotation: &DMat3, other: DVec3) -> DVec3 {
    let turn = turn_of(rotation);
    let angle = turn.length();
    let axis = if angle > NO_AXIS { turn / angle } else { other.normalize_or_zero() };
    axis * (angle + TAU * ((axis.dot(other) - angle) / TAU).round())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_go_on_where_rotations_come_back() {
        let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        let mut turn = DVec3::ZERO;
        for k in 0..60 {
            let wanted = axis * (0.2 * f64::from(k));
            turn = nearest_turn(&turned_by(wanted), turn);
            assert!(turn.distance(wanted) < 1e-9, "{k}: {turn}");
        }
    }
}

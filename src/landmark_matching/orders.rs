//! The agreement of two bodies in the orders in which shortest paths lead to their marks.

use super::agreement::turns_left;
use super::shape::{Mark, Shape};
use crate::landmarks::MeshSide;

/// Shares of the cyclic orders of three marks around a fourth, 0 to 1. An order that small changes of the lengths reverse says nothing, and
/// is part of neither.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orders {
    /// The share that is the same on both bodies.
    pub(super) kept: f64,
    /// The share that is reversed.
    pub(super) reversed: f64,
}

/// The orders that are kept and reversed; none where there are fewer than four pairs.
pub(super) fn orders(shapes: [&Shape; 2], pairs: &[[usize; 2]]) -> Orders {
    let (mut kept, mut reversed, mut all) = (0_u32, 0_u32, 0_u32);
    for (root, of) in pairs.iter().enumerate() {
        let marks = MeshSide::BOTH.map(|side| &shapes[side].marks[of[side]]);
        let others: Vec<[usize; 2]> =
            pairs.iter().enumerate().filter(|(k, _)| *k != root).map(|(_, pair)| *pair).collect();
        for (i, a) in others.iter().enumerate() {
            for (j, b) in others[..i].iter().enumerate() {
                for c in &others[..j] {
                    all += 1;
                    let [source, target] =
                        MeshSide::BOTH.map(|side| turn(marks[side], [a[side], b[side], c[side]]));
                    if let (Some(source), Some(target)) = (source, target) {
                        *if source == target { &mut kept } else { &mut reversed } += 1;
                    }
                }
            }
        }
    }
    let share = |count: u32| f64::from(count) / f64::from(all.max(1));
    Orders { kept: share(kept), reversed: share(reversed) }
}

/// The order of three marks around a root: whether it is counter-clockwise; `None` where the body and its images differ.
fn turn(root: &Mark, marks: [usize; 3]) -> Option<bool> {
    let mut turns = root.ranks.iter().map(|ranks| turns_left(marks.map(|mark| ranks[mark])));
    let first = turns.next()?;
    turns.all(|turn| turn == first).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{ball_with_ends, four_footed, shape};
    use super::*;
    use glam::DVec3;

    /// The pairs of each tip with itself.
    fn own(shape: &Shape) -> Vec<[usize; 2]> {
        shape.tips().map(|k| [k; 2]).collect()
    }

    #[test]
    fn feet_on_one_side_of_a_body_have_orders_that_its_mirror_image_reverses() {
        let body = shape(&four_footed());
        let image = body.mirrored().unwrap();
        let same = orders([&body, &body], &own(&body));
        assert!(same.kept > 0.75 && same.reversed == 0.0, "{same:?}");
        let turned = orders([&body, &image], &own(&body));
        assert_eq!([turned.kept, turned.reversed], [same.reversed, same.kept]);
    }

    #[test]
    fn ends_in_the_plane_of_a_flat_body_have_no_orders() {
        // Arms, legs and a head around the rim of a cushion; shortest paths go over either side.
        let ends = [(0.0, 1.0), (0.9, 0.45), (-0.9, 0.45), (0.6, -0.8), (-0.6, -0.8)];
        let ends: Vec<(DVec3, f64)> = ends.iter().map(|&(x, y)| (DVec3::new(x, y, 0.0), 2.0)).collect();
        let ball = ball_with_ends(&ends, 40.0);
        let flat =
            ball.with_positions(ball.positions().iter().map(|p| *p * DVec3::new(1.0, 1.0, 0.4)).collect());
        let body = shape(&flat);
        assert!(own(&body).len() >= 5);
        let found = orders([&body, &body], &own(&body));
        assert!(found.kept < 0.5, "{found:?}");
    }
}

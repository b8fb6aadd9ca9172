//! Assignments turned about an end: an octopus looks much the same from each of its arms, so that all of them may be taken to the next one.

use super::search::{Assignment, Tables};
use crate::landmarks::MeshSide;

/// Limbs around an end that are turned, at least.
const LEAST: usize = 4;
/// A turned assignment is judged where it costs less than this more: those of octopuses and starfishes cost up to 0.065 more, those of hands
/// 0.09 to 0.18, of four-legged animals nearly always more. Chosen by hand.
const COSTS_MORE: f64 = 0.1;
/// Turned assignments that are judged, at most: one in each direction.
const MOST: usize = 2;

/// The assignment `from`, but that the main tips around one of its ends, in the order in which shortest paths lead to them, go each to the
/// partner of the next, or each to that of the one before; the cheapest first. None where all of these cost far more.
pub(super) fn turned(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let is_main = |k: &usize| {
        *k >= given && MeshSide::BOTH.iter().all(|&side| tables.main[side].contains(&from.pairs[*k][side]))
    };
    let main: Vec<usize> = (0..from.pairs.len()).filter(is_main).collect();
    let mut found: Vec<Assignment> = Vec::new();
    for root in 0..from.pairs.len() {
        let ranks = &tables.shapes[0].marks[from.pairs[root][0]].ranks[0];
        let mut ring: Vec<usize> = main.iter().copied().filter(|&k| k != root).collect();
        if ring.len() < LEAST {
            continue;
        }
        ring.sort_by_key(|&k| ranks[from.pairs[k][0]]);
        for step in [1, ring.len() - 1] {
            let mut pairs = from.pairs.clone();
            for (i, &k) in ring.iter().enumerate() {
                pairs[k][1] = from.pairs[ring[(i + step) % ring.len()]][1];
            }
            found.push(tables.assignment(&pairs));
        }
    }
    found.retain(|turned| turned.full_cost() < from.full_cost() + COSTS_MORE);
    found.sort_by(|a, b| a.full_cost().total_cmp(&b.full_cost()));
    found.dedup_by(|a, b| a.pairs == b.pairs);
    found.truncate(MOST);
    found
}

#[cfg(test)]
mod tests {
    use super::super::options::MatchOptions;
    use super::super::shape::Shape;
    use super::super::test_bodies::{ball_with_ends, four_footed, shape};
    use super::*;
    use crate::math::scalar::{atan2, cos, sin};
    use glam::DVec3;
    use std::f64::consts::TAU;

    /// The pairs of a body that is matched with itself: as they are, and turned.
    fn goals(shape: &Shape, tables: &Tables<'_>) -> [Vec<Vec<[usize; 2]>>; 2] {
        let own: Vec<[usize; 2]> = shape.main(&MatchOptions::default()).iter().map(|&k| [k; 2]).collect();
        let from = tables.assignment(&own);
        let turned = turned(tables, &from).into_iter().map(|turned| turned.pairs).collect();
        [vec![from.pairs], turned]
    }

    #[test]
    fn arms_all_round_go_to_the_next_ones_and_the_head_stays() {
        // Six arms all round, and a head above them.
        let arm = |k: usize| {
            let angle = TAU * k as f64 / 6.0;
            (DVec3::new(cos(angle), sin(angle), -0.3), 2.0)
        };
        let ends: Vec<(DVec3, f64)> = (0..6).map(arm).chain([(DVec3::Z, 1.0)]).collect();
        let body = shape(&ball_with_ends(&ends, 30.0));
        let tables = Tables::new([&body; 2], &MatchOptions::default());
        let [own, turned] = goals(&body, &tables);
        assert_eq!((own[0].len(), turned.len()), (7, 2));
        let place = |k: usize| {
            let p = body.level.mesh.positions()[body.marks[k].vertex];
            (p.z < 0.0).then(|| atan2(p.y, p.x))
        };
        let mut steps = Vec::new();
        for pairs in turned {
            for [s, t] in pairs {
                let (Some(a), Some(b)) = (place(s), place(t)) else {
                    assert_eq!(s, t, "the head");
                    continue;
                };
                steps.push((6.0 * (b - a) / TAU).rem_euclid(6.0).round() as i32);
            }
        }
        steps.sort_unstable();
        assert_eq!(steps, [[1; 6], [5; 6]].concat());
    }

    #[test]
    fn a_body_on_four_feet_is_not_turned() {
        let body = shape(&four_footed());
        let tables = Tables::new([&body; 2], &MatchOptions::default());
        assert_eq!(goals(&body, &tables)[1], Vec::<Vec<[usize; 2]>>::new());
    }
}

//! The descent from a drawing to straighter ones by twists, without a map: a drawing costs a tenth of the time of judging its map.
//!
//! The class of the map that distorts least nearly always has a straight drawing: where the paths of a drawing wind, some tree
//! path went the wrong way round a limb, and a twist about the curve between two groups of landmarks undoes that. So the sum of the
//! detours is lowered by twists as long as one lowers it, and only the last drawing is judged.

use super::drawing::{Drawing, Planner};
use super::joint::{complete, straighten};
use super::twists::{self, Twist};
use super::variants::PLAIN;
use crate::monitor::{Cancelled, unless_stopped};

/// A twist must lower the sum of the detours by this: drawings of one class differ by as much. Chosen by hand.
const LEAST_GAIN: f64 = 0.05;

/// A twist is tried where its path is at most this many times as long as the one that it replaces. With 1.2 a third of the starts
/// ended with larger detours (0.97 in place of 0.36 on shrec07-385-387), for a third fewer drawings.
const LARGEST_RATIO: f64 = 2.0;

/// Drawings of one descent, at most. Of 21 descents on seven pairs none took more than 19.
pub(super) const MOST_DRAWINGS: usize = 40;

/// The last drawing of a descent is drawn anew at most this many times. On the 34 test pairs no third time lowered the detours by more than
/// 0.001, but each refines the meshes by a sixth: without this bound cat and lion were drawn anew 18 times, on meshes with four times the
/// vertices, where the layout had no map and all later drawings took as much longer.
const MOST_REDRAWN: usize = 3;

/// The sum of detours up to which a drawing is still completed that should end below `detour`: straightening lowers it. Drawings whose
/// paths wind take ten times as long as straight ones and more. Factor and summand were chosen by hand.
pub(super) fn worth_completing(detour: f64) -> f64 {
    1.5 * detour + 0.5
}

/// Lowers the sum of the detours of a drawing by twists, each the first that lowers it; ends where none of the first
/// `patience` does.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn straightest(
    start: Drawing,
    patience: usize,
    planner: &mut Planner<'_>,
) -> Result<Drawing, Cancelled> {
    let mut best = start;
    let mut detour = best.detour(planner.distances);
    let mut left = MOST_DRAWINGS;
    planner.most_detour = worth_completing(detour);
    // Completing the twists of a descent on the 34 test pairs takes a quarter of this at most, mostly a twentieth; from a wound start it
    // may take twenty times as much.
    planner.begin_together();
    while left > 0 && detour > LEAST_GAIN && !planner.wants_result() {
        let mut twists =
            unless_stopped(twists::plausible(&best, planner, LARGEST_RATIO))?.unwrap_or_default();
        twists.truncate(patience);
        let Some((less, next)) = first_gain(&best, &twists, detour - LEAST_GAIN, &mut left, planner)? else {
            break;
        };
        (detour, best) = (less, next);
        planner.most_detour = worth_completing(detour);
    }
    redrawn(best, detour, planner)
}

/// The first drawing after one of the twists whose detours are below a limit.
fn first_gain(
    of: &Drawing,
    twists: &[Twist],
    limit: f64,
    left: &mut usize,
    planner: &mut Planner<'_>,
) -> Result<Option<(f64, Drawing)>, Cancelled> {
    for twist in twists {
        if *left == 0 || planner.wants_result() || !planner.may_search() {
            break;
        }
        *left -= 1;
        let Some(Some(turned)) = unless_stopped(twists::twisted(of, planner, twist))? else { continue };
        let detour = turned.detour(planner.distances);
        if detour < limit {
            return Ok(Some((detour, turned)));
        }
    }
    Ok(None)
}

/// Completes the drawing anew from its own shortest spanning tree as long as that lowers its detours, [`MOST_REDRAWN`] times at most:
/// the class stays, and the drawing depends less on the order in which its paths were drawn.
fn redrawn(drawing: Drawing, detour: f64, planner: &mut Planner<'_>) -> Result<Drawing, Cancelled> {
    let (mut best, mut least) = (drawing, detour);
    for _ in 0..MOST_REDRAWN {
        if planner.wants_result() {
            break;
        }
        planner.begin();
        planner.tell(0.0)?;
        let mut again = twists::shortest_tree(&best);
        let drawn = complete(&mut again, planner, &PLAIN).and_then(|()| straighten(&mut again, planner));
        let less = again.detour(planner.distances);
        if unless_stopped(drawn)?.is_none() || less >= least {
            break;
        }
        (best, least) = (again, less);
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use super::super::joint::{Ground, draw};
    use super::super::twists::testing::figures;
    use super::super::variants::VARIANTS;
    use super::*;
    use crate::monitor::Silent;

    #[test]
    fn no_descent_ends_more_wound_than_it_begins() {
        let (levels, landmarks) = figures();
        let empty = Drawing::new(&levels[0].mesh, &levels[1].mesh, &landmarks);
        let distances = empty.distances(&mut Silent).unwrap();
        let ground = Ground::new(&empty, &distances);
        let mut gained = 0;
        for variant in &VARIANTS {
            let Ok(start) = draw(&ground, variant, &mut Silent) else { continue };
            let begun = start.detour(&distances);
            let mut silent = Silent;
            let ended =
                straightest(start, MOST_DRAWINGS, &mut Planner::new(&distances, 1.0, &mut silent)).unwrap();
            assert_eq!(ended.ends.len(), 3 * landmarks.len() - 6);
            assert!(ended.detour(&distances) <= begun);
            gained += usize::from(ended.detour(&distances) < begun);
        }
        assert!(gained > 0);
    }
}
